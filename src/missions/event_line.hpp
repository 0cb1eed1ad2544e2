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

/// What happened as one line of `--events`, without its line end. The START of a mission says more: its items as
/// `carrier` gets them.
///
///     {"t":0.1,"event":"START","task":"m","vehicle":"1","items":[
///       {"seq":0,"command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":null,"x":40.4,"y":-7.3,"z":820}, ...]}
///
/// x and y are latitude and longitude in degrees; null stands for NaN. Others compare these lines byte for byte.
[[nodiscard]] std::string event_line(tasks::TaskEvent const& event, Carrier const& carrier = {});

}  // namespace lapwing::missions
