#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/time.hpp"

namespace lapwing::onboard {

/// How late frames begin that are due at a set time, counted in steps of 0.1 ms up to 100 ms: however long it counts,
/// it takes the same memory.
class Lateness {
 public:
  void add(base::Duration late);

  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// That share of the frames began no later; to the next 0.1 ms, and beyond 100 ms that of the latest.
  [[nodiscard]] base::Duration quantile(double share) const;
  [[nodiscard]] base::Duration most() const { return most_; }

 private:
  std::array<std::uint64_t, 1000> counts_{};  ///< the last one counts all that were later, too
  std::uint64_t frames_ = 0;
  base::Duration most_{0};
};

/// "1200 frames, late by 0.1 ms in the middle, 0.4 ms at the 99th percentile, 3.1 ms at most".
[[nodiscard]] std::string to_string(Lateness const& lateness);

}  // namespace lapwing::onboard
