#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/time.hpp"
#include "mavlink/exchange/internal/repeats.hpp"
#include "mavlink/exchange/internal/smoothed.hpp"

namespace lapwing::mavlink::internal {

/// How long until a message is repeated: as TCP does it (RFC 6298), with bounds that fit a vehicle's link. An
/// autopilot asks again for what it misses only after a second, so on a lossy link the ground's patience decides how
/// long a transfer takes.
class RetransmitTimer {
 public:
  /// `first`: how long at most before anything is measured; `round_trip`: of the link, where it is known.
  RetransmitTimer(base::Duration first, std::optional<base::Duration> round_trip) : first_(first) {
    if (round_trip) first_ = std::min(first_, usual_answer(*round_trip));
  }

  /// The answer to a message that went out once (Karn: an answer to a repeated one tells nothing).
  void measured(base::Duration round_trip) {
    answer_.add(round_trip);
    repeats_ = 0;
  }
  /// Waits longer the next time, until something is measured again. Not much longer once the round trip is known: one
  /// small message at a time congests nothing, so silence then mostly means that it was lost.
  void repeated() { repeats_ = std::min(repeats_ + 1, answer_.is_measured() ? 2 : 4); }
  /// The other side has moved on after a repetition: what was repeated was lost, or the round trip has become longer.
  void moved_on() { repeats_ = std::max(repeats_ - (answer_.is_measured() ? 1 : 0), 0); }

  [[nodiscard]] base::Duration value() const {
    auto const once = answer_.is_measured() ? answer_.bound() : first_;
    return std::min(std::max<base::Duration>(once, shortest) * (1 << repeats_), longest);
  }

 private:
  static constexpr base::Duration shortest =
      std::chrono::milliseconds(50);  // a few turns of an autopilot's telemetry loop
  // The protocol's own default. Beyond it too few tries would fit into what a vehicle waits before it gives up.
  static constexpr base::Duration longest = std::chrono::milliseconds(1500);
  base::Duration first_;
  Smoothed answer_;
  int repeats_ = 0;
};

}  // namespace lapwing::mavlink::internal
