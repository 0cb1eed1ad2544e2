#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/enums.hpp"
#include "sim/body/trail.hpp"
#include "sim/guidance/goal.hpp"
#include "sim/model/mission_plan.hpp"

namespace lapwing::sim {

/// The distances and times that the vehicle's parameters set, SI.
struct Tuning {
  double waypoint_radius_m = 2.0;
  double rtl_height_m = 15.0;              ///< above home: where a return is flown
  base::Duration rtl_loiter_time{};        ///< above home, before the descent
  base::Duration disarm_delay{};           ///< on the ground with nothing to do; zero: never
  base::Duration disarm_delay_landed{};    ///< the same after a flight
  double take_off_height_m = 50.0;         ///< of a take-off that names none
  base::Duration guided_timeout{};         ///< a velocity setpoint is good for this long
  bool arm_in_auto = false;                ///< AUTO_OPTIONS bit 0
  bool take_off_without_throttle = false;  ///< AUTO_OPTIONS bit 1
  bool restart_mission = false;            ///< MIS_RESTART
  double rally_limit_m = 0.0;              ///< rally points farther away do not count; 0: all do
  bool rally_includes_home = true;         ///< home is one of them
  Trail::Limits trail{};
  bool avoids_fence = false;  ///< AVOID_ENABLE bit 0: guided flight stops at the margin of the fence
};

/// What a flight logic sees at one step.
struct FlightContext {
  Body const& body;
  Airframe const& airframe;
  Site const& site;
  Pace const& pace;
  Tuning const& tuning;
  MissionPlan const& rally;
  geo::Ned home;
  base::Duration now{};    ///< since boot
  double utc_day_s = 0.0;  ///< seconds since UTC midnight
  /// ArduPilot tells every item of its mission in a text.
  bool tells_items = true;
  bool landed = false;  ///< takes itself for landed

  [[nodiscard]] vehicle::Family family() const { return airframe.family; }
};

/// What a step of the autopilot wants told to the ground. Drained by the vehicle after each step.
struct Outbox {
  struct Text {
    mavlink::MavSeverity severity;
    std::string text;
  };
  std::vector<Text> texts;
  std::optional<int>
      reached;  ///< MISSION_ITEM_REACHED; a later one in the same step replaces an earlier, as in ArduPilot
  bool mission_current_changed = false;
  std::vector<mavlink::MissionItem> payload;  ///< commands of the mission for cameras and gimbals
  bool mode_changed = false;
  bool home_changed = false;
  bool fence_breached = false;

  void say(mavlink::MavSeverity severity, std::string text) { texts.push_back({severity, std::move(text)}); }
};

}  // namespace lapwing::sim
