#include "host/links/find_vehicles.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/async/notifier.hpp"

namespace lapwing::host {

using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using fleet::MavlinkVehicle;
using mavlink::SystemName;
using namespace std::chrono_literals;

namespace {

std::vector<MavlinkVehicle*> heard(Ground const& ground) {
  auto crafts = ground.fleet.all();
  std::erase_if(crafts, [](auto const* craft) { return craft->state.links.connection == vehicle::Connection::lost; });
  return crafts;
}

std::string list(std::vector<MavlinkVehicle*> const& crafts) {
  std::vector<std::string> names;
  for (auto const* craft : crafts) names.push_back(craft->id().text);
  return fmt::format("{}", fmt::join(names, ", "));
}

MavlinkVehicle* find(std::vector<MavlinkVehicle*> const& crafts, SystemName const& name) {
  auto const found = std::ranges::find(crafts, name, &MavlinkVehicle::name);
  return found == crafts.end() ? nullptr : *found;
}

std::vector<std::string> missing(std::vector<MavlinkVehicle*> const& crafts, std::vector<SystemName> const& wanted) {
  std::vector<std::string> names;
  for (auto const& name : wanted)
    if (!find(crafts, name)) names.push_back(to_string(name));
  return names;
}

std::unexpected<base::Error> not_heard(Ground const& ground, std::vector<std::string> const& names,
                                       base::Duration patience) {
  auto const others = list(heard(ground));
  auto const who = names.empty()       ? std::string("no vehicle was")
                   : names.size() == 1 ? fmt::format("vehicle {} was not", names.front())
                                       : fmt::format("vehicles {} were not", fmt::join(names, ", "));
  auto const* keys = ground.connection.signing() ? "; does it sign with a key that is not in the store?" : "";
  return fail(ErrorKind::lost,
              fmt::format("{} heard within {:g} s{}", who, base::to_seconds(patience),
                          others.empty() ? "" : fmt::format(" (heard: {})", others)),
              fmt::format("lapwing doctor tells which links answer; --wait S waits longer{}", keys));
}

}  // namespace

Task<Result<std::vector<MavlinkVehicle*>>> find_vehicles(Ground& ground, std::vector<SystemName> wanted,
                                                         base::Duration patience) {
  constexpr auto others_beat = 1500ms;  // heartbeats come every second
  for (auto const& name : wanted)
    if (auto const known = ground.network(name.network); !known) co_return std::unexpected(known.error());
  auto const all_there = [&] {
    auto const crafts = heard(ground);
    return wanted.empty() ? !crafts.empty() : missing(crafts, wanted).empty();
  };
  base::Notifier heard_one(ground.loop);
  auto const listening = ground.fleet.subscribe([&](auto const&...) { heard_one.notify_all(); });
  auto finding = heard_one.wait_for(all_there, patience);
  if (!co_await finding) co_return not_heard(ground, missing(heard(ground), wanted), patience);
  if (wanted.empty()) {
    co_await ground.loop.sleep(others_beat);
    co_return heard(ground);
  }
  std::vector<MavlinkVehicle*> found;
  for (auto const& name : wanted) found.push_back(find(heard(ground), name));
  co_return found;
}

Task<Result<MavlinkVehicle*>> find_vehicle(Ground& ground, std::vector<SystemName> wanted, base::Duration patience) {
  auto const found = co_await find_vehicles(ground, std::move(wanted), patience);
  if (!found) co_return std::unexpected(found.error());
  if (found->size() == 1) co_return found->front();
  co_return fail(ErrorKind::invalid_input, fmt::format("there are {} vehicles: {}", found->size(), list(*found)),
                 "say which: --vehicle ID");
}

Result<std::vector<SystemName>> parse_vehicles(std::vector<std::string> const& texts) {
  std::vector<SystemName> names;
  for (auto const& text : texts) {
    auto name = mavlink::parse_system_name(text);
    if (!name) return std::unexpected(name.error());
    names.push_back(*std::move(name));
  }
  return names;
}

}  // namespace lapwing::host
