#pragma once

#include "autonomy/energy/reserve.hpp"
#include "autonomy/interface/wanted_place.hpp"
#include "base/time.hpp"

namespace lapwing::autonomy {

/// By what the machine decides. The defaults are those of a copter of ArduPilot with a link of a few hundred metres.
struct Options {
  base::Duration link_lost = std::chrono::seconds(3);               ///< of silence of the operator
  base::Duration flight_controller_lost = std::chrono::seconds(2);  ///< twice its heartbeat's period
  base::Duration health_period = std::chrono::seconds(1);           ///< of the processes' reports
  int missed_reports = 3;                                           ///< after so many a process has failed
  base::Duration place_patience = std::chrono::seconds(3);          ///< without a GPS fix or a position
  base::Duration battery_patience = std::chrono::seconds(5);        ///< without a word of it

  base::Duration repeat = std::chrono::seconds(1);         ///< what was asked and not seen is asked again
  base::Duration mode_patience = std::chrono::seconds(5);  ///< for a mode that is asked for
  base::Duration arm_patience = std::chrono::seconds(20);  ///< until it is armed, each time
  base::Duration arm_repeat = std::chrono::seconds(3);     ///< what the checks and the motors' start may take

  int most_arm_requests = 5;  ///< from Idle to the take-off, re-arming counted
  base::Duration disarm_patience = std::chrono::seconds(10);
  base::Duration kill_holds = std::chrono::seconds(5);  ///< at least: an earlier request may still arm
  double slowest_climb_m_s = 0.5;                       ///< by which a take-off that gets nowhere is seen
  base::Duration spool_up = std::chrono::seconds(15);   ///< what a take-off may take besides
  base::Duration setpoint_period = std::chrono::milliseconds(100);
  base::Duration verdict_settles = std::chrono::milliseconds(500);  ///< before, it may be about the place before
  base::Duration verdict_patience = std::chrono::seconds(3);
  base::Duration setpoint_lasts = std::chrono::seconds(1);  ///< of the planner
  base::Duration heartbeat_period = std::chrono::milliseconds(500);

  double height_reached_m = 0.5;
  double place_reached_m = 1.0;
  double already_up_m = 5.0;  ///< from there no take-off is needed
  double in_the_air_m = 2.0;  ///< below, a descent is not broken off

  double least_battery_to_arm = 0.20;  ///< of a full charge
  ReserveOptions reserve = {};
  PlaceLimits places = {};
};

}  // namespace lapwing::autonomy
