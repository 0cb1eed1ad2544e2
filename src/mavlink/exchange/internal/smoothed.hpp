#pragma once

#include <cmath>

#include "base/time.hpp"

namespace lapwing::mavlink::internal {

/// Smoothed mean and deviation of a time, as TCP measures round trips (RFC 6298, section 2).
class Smoothed {
 public:
  void add(base::Duration sample) {
    auto const s = base::to_seconds(sample);
    deviation_s_ = is_measured_ ? 0.75 * deviation_s_ + 0.25 * std::abs(mean_s_ - s) : s / 2;
    mean_s_ = is_measured_ ? 0.875 * mean_s_ + 0.125 * s : s;
    is_measured_ = true;
  }
  [[nodiscard]] bool is_measured() const { return is_measured_; }
  /// Hardly any sample is larger.
  [[nodiscard]] base::Duration bound() const { return base::from_seconds(mean_s_ + 4 * deviation_s_); }
  [[nodiscard]] double mean_s() const { return mean_s_; }

 private:
  bool is_measured_ = false;
  double mean_s_ = 0.0;
  double deviation_s_ = 0.0;
};

}  // namespace lapwing::mavlink::internal
