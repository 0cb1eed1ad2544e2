#pragma once

#include "sim/guidance/goal.hpp"

namespace lapwing::sim {

/// The speed at which to close a distance so that a stop with `accel_m_s2` ends there, linear near the end (ArduPilot's
/// square root controller).
[[nodiscard]] double closing_speed(double distance_m, double gain_per_s, double accel_m_s2);

[[nodiscard]] Demand steer_rotor(Goal const& goal, Body const& body, Pace const& pace);
[[nodiscard]] Demand steer_wing(Goal const& goal, Body const& body, Airframe const& airframe, Pace const& pace);
[[nodiscard]] Demand steer_wheels(Goal const& goal, Body const& body, Pace const& pace);

}  // namespace lapwing::sim
