#include "sim/safety.hpp"

namespace lapwing::sim {

namespace {

using Action = std::optional<Behaviour>;
using vehicle::Family;

// The numbers of ArduPilot's parameter documentation for each vehicle. What it would do along the recorded way home
// (SMART_RTL) or at a landing sequence is done as a plain return here.

Action battery_action(Family family, int number) {
  if (number == 0) return std::nullopt;
  if (family == Family::rover) return number == 2 || number == 4 ? Behaviour::hold : Behaviour::return_home;
  if (family == Family::plane) return Behaviour::return_home;
  if (family == Family::sub) return Behaviour::land;  // 3: to the surface
  if (number == 7) return Behaviour::hold;
  return number == 1 ? Behaviour::land : Behaviour::return_home;
}

/// FS_GCS_ENABLE of a copter holds the action, too.
Action copter_ground_action(int number) {
  if (number == 5) return Behaviour::land;
  return number == 7 ? Behaviour::hold : Behaviour::return_home;
}

/// FS_ACTION of a rover.
Action rover_action(int number) {
  if (number == 0) return std::nullopt;
  return number == 1 || number == 3 ? Behaviour::return_home : Behaviour::hold;
}

Action fence_action(Family family, int number) {
  if (number == 0) return std::nullopt;
  if (family == Family::rover) return number == 2 ? Behaviour::hold : Behaviour::return_home;
  if (family == Family::plane) return Behaviour::return_home;
  if (family == Family::sub) return Behaviour::hold;
  if (number == 2) return Behaviour::land;
  return number == 4 ? Behaviour::hold : Behaviour::return_home;
}

FenceSettings fence_from(Family family, Parameters const& parameters) {
  constexpr unsigned circle_and_areas = 6;
  constexpr unsigned every_limit = 15;
  auto const options = static_cast<unsigned>(parameters.value("FENCE_OPTIONS"));
  bool const flies = family == Family::copter || family == Family::plane;
  return {.enabled = parameters.value("FENCE_ENABLE") != 0.0,
          .watched = static_cast<unsigned>(parameters.value("FENCE_TYPE")) & (flies ? every_limit : circle_and_areas),
          .radius_m = parameters.value("FENCE_RADIUS"),
          .highest_m = parameters.value("FENCE_ALT_MAX"),
          .lowest_m = parameters.value("FENCE_ALT_MIN"),
          .any_inclusion = (options & 2U) != 0,
          .holds_mode = family == Family::copter && (options & 1U) != 0,
          .action = fence_action(family, static_cast<int>(parameters.value("FENCE_ACTION")))};
}

void watch_ground(Safety& safety, Family family, Parameters const& parameters) {
  auto const enable = static_cast<int>(parameters.value("FS_GCS_ENABLE", parameters.value("FS_GCS_ENABL")));
  safety.watches_ground_station = enable != 0;
  safety.ground_station_patience =
      base::from_seconds(parameters.value("FS_GCS_TIMEOUT", parameters.value("FS_LONG_TIMEOUT", 5.0)));
  if (family == Family::copter) {
    safety.on_ground_station_lost = copter_ground_action(enable);
    safety.keeps_mission = enable == 2;
  } else if (family == Family::rover) {
    safety.on_ground_station_lost = rover_action(static_cast<int>(parameters.value("FS_ACTION")));
  } else if (family == Family::plane) {
    safety.on_ground_station_lost = Behaviour::return_home;
    safety.keeps_mission = parameters.value("FS_LONG_ACTN") == 0.0;
  } else {
    safety.on_ground_station_lost = Behaviour::land;
  }
}

void watch_estimate(Safety& safety, Family family, Parameters const& parameters) {
  auto const number = static_cast<int>(parameters.value("FS_EKF_ACTION"));
  if (family == Family::copter && number != 0) {
    safety.on_estimate_lost = number == 2 ? Behaviour::sink : Behaviour::land;
    safety.in_every_mode = number == 3;
  } else if (family == Family::rover && number == 1) {
    safety.on_estimate_lost = Behaviour::hold;
  }
}

/// GF_ACTION and NAV_DLL_ACT: 1 only warns, 2 hold, 3 return, 5 land; termination is not simulated.
Action px4_action(int number) {
  if (number == 2) return Behaviour::hold;
  if (number == 3) return Behaviour::return_home;
  if (number == 5) return Behaviour::land;
  return std::nullopt;
}

Safety px4_safety(Parameters const& parameters) {
  constexpr unsigned height_circle_and_areas = 7;
  auto const number = [&](std::string_view name) { return static_cast<int>(parameters.value(name)); };
  double const capacity_mah = parameters.value("BAT1_CAPACITY");
  Safety safety{.battery = {.low_mah = parameters.value("BAT_LOW_THR") * capacity_mah,
                            .critical_mah = parameters.value("BAT_CRIT_THR") * capacity_mah}};
  // COM_LOW_BAT_ACT: 0 warns, 2 lands at the critical level, 3 returns there and lands at the emergency level.
  int const low_battery = number("COM_LOW_BAT_ACT");
  if (low_battery == 2) safety.on_critical_battery = Behaviour::land;
  if (low_battery == 3) safety.on_critical_battery = Behaviour::return_home;
  safety.on_ground_station_lost = px4_action(number("NAV_DLL_ACT"));
  safety.watches_ground_station = number("NAV_DLL_ACT") != 0;
  safety.ground_station_patience = base::from_seconds(parameters.value("COM_DL_LOSS_T"));
  safety.on_estimate_lost = Behaviour::land;
  safety.fence = {.enabled = number("GF_ACTION") != 0,
                  .watched = height_circle_and_areas,
                  .radius_m = parameters.value("GF_MAX_HOR_DIST"),
                  .highest_m = parameters.value("GF_MAX_VER_DIST"),
                  .any_inclusion = false,
                  .action = px4_action(number("GF_ACTION"))};
  constexpr int satellites_for_a_fix = 4;
  safety.gps_is_cut_off = number("SIM_GPS_USED") < satellites_for_a_fix;
  return safety;
}

}  // namespace

Safety safety_from(Kind const& kind, Parameters const& parameters) {
  if (kind.is_px4()) return px4_safety(parameters);
  auto const family = kind.family;
  Safety safety{.battery = {.low_v = parameters.value("BATT_LOW_VOLT"),
                            .low_mah = parameters.value("BATT_LOW_MAH"),
                            .critical_v = parameters.value("BATT_CRT_VOLT"),
                            .critical_mah = parameters.value("BATT_CRT_MAH"),
                            .patience = base::from_seconds(parameters.value("BATT_LOW_TIMER"))}};
  safety.on_low_battery = battery_action(family, static_cast<int>(parameters.value("BATT_FS_LOW_ACT")));
  safety.on_critical_battery = battery_action(family, static_cast<int>(parameters.value("BATT_FS_CRT_ACT")));
  watch_ground(safety, family, parameters);
  watch_estimate(safety, family, parameters);
  safety.fence = fence_from(family, parameters);
  safety.gps_is_cut_off = parameters.value("SIM_GPS_DISABLE") != 0.0;
  return safety;
}

}  // namespace lapwing::sim
