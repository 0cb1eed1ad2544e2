#include "apps/crew.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::apps {

base::Result<std::vector<sim::VehicleGroup>> crew_for(dolphin::Needs const& needs, base::SourceFile const& source) {
  auto const at = [&](base::Span span) { return fmt::format("{}:{}", source.name(), source.line(span.begin)); };
  if (!needs.unclear.empty()) {
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("{}: which vehicles this pick takes is only known when the script runs", at(needs.unclear.front())),
        "say what to simulate: --vehicles copter:2,rover:1");
  }
  std::vector<sim::VehicleGroup> groups;
  for (auto const& need : needs.vehicles) {
    bool const rolls = need.type == "UGV";
    if (!rolls && !need.type.empty() && need.type != "UAV") {
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("{}: a vehicle of type '{}' cannot be simulated", at(need.span), need.type),
                        "the simulator has copters and planes (UAV) and rovers (UGV)");
    }
    auto const family = rolls ? vehicle::Family::rover : vehicle::Family::copter;
    auto const group = std::ranges::find(groups, family, &sim::VehicleGroup::family);
    if (group != groups.end()) {
      group->count += need.count;
    } else {
      groups.push_back({.family = family, .count = need.count});
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

std::string to_text(std::vector<sim::VehicleGroup> const& groups) {
  std::string text;
  for (auto const& group : groups)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", vehicle::to_string(group.family), group.count);
  return text;
}

}  // namespace lapwing::apps
