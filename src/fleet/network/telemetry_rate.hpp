#pragma once

#include <cstdint>
#include <optional>

#include "base/time.hpp"

namespace lapwing::fleet {

/// How much less telemetry to ask for on a link that cannot carry it: 1 (as usual), 2 or 4 times.
///
/// Doubles while the radio's transmit buffer is less than 30 % free or more than a fifth of the messages is lost,
/// looked at every ten seconds; halves after half a minute without either. Loss that comes from distance is not cured
/// by that, but neither is it made worse.
class TelemetryRate {
 public:
  /// `received` and `lost` are the counters of everything from the vehicle, `buffer_free` 0..1 what its radio said
  /// lately.
  int update(std::uint64_t received, std::uint64_t lost, std::optional<double> buffer_free, base::TimePoint now);
  [[nodiscard]] int factor() const { return factor_; }

 private:
  int factor_ = 1;
  int good_looks_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t lost_ = 0;
  std::optional<base::TimePoint> look_until_;
};

}  // namespace lapwing::fleet
