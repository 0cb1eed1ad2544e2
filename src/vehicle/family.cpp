#include "vehicle/family.hpp"

namespace lapwing::vehicle {

std::string_view to_string(Family family) {
  switch (family) {
    case Family::copter: return "copter";
    case Family::plane: return "plane";
    case Family::vtol: return "vtol";
    case Family::rover: return "rover";
    case Family::boat: return "boat";
    case Family::sub: return "sub";
    case Family::robot: return "robot";
    case Family::unknown: return "unknown";
  }
  return "unknown";
}

std::string_view to_string(Autopilot autopilot) {
  switch (autopilot) {
    case Autopilot::ardupilot: return "ardupilot";
    case Autopilot::px4: return "px4";
    case Autopilot::other: return "other";
  }
  return "other";
}

}  // namespace lapwing::vehicle
