#pragma once

#include <string_view>

namespace lapwing::vehicle {

/// What moves it: decides icon, capabilities and mode tables. A robot drives indoors by a site's frame and has no
/// autopilot of the kinds below; a rover drives by the globe.
enum class Family { copter, plane, vtol, rover, boat, sub, robot, unknown };
[[nodiscard]] std::string_view to_string(Family family);

enum class Autopilot { ardupilot, px4, other };
[[nodiscard]] std::string_view to_string(Autopilot autopilot);

}  // namespace lapwing::vehicle
