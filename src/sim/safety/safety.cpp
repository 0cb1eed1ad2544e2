#include "sim/safety/safety.hpp"

namespace lapwing::sim {

namespace {

using namespace std::chrono_literals;
using vehicle::Family;
using enum Behaviour;

// The numbers of ArduPilot's parameter documentation for each vehicle, and what it tries next where the first does not
// go. What it would do at a landing sequence of its mission is done as a plain return here; termination is not
// simulated.

/// BATT_FS_LOW_ACT and BATT_FS_CRT_ACT of a copter.
Reaction copter_battery_action(int number) {
  switch (number) {
    case 0:
    case 5: return {};
    case 1: return {land};
    case 3: return {retrace, return_home, land};
    case 4: return {retrace, land};
    case 7: return {hold, land};
    default: return {return_home, land};
  }
}

/// FS_ACTION, FENCE_ACTION and the battery's of a rover.
Reaction rover_action(int number) {
  switch (number) {
    case 0:
    case 5: return {};
    case 2:
    case 6: return {hold};
    case 3: return {retrace, return_home, hold};
    case 4: return {retrace, hold};
    default: return {return_home, hold};
  }
}

Reaction battery_action(Family family, int number) {
  if (family == Family::copter) return copter_battery_action(number);
  if (family == Family::rover) return rover_action(number);
  if (number == 0) return {};
  if (family == Family::sub) return {land};  // 3: to the surface
  return number == 3 ? Reaction{} : Reaction{return_home};
}

/// FS_GCS_ENABLE of a copter holds the action, too.
Reaction copter_ground_action(int number) {
  switch (number) {
    case 3: return {retrace, return_home, land};
    case 4: return {retrace, land};
    case 5: return {land};
    case 7: return {hold, land};
    default: return {return_home, land};
  }
}

/// FS_THR_ENABLE of a copter.
Reaction copter_radio_action(int number) {
  switch (number) {
    case 1:
    case 2:
    case 6: return {return_home, land};
    case 4: return {retrace, return_home, land};
    case 5: return {retrace, land};
    case 7: return {hold, land};
    default: return {land};
  }
}

/// FS_LONG_ACTN of a plane; 0 leaves a mission and guided flight alone.
Reaction plane_long_action(int number) {
  if (number == 4) return {mission};
  return number == 2 || number == 3 ? Reaction{manual} : Reaction{return_home};
}

Reaction fence_action(Family family, int number) {
  if (number == 0) return {};
  if (family == Family::rover) return rover_action(number);
  if (family == Family::sub) return {hold};
  if (family == Family::plane) {
    if (number == 1 || number == 8) return {return_home};
    return number == 6 || number == 7 ? Reaction{guided} : Reaction{};
  }
  switch (number) {
    case 2: return {land};
    case 3: return {retrace, return_home, land};
    case 4: return {hold, land};
    case 5: return {retrace, land};
    default: return {return_home, land};
  }
}

FenceSettings fence_from(Family family, ParameterTable const& parameters) {
  constexpr unsigned circle_and_areas = 6;
  constexpr unsigned every_limit = 15;
  auto const options = static_cast<unsigned>(parameters.value("FENCE_OPTIONS"));
  bool const flies = family == Family::copter || family == Family::plane;
  FenceSettings fence{
      .enabled = parameters.value("FENCE_ENABLE") != 0.0,
      .watched = static_cast<unsigned>(parameters.value("FENCE_TYPE")) & (flies ? every_limit : circle_and_areas),
      .radius_m = parameters.value("FENCE_RADIUS"),
      .highest_m = parameters.value("FENCE_ALT_MAX"),
      .lowest_m = parameters.value("FENCE_ALT_MIN"),
      .margin_m = parameters.value("FENCE_MARGIN"),
      .tells_margin = (options & 4U) != 0,
      .any_inclusion = (options & 2U) != 0,
      .holds_mode = flies && (options & 1U) != 0,
      .tells_breach = family != Family::rover,
      .action = fence_action(family, static_cast<int>(parameters.value("FENCE_ACTION")))};
  fence.far_action = fence.action;
  if (fence.action.empty()) return fence;
  if (family == Family::copter) fence.far_action = {land};
  if (family == Family::rover) fence.far_action = {hold};
  return fence;
}

void watch_ground(Safety& safety, Family family, ParameterTable const& parameters) {
  auto const number = [&](std::string_view name) { return static_cast<int>(parameters.value(name)); };
  auto const enable = static_cast<int>(parameters.value("FS_GCS_ENABLE", parameters.value("FS_GCS_ENABL")));
  auto& ground = safety.ground;
  ground.watched = enable != 0;
  ground.patience = base::from_seconds(parameters.value("FS_GCS_TIMEOUT", parameters.value("FS_LONG_TIMEOUT", 5.0)));
  if (family == Family::copter) {
    auto const options = static_cast<unsigned>(parameters.value("FS_OPTIONS"));
    ground.reaction = copter_ground_action(enable);
    ground.keeps_mission = (options & 2U) != 0;
    ground.keeps_pilot = (options & 16U) != 0;
  } else if (family == Family::rover) {
    ground.patience += base::from_seconds(parameters.value("FS_TIMEOUT"));
    ground.reaction = rover_action(number("FS_ACTION"));
    ground.keeps_mission = enable == 2;
  } else if (family == Family::plane) {
    ground.reaction = plane_long_action(number("FS_LONG_ACTN"));
    ground.keeps_mission = ground.keeps_guided = number("FS_LONG_ACTN") == 0;
  } else {
    ground.reaction = {land};
  }
}

/// An underwater vehicle has no radio.
void watch_radio(Safety& safety, Family family, ParameterTable const& parameters) {
  auto const number = [&](std::string_view name) { return static_cast<int>(parameters.value(name)); };
  int const failure = number("SIM_RC_FAIL");
  safety.signal = failure == 1 ? RadioSignal::none : failure == 2 ? RadioSignal::low_throttle : RadioSignal::good;
  auto& radio = safety.radio;
  auto const silence = base::from_seconds(parameters.value("RC_FS_TIMEOUT"));
  safety.low_throttle_patience = 100ms;
  if (family == Family::copter) {
    auto const options = static_cast<unsigned>(parameters.value("FS_OPTIONS"));
    radio = {.watched = number("FS_THR_ENABLE") != 0,
             .patience = silence,
             .reaction = copter_radio_action(number("FS_THR_ENABLE")),
             .keeps_mission = (options & 1U) != 0,
             .keeps_guided = (options & 4U) != 0};
    safety.finishes_landing = (options & 8U) != 0;
  } else if (family == Family::rover) {
    auto const more = base::from_seconds(parameters.value("FS_TIMEOUT"));
    radio = {.watched = number("FS_THR_ENABLE") != 0,
             .patience = 500ms + more,
             .reaction = rover_action(number("FS_ACTION")),
             .keeps_mission = number("FS_THR_ENABLE") == 2};
    safety.low_throttle_patience += more;
  } else if (family == Family::plane) {
    bool const keeps = number("FS_LONG_ACTN") == 0;
    radio = {.watched = number("THR_FAILSAFE") == 1,
             .patience = silence + 200ms,
             .reaction = plane_long_action(number("FS_LONG_ACTN")),
             .keeps_mission = keeps,
             .keeps_guided = keeps};
    safety.low_throttle_patience = 200ms;
    safety.long_after = base::from_seconds(parameters.value("FS_LONG_TIMEOUT"));
  }
}

void watch_estimate(Safety& safety, Family family, ParameterTable const& parameters) {
  auto const number = static_cast<int>(parameters.value("FS_EKF_ACTION"));
  if (family == Family::copter && number != 0) {
    safety.on_estimate_lost = {number == 2 ? sink : land};
    safety.in_every_mode = number == 3;
  } else if (family == Family::rover && number == 1) {
    safety.on_estimate_lost = {hold};
  }
}

/// GF_ACTION and NAV_DLL_ACT: 1 only warns, 2 hold, 3 return, 5 land.
Reaction px4_action(int number) {
  if (number == 2) return {hold, land};
  if (number == 3) return {return_home, land};
  if (number == 5) return {land};
  return {};
}

Safety px4_safety(ParameterTable const& parameters) {
  constexpr unsigned height_circle_and_areas = 7;
  auto const number = [&](std::string_view name) { return static_cast<int>(parameters.value(name)); };
  double const capacity_mah = parameters.value("BAT1_CAPACITY");
  Safety safety{.battery = {.low_mah = parameters.value("BAT_LOW_THR") * capacity_mah,
                            .critical_mah = parameters.value("BAT_CRIT_THR") * capacity_mah}};
  // COM_LOW_BAT_ACT: 0 warns, 2 lands at the critical level, 3 returns there and lands at the emergency level.
  int const low_battery = number("COM_LOW_BAT_ACT");
  if (low_battery == 2) safety.on_critical_battery = {land};
  if (low_battery == 3) safety.on_critical_battery = {return_home, land};
  safety.ground = {.watched = number("NAV_DLL_ACT") != 0,
                   .patience = base::from_seconds(parameters.value("COM_DL_LOSS_T")),
                   .reaction = px4_action(number("NAV_DLL_ACT"))};
  safety.on_estimate_lost = {land};
  safety.finishes_landing = true;
  safety.fence = {.enabled = number("GF_ACTION") != 0,
                  .watched = height_circle_and_areas,
                  .radius_m = parameters.value("GF_MAX_HOR_DIST"),
                  .highest_m = parameters.value("GF_MAX_VER_DIST"),
                  .again_after_m = 0.0,
                  .action = px4_action(number("GF_ACTION"))};
  safety.fence.far_action = safety.fence.action;
  constexpr int satellites_for_a_fix = 4;
  safety.gps_is_cut_off = number("SIM_GPS_USED") < satellites_for_a_fix;
  return safety;
}

}  // namespace

Safety safety_from(Kind const& kind, ParameterTable const& parameters) {
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
  watch_radio(safety, family, parameters);
  watch_estimate(safety, family, parameters);
  safety.fence = fence_from(family, parameters);
  if (family == Family::plane) safety.fence.again_after_m = 100.0;
  safety.gps_is_cut_off = parameters.value("SIM_GPS_DISABLE") != 0.0;
  return safety;
}

}  // namespace lapwing::sim
