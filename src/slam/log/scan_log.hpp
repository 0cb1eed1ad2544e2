#pragma once

#include <chrono>
#include <vector>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// Seconds since whatever epoch a log counts from.
using LogTime = std::chrono::duration<double>;

/// How one kind of scan was taken: which way each of its beams looks and from where.
struct Sensor {
  std::vector<float> bearings_rad;                    ///< of each beam, in the robot's frame; ascending
  Eigen::Vector2f mount_m = Eigen::Vector2f::Zero();  ///< where the beams begin, in the robot's frame
  /// Readings from here on say that nothing came back.
  float no_return_m = 1e9F;
  /// Of a ring of sonars: half the angle of the cone in which each hears the nearest thing. 0: beams.
  float half_cone_rad = 0.0F;

  /// Something came back from there; nothing did of what is too far, 0 or not a number.
  [[nodiscard]] bool is_reading(float range_m) const { return range_m > 0.0F && range_m < no_return_m; }
  friend bool operator==(Sensor const&, Sensor const&) = default;
};

struct Scan {
  LogTime time{0.0};
  int sensor = 0;               ///< of the log's sensors
  Pose2 odometry;               ///< of the robot, in a frame that drifts
  std::vector<float> ranges_m;  ///< one a beam; not a number, 0 or too large: nothing was measured
  /// Which way each beam looked from `odometry`, ascending, within the sensor's own directions: of a scanner that turns
  /// while its robot moves. Empty: as the sensor says.
  std::vector<float> bearings_rad = {};
};

[[nodiscard]] inline std::vector<float> const& bearings_of(Scan const& scan, Sensor const& sensor) {
  return scan.bearings_rad.empty() ? sensor.bearings_rad : scan.bearings_rad;
}

/// A recorded drive, in order of time. Robots may change sensors between scans.
struct ScanLog {
  std::vector<Sensor> sensors;
  std::vector<Scan> scans;
  bool has_odometry = true;  ///< without, each scan's odometry is the origin
  bool has_times = true;     ///< without, a scan counts a tenth of a second
};

}  // namespace lapwing::slam
