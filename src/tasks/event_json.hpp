#pragma once

#include <optional>
#include <string>

#include "tasks/task_view.hpp"

namespace lapwing::tasks {

/// One line of JSON without its line end: `{"t":0.1,"event":"START","task":"A","vehicle":"a1"}`, t in seconds of loop
/// time.
///
/// "detail" is added where there is one. The START of a mission carries its items as ArduPilot gets them:
/// `"items":[{"seq":0, "command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":null,"x":40.4,"y":-7.3,"z":820}, ...]`, x and y
/// being latitude and longitude in degrees, null standing for NaN. `vehicle_home` is item 0 of a mission without a home
/// of its own.
[[nodiscard]] std::string to_json_line(TaskEvent const& event, std::optional<geo::Wgs84> vehicle_home = std::nullopt);

}  // namespace lapwing::tasks
