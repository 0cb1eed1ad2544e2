#pragma once

#include <cstdint>
#include <string>

#include "base/log.hpp"
#include "base/time.hpp"

namespace lapwing::base {

/// Lets lines of one source pass up to a burst, then only so many a second, and counts those that it holds back: a loop
/// that writes without end fills no disk and drowns nobody. An honest source never meets it: thousands of lines at once
/// pass, and then a line every few milliseconds.
///
/// Once shut it opens for a second's worth of lines together, so that "12,345 lines left out" stands between pieces
/// that can be read, not between single lines. A value that knows no clock but the times it is given.
class FloodGate {
 public:
  struct Limits {
    double burst = 10'000.0;
    double per_s = 200.0;
  };

  FloodGate() : FloodGate(Limits{}) {}
  explicit FloodGate(Limits limits) : limits_(limits), room_(limits.burst) {}

  /// Whether the next lines (a long text counts as several) may pass.
  [[nodiscard]] bool admit(UtcTime now, double lines = 1.0);
  /// Something was held back and has not been told, and a line would pass now.
  [[nodiscard]] bool has_calmed(UtcTime now);
  /// Lines are being held back.
  [[nodiscard]] bool is_shut() const { return is_shut_; }
  /// How many were held back since this was asked last.
  [[nodiscard]] std::uint64_t take_left_out();

 private:
  void refill(UtcTime now);

  Limits limits_;
  double room_;
  UtcTime filled_{};
  bool is_shut_ = false;
  double left_out_ = 0.0;
};

/// "12,345 lines left out".
[[nodiscard]] std::string left_out_text(std::uint64_t lines);

/// A sink that is spared floods: each source has a gate of its own, so that one that floods drowns no other. How much
/// was left out is said with its next line, or with anybody's once it is quiet. Errors always pass.
[[nodiscard]] LogHub::Sink without_floods(LogHub::Sink sink);

}  // namespace lapwing::base
