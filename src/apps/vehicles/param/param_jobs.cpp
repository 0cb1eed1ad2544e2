#include "apps/vehicles/param/param_jobs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "host/session/progress.hpp"

namespace lapwing::apps {

using parameters::Parameter;

namespace {

std::string who(ParamVehicle const& vehicle) {
  return fmt::format("vehicle {}", vehicle.craft->id().text);
}

base::Task<base::Result<ParamListing>> list_one(base::Loop& loop, ParamVehicle vehicle, parameters::Wanted wanted,
                                                std::vector<std::string> patterns) {
  host::Progress progress(who(vehicle), "parameters");
  mavlink::ParamProgress const show = [&progress, &loop](std::size_t done, std::size_t total) {
    progress.show(done, total, loop.now());
  };
  auto snapshot = co_await vehicle.service->all(vehicle.craft->address.system, wanted, show);
  if (!snapshot) co_return std::unexpected(snapshot.error());
  ParamListing listing{
      .vehicle = vehicle.craft->name(),
      .firmware = snapshot->identity.firmware ? parameters::firmware_text(snapshot->identity.firmware) : std::string(),
      .confirmed = snapshot->confirmed,
      .taken = snapshot->taken};
  for (auto& parameter : snapshot->parameters)
    if (parameters::fits_any(parameter.name, patterns)) listing.parameters.push_back(std::move(parameter));
  co_return listing;
}

template <class T>
base::Task<> fill(base::Task<T> task, std::optional<T>& slot) {
  slot.emplace(co_await task);
}

/// What is to be set, one value, as `ParamChanges` will have it.
base::Task<> apply_one(ParamVehicle vehicle, Parameter value, ParamChanges& changes) {
  auto const changed = co_await vehicle.service->change(vehicle.craft->address.system, value.name, value.value);
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

base::Task<base::Result<std::vector<ParamListing>>> list_parameters(base::Loop& loop,
                                                                    std::vector<ParamVehicle> vehicles,
                                                                    parameters::Wanted wanted,
                                                                    std::vector<std::string> patterns) {
  using One = base::Result<ParamListing>;
  std::vector<std::optional<One>> slots(vehicles.size());
  base::Scope scope(loop);
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    auto task = list_one(loop, vehicles[i], wanted, patterns);
    scope.spawn(fill<One>(std::move(task), slots[i]));
  }
  co_await scope.join();
  std::vector<ParamListing> listings;
  for (auto& slot : slots) {
    if (!*slot) co_return std::unexpected(slot->error());
    listings.push_back(std::move(**slot));
  }
  co_return listings;
}

base::Task<ParamListing> read_parameters(ParamVehicle vehicle, std::vector<std::string> names) {
  ParamListing listing{.vehicle = vehicle.craft->name()};
  for (auto const& name : names) {
    auto const value = co_await vehicle.service->read(vehicle.craft->address.system, name);
    if (value) {
      listing.parameters.push_back(*value);
    } else {
      listing.errors.push_back(value.error().message);
    }
  }
  co_return listing;
}

base::Task<base::Result<ParamChanges>> apply_parameters(base::Loop& loop, ParamVehicle vehicle,
                                                        std::vector<Parameter> values, ApplyOptions options) {
  /// So few are asked for one by one; more are compared with the vehicle's list first.
  constexpr std::size_t few = 20;
  ParamChanges changes{.vehicle = vehicle.craft->name()};
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
      auto const there = co_await list_one(loop, vehicle, parameters::Wanted::confirmed, {});
      if (!there) co_return std::unexpected(there.error());
      rest = to_set(values, there->parameters, options.only_tell, changes, unknown);
    }
    host::Progress progress(who(vehicle), "values set");
    for (std::size_t i = 0; i < rest.size(); ++i) {
      co_await apply_one(vehicle, rest[i], changes);
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
