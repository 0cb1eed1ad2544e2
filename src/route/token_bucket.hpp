#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.hpp"
#include "base/time.hpp"

namespace lapwing::route {

/// So much a second, and a little saved up: the token bucket. Time comes from the caller.
class TokenBucket {
 public:
  /// `rate_per_s` > 0; infinity: no limit. `burst`: how much may come at once after a pause.
  TokenBucket(double rate_per_s, double burst) : rate_per_s_(rate_per_s), burst_(burst), tokens_(burst) {
    LAPWING_ASSERT(rate_per_s > 0.0, rate_per_s);
  }

  /// When `amount` may be taken: `now` or later. More than a burst is as good as a burst.
  [[nodiscard]] base::TimePoint ready(double amount, base::TimePoint now) const {
    auto const missing = std::min(amount, burst_) - tokens_at(now);
    if (!(missing > 0.0)) return now;
    // Rounded up, so that it is enough when the time has come.
    return now + base::Duration(static_cast<base::Duration::rep>(std::ceil(missing / rate_per_s_ * 1e9)));
  }
  /// Precondition: `ready(amount, now) <= now`.
  void take(double amount, base::TimePoint now) {
    tokens_ = tokens_at(now) - amount;
    filled_ = now;
  }

 private:
  [[nodiscard]] double tokens_at(base::TimePoint now) const {
    if (std::isinf(rate_per_s_)) return std::numeric_limits<double>::infinity();
    return std::min(burst_, tokens_ + base::to_seconds(now - filled_) * rate_per_s_);
  }

  double rate_per_s_;
  double burst_;
  double tokens_;
  base::TimePoint filled_{};
};

}  // namespace lapwing::route
