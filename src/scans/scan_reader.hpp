#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "bus/messages/sensors.hpp"
#include "scans/planar.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::scans {

/// When the beams of a scan were taken, in the order of its sensor.
struct BeamTimes {
  std::chrono::nanoseconds first{};
  std::chrono::nanoseconds step{0};  ///< below zero: the sensor's last beam was taken first
  std::size_t beams = 0;

  [[nodiscard]] std::chrono::nanoseconds at(std::size_t beam) const { return first + static_cast<long>(beam) * step; }
  [[nodiscard]] std::chrono::nanoseconds middle() const { return first + static_cast<long>(beams - 1) * step / 2; }
  [[nodiscard]] std::chrono::nanoseconds begin() const { return std::min(first, at(beams - 1)); }
  [[nodiscard]] std::chrono::nanoseconds end() const { return std::max(first, at(beams - 1)); }
};

/// A scan with where each of its beams looked from, as the middle of it would have seen what it saw. Nothing where
/// nobody knows where the robot was in the middle; where that is all that is known, all beams looked from there.
/// `pose_at`: by odometry. Preconditions: as many ranges as the sensor has beams, and at least one.
[[nodiscard]] std::optional<slam::Scan> lay(
    std::vector<float> ranges_m, slam::Sensor const& sensor, BeamTimes const& times,
    std::function<std::optional<slam::Pose2>(std::chrono::nanoseconds)> const& pose_at);

/// Reads sensor_msgs/LaserScan of one laser, as the first of them describes it. Many a small scanner turns faster and
/// slower, and gives a few beams more or less with each turn (LDS-02, RPLIDAR): these are laid on the first one's.
class ScanReader {
 public:
  /// `mount`: where the laser is on the robot. Nothing for a scan that no laser sends: no beams, no step between them.
  [[nodiscard]] static std::optional<ScanReader> make(bus::LaserScan const& first, PlanarFrame const& mount);

  [[nodiscard]] slam::Sensor const& sensor() const { return sensor_; }
  /// It looks over the same angles, by half to twice as many beams: the same laser sends it.
  [[nodiscard]] bool fits(bus::LaserScan const& scan) const;
  /// The ranges in the sensor's order; nothing for a scan that does not fit.
  [[nodiscard]] std::optional<std::vector<float>> ranges(bus::LaserScan const& scan) const;
  /// `first`: when its first beam was taken, which is what its stamp says. All at once where its `time_increment` is
  /// none, or makes it take longer than lasers do.
  [[nodiscard]] BeamTimes times(bus::LaserScan const& scan, std::chrono::nanoseconds first) const;

 private:
  ScanReader() = default;
  slam::Sensor sensor_;
  bool is_reversed_ = false;
  double first_rad_ = 0.0;  ///< where the first scan's beams look, as it says it
  double step_rad_ = 0.0;
};

}  // namespace lapwing::scans
