#pragma once

#include <string_view>

/// Topics and services between a flight controller and who decides, by the names that MAVROS gives them.
namespace lapwing::bus::mavros::names {

inline constexpr std::string_view state = "/mavros/state";
inline constexpr std::string_view system_status = "/mavros/sys_status";
inline constexpr std::string_view battery = "/mavros/battery";
inline constexpr std::string_view position = "/mavros/global_position/global";
inline constexpr std::string_view relative_altitude = "/mavros/global_position/rel_alt";
inline constexpr std::string_view local_pose = "/mavros/local_position/pose";
inline constexpr std::string_view home = "/mavros/home_position/home";
inline constexpr std::string_view status_text = "/mavros/statustext/recv";

inline constexpr std::string_view local_setpoint = "/mavros/setpoint_position/local";
inline constexpr std::string_view global_setpoint = "/mavros/setpoint_position/global";

inline constexpr std::string_view arming = "/mavros/cmd/arming";
inline constexpr std::string_view command = "/mavros/cmd/command";
inline constexpr std::string_view takeoff = "/mavros/cmd/takeoff";
inline constexpr std::string_view set_mode = "/mavros/set_mode";
inline constexpr std::string_view set_parameter = "/mavros/param/set";

}  // namespace lapwing::bus::mavros::names
