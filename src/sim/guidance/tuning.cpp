#include "sim/guidance/tuning.hpp"

#include <algorithm>

namespace lapwing::sim {

namespace {
constexpr double m_per_cm = 0.01;

Pace px4_pace(vehicle::Family family, ParameterTable const& parameters) {
  Pace pace;
  pace.speed_m_s = parameters.value(family == vehicle::Family::plane   ? "FW_AIRSPD_TRIM"
                                    : family == vehicle::Family::rover ? "GND_SPEED_TRIM"
                                                                       : "MPC_XY_CRUISE");
  bool const wing = family == vehicle::Family::plane;
  pace.climb_m_s = parameters.value(wing ? "FW_T_CLMB_MAX" : "MPC_Z_V_AUTO_UP");
  pace.sink_m_s = parameters.value(wing ? "FW_T_SINK_MAX" : "MPC_Z_V_AUTO_DN");
  pace.land_m_s = parameters.value("MPC_LAND_SPEED");
  pace.land_slow_below_m = 5.0;  // MPC_LAND_ALT2
  pace.accel_m_s2 = family == vehicle::Family::rover ? 2.0 : std::max(0.5, parameters.value("MPC_ACC_HOR"));
  pace.loiter_radius_m = parameters.value("NAV_LOITER_RAD");
  return pace;
}

Tuning px4_tuning(vehicle::Family family, ParameterTable const& parameters) {
  using base::from_seconds;
  Tuning tuning;
  // A rotorcraft goes through its waypoints as closely as NAV_ACC_RAD's least useful value; a wing needs all of it.
  tuning.waypoint_radius_m = family == vehicle::Family::plane ? parameters.value("NAV_ACC_RAD") : 2.0;
  tuning.rtl_height_m = parameters.value("RTL_RETURN_ALT");
  tuning.rtl_loiter_time = from_seconds(std::max(0.0, parameters.value("RTL_LAND_DELAY")));
  tuning.disarm_delay = from_seconds(parameters.value("COM_DISARM_PRFLT"));
  tuning.disarm_delay_landed = from_seconds(parameters.value("COM_DISARM_LAND"));
  tuning.guided_timeout = from_seconds(parameters.value("COM_OF_LOSS_T"));
  tuning.take_off_height_m = parameters.value("MIS_TAKEOFF_ALT");
  tuning.take_off_without_throttle = true;
  return tuning;
}

}  // namespace

Pace pace_from(Kind const& kind, ParameterTable const& parameters) {
  using enum vehicle::Family;
  auto const family = kind.family;
  if (kind.is_px4()) return px4_pace(family, parameters);
  auto const cm = [&](std::string_view name) { return parameters.value(name) * m_per_cm; };
  Pace pace;
  if (family == plane) {
    pace.speed_m_s = parameters.value("AIRSPEED_CRUISE");
    pace.climb_m_s = parameters.value("TECS_CLMB_MAX");
    pace.sink_m_s = parameters.value("TECS_SINK_MAX");
    pace.loiter_radius_m = parameters.value("WP_LOITER_RAD");
  } else if (family == rover) {
    pace.speed_m_s = parameters.value("WP_SPEED");
    pace.accel_m_s2 = 2.0;
  } else {
    pace.speed_m_s = std::max(0.2, cm("WPNAV_SPEED"));
    pace.climb_m_s = std::max(0.1, cm("WPNAV_SPEED_UP"));
    pace.sink_m_s = std::max(0.1, cm("WPNAV_SPEED_DN"));
    pace.land_m_s = std::max(0.3, cm("LAND_SPEED"));
    pace.land_slow_below_m = cm("LAND_ALT_LOW");
    pace.accel_m_s2 = std::max(0.5, cm("WPNAV_ACCEL"));
    pace.vertical_accel_m_s2 = std::max(0.5, cm("WPNAV_ACCEL_Z"));
  }
  return pace;
}

Tuning tuning_from(Kind const& kind, ParameterTable const& parameters) {
  using enum vehicle::Family;
  auto const family = kind.family;
  if (kind.is_px4()) return px4_tuning(family, parameters);
  using base::from_seconds;
  Tuning tuning;
  tuning.restart_mission = parameters.value("MIS_RESTART") != 0.0;
  tuning.rally_limit_m = parameters.value("RALLY_LIMIT_KM") * 1000.0;
  tuning.rally_includes_home = parameters.value("RALLY_INCL_HOME") != 0.0;
  tuning.guided_timeout = from_seconds(parameters.value("GUID_TIMEOUT", 3.0));
  tuning.trail = {.accuracy_m = std::max(0.5, parameters.value("SRTL_ACCURACY", 2.0)),
                  .most_points = static_cast<std::size_t>(std::clamp(parameters.value("SRTL_POINTS"), 0.0, 500.0))};
  tuning.avoids_fence = (static_cast<unsigned>(parameters.value("AVOID_ENABLE")) & 1U) != 0;
  if (family == plane) {
    tuning.waypoint_radius_m = std::max(1.0, parameters.value("WP_RADIUS"));
    tuning.rtl_height_m = parameters.value("RTL_ALTITUDE");
    tuning.disarm_delay = from_seconds(parameters.value("LAND_DISARMDELAY"));
  } else if (family == rover) {
    tuning.waypoint_radius_m = std::max(0.1, parameters.value("WP_RADIUS"));
  } else {
    auto const options = static_cast<unsigned>(parameters.value("AUTO_OPTIONS"));
    tuning.waypoint_radius_m = std::max(0.05, parameters.value("WPNAV_RADIUS") * m_per_cm);
    tuning.rtl_height_m = parameters.value("RTL_ALT") * m_per_cm;
    tuning.rtl_loiter_time = from_seconds(parameters.value("RTL_LOIT_TIME") * 1e-3);
    tuning.disarm_delay = from_seconds(parameters.value("DISARM_DELAY"));
    tuning.arm_in_auto = (options & 1U) != 0;
    tuning.take_off_without_throttle = (options & 2U) != 0;
  }
  tuning.disarm_delay_landed = tuning.disarm_delay;
  tuning.take_off_height_m = parameters.value("TKOFF_ALT", 50.0);
  return tuning;
}

}  // namespace lapwing::sim
