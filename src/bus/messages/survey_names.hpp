#pragma once

#include <string_view>

/// Topics between the processes of a survey drone: who decides, who looks, who maps and who plans.
namespace lapwing::bus::survey::names {

inline constexpr std::string_view lot_detected = "/park_lot_detected";
inline constexpr std::string_view place_in_lot = "/des_loc_inbound";
inline constexpr std::string_view occupancy_map = "/occupancy_map";
/// What the planner has to say to the operator.
inline constexpr std::string_view survey_report = "/survey_report";
/// The places to park that are known, all of them: a GeoJSON FeatureCollection in a text.
inline constexpr std::string_view parking_slots = "/parking_slots";
inline constexpr std::string_view planner_setpoint = "/path_plan_setpoint";
inline constexpr std::string_view vision_health = "/vision_health";
inline constexpr std::string_view mapper_health = "/mapper_health";
inline constexpr std::string_view planner_health = "/path_plan_health";

inline constexpr std::string_view wanted_pose = "/des_pose";
inline constexpr std::string_view current_state = "/curr_state";
/// The lowest, the desired and the highest, metres above home.
inline constexpr std::string_view hover_heights = "/hover_heights";
/// Seconds until the drone has to be over home, by its battery.
inline constexpr std::string_view flying_time_left = "/flying_time_left";

}  // namespace lapwing::bus::survey::names
