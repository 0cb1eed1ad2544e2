#pragma once

#include <optional>

#include "geo/position.hpp"
#include "robot/platform/body.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::robot {

/// What is to be seen of a robot at one reading.
struct RobotMoment {
  Reading reading = {};
  Motion asked = {};
  bool stands = false;
  double driven_m = 0.0;
  std::optional<vehicle::SitePose> pose = {};  ///< nothing before it has a map
  std::optional<geo::Wgs84> place = {};        ///< the same on the globe, where that is known
};

/// Writes it into the aspects of a vehicle that a robot has.
void show(RobotMoment const& moment, base::TimePoint now, vehicle::VehicleState& state);

}  // namespace lapwing::robot
