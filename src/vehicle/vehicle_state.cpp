#include "vehicle/vehicle_state.hpp"

namespace lapwing::vehicle {

std::string_view to_string(Family family) {
  switch (family) {
    case Family::copter: return "copter";
    case Family::plane: return "plane";
    case Family::vtol: return "vtol";
    case Family::rover: return "rover";
    case Family::boat: return "boat";
    case Family::sub: return "sub";
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

std::string_view gps_fix_name(int fix) {
  static constexpr std::array<std::string_view, 9> names{"no GPS",    "no fix",    "2D",     "3D", "DGPS",
                                                         "RTK float", "RTK fixed", "static", "PPP"};
  auto const index = static_cast<std::size_t>(fix);
  return index < names.size() ? names[index] : "unknown";
}

std::string_view to_string(Connection connection) {
  switch (connection) {
    case Connection::ok: return "ok";
    case Connection::lost: return "lost";
    case Connection::conflict: return "conflict";
  }
  return "lost";
}

}  // namespace lapwing::vehicle
