#pragma once

#include <optional>

#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// What every reader shares: sensors told apart, scans in order of time, readings that mean "nothing came back".
class LogBuilder {
 public:
  static constexpr std::size_t most_beams = 20'000;
  static constexpr std::size_t most_readings = 400'000'000;  ///< of a log; 1.6 GB

  static constexpr std::size_t most_sensors = 200;

  /// The number of that sensor, a new one or the one that is the same. Nothing: there are too many.
  [[nodiscard]] std::optional<int> sensor(Sensor const& sensor);
  /// False: there are too many readings.
  [[nodiscard]] bool add(Scan scan);
  [[nodiscard]] bool is_empty() const { return log_.scans.empty(); }

  /// Sorted by time, or as they were added where most stamps are equal; where a log's largest reading comes again and
  /// again it is what the sensor says when nothing came back.
  [[nodiscard]] ScanLog finish() &&;

 private:
  ScanLog log_;
  std::size_t readings_ = 0;
};

}  // namespace lapwing::slam
