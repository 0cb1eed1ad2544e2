#pragma once

#include <optional>
#include <vector>

#include "bus/messages/sensors.hpp"
#include "scans/planar.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::scans {

/// Reads sensor_msgs/LaserScan of one laser, as the first of them describes it.
class ScanReader {
 public:
  /// `mount`: where the laser is on the robot. Nothing for a scan that no laser sends: no beams, no step between them.
  [[nodiscard]] static std::optional<ScanReader> make(bus::LaserScan const& first, PlanarFrame const& mount);

  [[nodiscard]] slam::Sensor const& sensor() const { return sensor_; }
  /// The ranges in the sensor's order; nothing when they are not as many.
  [[nodiscard]] std::optional<std::vector<float>> ranges(bus::LaserScan const& scan) const;

 private:
  ScanReader() = default;
  slam::Sensor sensor_;
  bool is_reversed_ = false;
};

}  // namespace lapwing::scans
