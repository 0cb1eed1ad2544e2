#pragma once

#include <optional>
#include <string>

#include "tasks/task_view.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::tasks {

/// The vehicle that a mission's items are for, as far as they depend on it.
struct Carrier {
  std::optional<geo::Wgs84> home = std::nullopt;  ///< item 0 of a mission without a home of its own
  vehicle::Autopilot autopilot = vehicle::Autopilot::ardupilot;
  vehicle::Family family = vehicle::Family::unknown;
};

/// One line of JSON without its line end: `{"t":0.1,"event":"START","task":"A","vehicle":"a1"}`, t in seconds of loop
/// time.
///
/// "detail" is added where there is one. The START of a mission carries its items as `carrier` gets them:
/// `"items":[{"seq":0, "command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":null,"x":40.4,"y":-7.3,"z":820}, ...]`, x and y
/// being latitude and longitude in degrees, null standing for NaN.
[[nodiscard]] std::string to_json_line(TaskEvent const& event, Carrier const& carrier = {});

}  // namespace lapwing::tasks
