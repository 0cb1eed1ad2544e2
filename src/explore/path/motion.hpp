#pragma once

namespace lapwing::explore {

/// What a carrier is asked to do.
struct Motion {
  double speed_m_s = 0.0;
  double turn_rad_s = 0.0;
};

/// What the carrier can do (seed 001: the wheels turn at 0.3 m/s at most).
struct CarrierLimits {
  double radius_m = 0.18;         ///< of the disc that the robot is, as a TurtleBot 2
  double safe_distance_m = 0.05;  ///< nearer than this it does not come to anything
  double speed_m_s = 0.3;
  double near_speed_m_s = 0.16;  ///< near walls
  double acceleration_m_s2 = 0.3;
  double turn_rad_s = 1.0;
  double turn_acceleration_rad_s2 = 2.0;
};

}  // namespace lapwing::explore
