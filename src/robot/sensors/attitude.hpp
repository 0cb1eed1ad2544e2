#pragma once

#include "firmware/frames/records.hpp"

namespace lapwing::robot {

/// How the body is turned against the level frame: about z, then y, then x of the turned body (Tait-Bryan, z-y'-x").
struct Attitude {
  double yaw_rad = 0;    ///< to the left, in [-pi, pi]
  double pitch_rad = 0;  ///< nose down is positive (y is to the left), in [-pi/2, pi/2]
  double roll_rad = 0;   ///< left side up is positive, in [-pi, pi]
};

/// Of a quaternion that turns body into level frame, of any length but zero. With the nose straight up or down yaw
/// and roll turn about the same axis: all of it is said to be yaw.
///
/// Source: J. Diebel, "Representing Attitude: Euler Angles, Unit Quaternions, and Rotation Vectors" (Stanford, 2006),
/// with the angles named for x ahead, y left, z up.
[[nodiscard]] Attitude attitude(firmware::Quaternion const& orientation);

}  // namespace lapwing::robot
