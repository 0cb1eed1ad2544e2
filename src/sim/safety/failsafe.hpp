#pragma once

#include <optional>

#include "base/time.hpp"
#include "sim/body/battery_pack.hpp"

namespace lapwing::sim {

/// Notices that what came regularly stopped, and that it came back: a ground station's heartbeats, a transmitter's
/// pulses.
class SilenceWatch {
 public:
  enum class Event { none, lost, returned };
  void heard(base::Duration now) { heard_ = now; }
  /// Never triggers before anything was heard, nor while disabled.
  Event update(base::Duration now, bool enabled, base::Duration patience);
  [[nodiscard]] bool active() const { return active_; }

 private:
  std::optional<base::Duration> heard_;
  bool active_ = false;
};

/// The thresholds of ArduPilot's battery monitor; 0 switches one off.
struct BatteryLimits {
  double low_v = 0.0;
  double low_mah = 0.0;
  double critical_v = 0.0;
  double critical_mah = 0.0;
  base::Duration patience{};  ///< a low voltage has to last this long
};

/// Notices a battery that gets low, then critical: once each.
class BatteryWatch {
 public:
  enum class Level { good, low, critical };
  /// The level just reached, if it is new.
  std::optional<Level> update(base::Duration now, BatteryPack const& pack, BatteryLimits const& limits);
  [[nodiscard]] bool active() const { return level_ != Level::good; }

 private:
  bool lasts(bool below, std::optional<base::Duration>& since, base::Duration now, base::Duration patience) const;
  Level level_ = Level::good;
  std::optional<base::Duration> low_since_;
  std::optional<base::Duration> critical_since_;
};

}  // namespace lapwing::sim
