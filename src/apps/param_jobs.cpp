#include "apps/param_jobs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/progress.hpp"
#include "base/notifier.hpp"
#include "base/scope.hpp"

namespace lapwing::apps {

using base::ErrorKind;
using parameters::Parameter;
using parameters::ParameterService;
using namespace std::chrono_literals;

namespace {

std::vector<std::uint8_t> heard_ids(ParameterService const& service) {
  std::vector<std::uint8_t> ids;
  for (auto const& vehicle : service.vehicles()) ids.push_back(vehicle.address.system);
  return ids;
}

std::string who(std::uint8_t id) {
  return fmt::format("vehicle {}", id);
}

base::Task<base::Result<ParamListing>> list_one(base::Loop& loop, ParameterService& service, std::uint8_t id,
                                                parameters::Wanted wanted, std::vector<std::string> patterns) {
  Progress progress(who(id), "parameters");
  mavlink::ParamProgress const show = [&progress, &loop](std::size_t done, std::size_t total) {
    progress.show(done, total, loop.now());
  };
  auto snapshot = co_await service.all(id, wanted, show);
  if (!snapshot) co_return std::unexpected(snapshot.error());
  ParamListing listing{
      .system_id = id,
      .firmware = snapshot->identity.firmware ? parameters::firmware_text(snapshot->identity.firmware) : std::string(),
      .confirmed = snapshot->confirmed,
      .taken = snapshot->taken};
  for (auto& parameter : snapshot->parameters)
    if (parameters::fits_any(parameter.name, patterns)) listing.parameters.push_back(std::move(parameter));
  co_return listing;
}

template <class T>
base::Task<> fill(base::Task<T> task, std::optional<T>& slot, std::size_t& left, base::Notifier& done) {
  slot.emplace(co_await task);
  if (--left == 0) done.notify_all();
}

/// What is to be set, one value, as `ParamChanges` will have it.
base::Task<> apply_one(ParameterService& service, Parameter value, ParamChanges& changes) {
  auto const changed = co_await service.change(changes.system_id, value.name, value.value);
  if (!changed) {
    changes.failed.push_back({value.name, changed.error().message});
  } else if (mavlink::same_value(changed->before, changed->after)) {
    ++changes.unchanged;
  } else {
    changes.changed.push_back(*changed);
  }
}

/// Takes out of `values` what the list settles: equal already, or (to tell only) what would change. What the list lacks
/// stays in `unknown`.
std::vector<Parameter> to_set(std::vector<Parameter> const& values, std::vector<Parameter> const& there, bool only_tell,
                              ParamChanges& changes, std::vector<Parameter>& unknown) {
  std::map<std::string_view, Parameter const*> by_name;
  for (auto const& parameter : there) by_name[parameter.name] = &parameter;
  std::vector<Parameter> rest;
  for (auto const& value : values) {
    auto const known = by_name.find(value.name);
    if (known == by_name.end()) {
      unknown.push_back(value);
    } else if (mavlink::same_value(*known->second, value)) {
      ++changes.unchanged;
    } else if (only_tell) {
      changes.changed.push_back({*known->second, value});
    } else {
      rest.push_back(value);
    }
  }
  return rest;
}

}  // namespace

base::Task<base::Result<std::vector<std::uint8_t>>> find_vehicles(base::Loop& loop, ParameterService& service,
                                                                  std::vector<std::uint8_t> wanted,
                                                                  base::Duration timeout) {
  // Every vehicle says that it is there once a second.
  constexpr auto others_follow = 1200ms;
  auto const deadline = loop.now() + timeout;
  auto const all_there = [&] {
    auto const ids = heard_ids(service);
    if (wanted.empty()) return !ids.empty();
    return std::ranges::all_of(wanted, [&](auto id) { return std::ranges::find(ids, id) != ids.end(); });
  };
  while (!all_there() && loop.now() < deadline) co_await loop.sleep(10ms);
  auto const ids = heard_ids(service);
  if (!all_there()) {
    auto const missing =
        wanted.empty() ? std::string("no vehicle") : fmt::format("not every vehicle of {}", fmt::join(wanted, ", "));
    co_return base::fail(ErrorKind::lost,
                         fmt::format("{} was heard within {:g} s{}", missing, base::to_seconds(timeout),
                                     ids.empty() ? "" : fmt::format(" (heard: {})", fmt::join(ids, ", "))),
                         "lapwing doctor tells which links answer; --wait S waits longer");
  }
  if (!wanted.empty()) co_return wanted;
  co_await loop.sleep(others_follow);
  co_return heard_ids(service);
}

base::Task<base::Result<std::vector<ParamListing>>> list_parameters(base::Loop& loop, ParameterService& service,
                                                                    std::vector<std::uint8_t> ids,
                                                                    parameters::Wanted wanted,
                                                                    std::vector<std::string> patterns) {
  using One = base::Result<ParamListing>;
  std::vector<std::optional<One>> slots(ids.size());
  std::size_t left = ids.size();
  base::Notifier done(loop);
  base::Scope scope(loop);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto task = list_one(loop, service, ids[i], wanted, patterns);
    scope.spawn(fill<One>(std::move(task), slots[i], left, done));
  }
  while (left > 0) co_await done.wait();
  std::vector<ParamListing> listings;
  for (auto& slot : slots) {
    if (!*slot) co_return std::unexpected(slot->error());
    listings.push_back(std::move(**slot));
  }
  co_return listings;
}

base::Task<ParamListing> read_parameters(ParameterService& service, std::uint8_t id, std::vector<std::string> names) {
  ParamListing listing{.system_id = id};
  for (auto const& name : names) {
    auto const value = co_await service.read(id, name);
    if (value) {
      listing.parameters.push_back(*value);
    } else {
      listing.errors.push_back(value.error().message);
    }
  }
  co_return listing;
}

base::Task<base::Result<ParamChanges>> apply_parameters(base::Loop& loop, ParameterService& service, std::uint8_t id,
                                                        std::vector<Parameter> values, ApplyOptions options) {
  /// So few are asked for one by one; more are compared with the vehicle's list first.
  constexpr std::size_t few = 20;
  ParamChanges changes{.system_id = id};
  if (options.leave_out_own) {
    auto const own = std::ranges::stable_partition(
        values, [](Parameter const& value) { return !parameters::belongs_to_one_vehicle(value.name); });
    for (auto const& value : own) changes.skipped.push_back(value.name);
    values.erase(own.begin(), own.end());
  }
  bool const one_by_one = values.size() <= few && !options.only_tell;
  for (bool is_first = true;; is_first = false) {
    std::vector<Parameter> unknown;
    auto rest = values;
    if (!one_by_one) {
      auto const there = co_await list_one(loop, service, id, parameters::Wanted::confirmed, {});
      if (!there) co_return std::unexpected(there.error());
      rest = to_set(values, there->parameters, options.only_tell, changes, unknown);
    }
    Progress progress(who(id), "values set");
    for (std::size_t i = 0; i < rest.size(); ++i) {
      co_await apply_one(service, rest[i], changes);
      progress.show(i + 1, rest.size(), loop.now());
    }
    // Some show only when another, such as FENCE_ENABLE, has been set.
    bool const another_round = is_first && !unknown.empty() && !changes.changed.empty() && !options.only_tell;
    if (another_round) {
      values = std::move(unknown);
      continue;
    }
    for (auto const& value : unknown) changes.failed.push_back({value.name, "the vehicle has no such parameter"});
    co_return changes;
  }
}

}  // namespace lapwing::apps
