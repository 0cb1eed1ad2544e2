#pragma once

#include <vector>

#include "firmware/frames/description.hpp"
#include "sim/building/body/drive.hpp"
#include "sim/building/picture/camera.hpp"
#include "sim/building/sensors/imu.hpp"
#include "sim/building/sensors/laser.hpp"
#include "sim/building/sensors/sonar.hpp"

namespace lapwing::sim::building {

/// What a simulated robot is made of. The defaults are the robot of seed 001 with a scanner and a camera.
struct RobotSettings {
  DriveSettings drive;
  std::vector<SonarSettings> sonars = seed_sonars(drive.radius_m);
  double sonar_period_s = 0.02;  ///< they fire in turn, so that none hears another
  LaserSettings laser;
  ImuSettings imu;
  CameraSettings camera;  ///< that looks ahead
  std::vector<CameraSettings> side_cameras = seed_side_cameras();
  double top_speed_m_s = 0.3;  ///< as the board's description has it
  double braking_m_s2 = 1.0;   ///< likewise
  double battery_full_v = 12.6;
  double battery_empty_v = 10.5;
  double battery_lasts_s = 25'200.0;  ///< seven hours: a Kobuki with its large battery

  /// The same robot, larger or smaller.
  [[nodiscard]] static RobotSettings of_radius(double radius_m);
  /// Ahead up to 7.5 m, 30 and 90 degrees to both sides up to 5 m; from the hull's rim.
  [[nodiscard]] static std::vector<SonarSettings> seed_sonars(double radius_m);
  /// Four like the one that looks ahead, to the sides: 50 degrees off straight ahead, which see walls early and aslant,
  /// and 103 degrees, which see them when the robot has come past.
  [[nodiscard]] static std::vector<CameraSettings> seed_side_cameras();
};

/// What the board of such a robot says of it.
[[nodiscard]] firmware::Description description_of(RobotSettings const& settings);

}  // namespace lapwing::sim::building
