#include "host/simulation/simulated_fleet.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/parser.hpp"
#include "plan/capabilities.hpp"

namespace lapwing::host {

base::Result<std::vector<sim::VehicleGroup>> simulated_fleet_for(dolphin::Needs const& needs,
                                                                 base::SourceFile const& source) {
  auto const at = [&](base::Span span) { return fmt::format("{}:{}", source.name(), source.line(span.begin)); };
  if (!needs.unclear.empty()) {
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("{}: which vehicles this pick takes is only known when the script runs", at(needs.unclear.front())),
        "say what to simulate: --vehicles copter:2,rover:1");
  }
  std::vector<sim::VehicleGroup> groups;
  for (auto const& need : needs.vehicles) {
    // Of the families behind a type the first is the usual one: a copter where a "UAV" will do.
    auto const families = plan::families_of(need.type.empty() ? "UAV" : need.type);
    if (families.empty()) {
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("{}: a vehicle of type '{}' cannot be simulated", at(need.span), need.type),
                        "the simulator has copters and planes (UAV), rovers (UGV), boats (USV) and subs (UUV)");
    }
    auto const group = std::ranges::find(groups, families.front(), &sim::VehicleGroup::family);
    if (group != groups.end()) {
      group->count += need.count;
    } else {
      groups.push_back({.family = families.front(), .count = need.count});
    }
  }
  return groups;
}

std::vector<std::string> payload_for(dolphin::Needs const& needs) {
  std::vector<std::string> names;
  for (auto const& need : needs.vehicles)
    for (auto const& name : need.payload)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

Equipment equipped(sim::WorldOptions const& world, std::vector<std::string> const& payload) {
  Equipment equipment;
  auto system_id = static_cast<std::uint8_t>(world.first_system_id);
  for (auto const& group : world.vehicles)
    for (int i = 0; i < group.count; ++i) equipment[{.system_id = system_id++}] = payload;
  return equipment;
}

dolphin::Needs needs_of_text(std::string const& name, std::string const& text) {
  base::SourceFile const source(name, text);
  base::Diagnostics ignored(source);
  return dolphin::needs_of(dolphin::parse(ignored));
}

std::string to_text(std::vector<sim::VehicleGroup> const& groups) {
  std::string text;
  for (auto const& group : groups)
    text += fmt::format("{}{}{}:{}", text.empty() ? "" : ",", group.firmware == vehicle::Autopilot::px4 ? "px4-" : "",
                        vehicle::to_string(group.family), group.count);
  return text;
}

}  // namespace lapwing::host
