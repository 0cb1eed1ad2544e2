#include "dolphin/builtin/internal/pick_filter.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dolphin/value/text.hpp"

namespace lapwing::dolphin::internal {

PickFilter pick_filter(Map const& fields) {
  PickFilter filter;
  for (auto const& [key, value] : fields.items()) {
    auto const field = to_text(key);
    if (field == "count") filter.count = static_cast<std::size_t>(value.integer());
    if (field == "timeout") filter.timeout = base::from_seconds(value.number());
    if (field == "type") filter.type = to_text(value);
    if (field == "id") filter.id = to_text(value);
    if (field == "region") filter.region = value.as<Area>()->value;
    if (field != "payload") continue;
    for (auto const& name : value.as<List>()->items) filter.payload.push_back(to_text(name));
  }
  return filter;
}

std::vector<std::string> objections(PickFilter const& filter, tasks::VehicleInfo const& vehicle) {
  std::vector<std::string> found;
  if (filter.id && *filter.id != vehicle.id.text) found.push_back(fmt::format("is not {}", *filter.id));
  if (filter.type && *filter.type != vehicle.type) found.push_back(fmt::format("is a {}", vehicle.type));
  for (auto const& name : filter.payload)
    if (std::ranges::find(vehicle.payload, name) == vehicle.payload.end())
      found.push_back(fmt::format("has no {}", name));
  if (filter.region && !vehicle.position) {
    found.emplace_back("has not told its position");
  } else if (filter.region && !filter.region->contains(*vehicle.position)) {
    found.emplace_back("is outside the region");
  }
  return found;
}

std::string pick_text(PickFilter const& filter) {
  auto text = fmt::format("{} {}", filter.count, filter.type.value_or(filter.count == 1 ? "vehicle" : "vehicles"));
  if (filter.id) text += fmt::format(" with id {}", *filter.id);
  if (!filter.payload.empty()) text += fmt::format(" with {}", fmt::join(filter.payload, " and "));
  return filter.region ? text + " in the region" : text;
}

std::vector<std::string> why_not_picked(PickFilter const& filter, std::vector<tasks::VehicleInfo> const& vehicles,
                                        std::vector<tasks::VehicleId> const& picked) {
  std::vector<std::string> lines;
  constexpr std::size_t most_named = 20;
  for (auto const& vehicle : vehicles) {
    if (lines.size() == most_named) {
      lines.push_back(fmt::format("and {} more", vehicles.size() - most_named));
      break;
    }
    auto reasons = objections(filter, vehicle);
    if (std::ranges::find(picked, vehicle.id) != picked.end()) reasons.insert(reasons.begin(), "is picked already");
    if (!vehicle.connected) reasons.insert(reasons.begin(), "is not heard, or shares its id");
    lines.push_back(fmt::format("vehicle {} {}", vehicle.id.text,
                                reasons.empty() ? "would do" : fmt::format("{}", fmt::join(reasons, ", "))));
  }
  if (lines.empty()) lines.emplace_back("no vehicle was heard");
  return lines;
}

}  // namespace lapwing::dolphin::internal
