#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/messages.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot::rover {

/// Scans from what MAVLink has for ranges: OBSTACLE_DISTANCE, which a companion computer makes of a laser, and
/// DISTANCE_SENSOR, one message for each of up to eight directions. Where the first is heard, the second is not needed,
/// for it is made of the same.
///
/// What the first messages say of the directions holds: a map is made by it. Ranges begin in the rover's middle, which
/// is all that the messages say.
class RoverRanges {
 public:
  /// A whole scan, in the order of `sensor()`; nothing for what gives none.
  [[nodiscard]] std::optional<std::vector<float>> take(mavlink::ObstacleDistance const& seen);
  [[nodiscard]] std::optional<std::vector<float>> take(mavlink::DistanceSensor const& seen, base::TimePoint now);

  /// Null until the first scan.
  [[nodiscard]] slam::Sensor const* sensor() const { return sensor_ ? &*sensor_ : nullptr; }

 private:
  struct Beam {
    double distance_m = 0.0;
    double least_m = 0.0;
    double most_m = 0.0;
    base::TimePoint heard{};
  };
  static constexpr std::size_t directions = 8;

  /// By the bearings of the message's directions, of which `order_` has those that there are.
  void describe(std::vector<double> const& bearings_rad, double most_m);
  [[nodiscard]] std::optional<std::vector<float>> beams_as_scan(base::TimePoint now);

  std::optional<slam::Sensor> sensor_;
  std::vector<std::size_t> order_;  ///< which of the message's directions each beam of the sensor is
  bool is_of_sectors_ = false;      ///< of OBSTACLE_DISTANCE
  std::array<std::optional<Beam>, directions> beams_;
  std::optional<base::TimePoint> beams_since_;
  std::optional<base::TimePoint> told_;
};

}  // namespace lapwing::robot::rover
