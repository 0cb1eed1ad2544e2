#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "base/time.hpp"

namespace lapwing::link::operator_link {

/// How long to wait before the next attempt: twice as long each time up to a most, less a random part of up to a half,
/// so that a fleet that lost its station together does not come back together. A value; the same seed waits the same.
class BackOff {
 public:
  struct Limits {
    base::Duration first = std::chrono::milliseconds(250);
    base::Duration most = std::chrono::seconds(8);
  };
  BackOff(Limits limits, std::uint64_t seed) : limits_(limits), next_(limits.first), random_(seed) {}

  [[nodiscard]] base::Duration wait() {
    auto const full = std::exchange(next_, std::min(limits_.most, next_ * 2));
    std::uniform_int_distribution<base::Duration::rep> less(0, full.count() / 2);
    return full - base::Duration(less(random_));
  }
  void reset() { next_ = limits_.first; }

 private:
  Limits limits_;
  base::Duration next_;
  std::mt19937_64 random_;
};

}  // namespace lapwing::link::operator_link
