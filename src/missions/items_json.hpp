#pragma once

#include <optional>
#include <string>

#include "tasks/task_view.hpp"
#include "vehicle/family.hpp"

namespace lapwing::missions {

/// The vehicle that a mission's items are for, as far as they depend on it.
struct Carrier {
  std::optional<geo::Wgs84> home = std::nullopt;  ///< item 0 of a mission without a home of its own
  vehicle::Autopilot autopilot = vehicle::Autopilot::ardupilot;
  vehicle::Family family = vehicle::Family::unknown;
};

/// For `tasks::to_json_line`: what the START of a mission says more, its items as `carrier` gets them; empty for every
/// other event.
///
///     "items":[{"seq":0,"command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":null,"x":40.4,"y":-7.3,"z":820}, ...]
///
/// x and y are latitude and longitude in degrees; null stands for NaN.
[[nodiscard]] std::string items_json(tasks::TaskEvent const& event, Carrier const& carrier = {});

}  // namespace lapwing::missions
