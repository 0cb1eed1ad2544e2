#pragma once

#include <algorithm>

#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink::internal {

/// How long an answer may take on a link of this round trip: autopilots look into their links some dozen times a
/// second, between other things.
[[nodiscard]] constexpr base::Duration usual_answer(base::Duration round_trip) {
  return 2 * round_trip + std::chrono::milliseconds(200);
}

/// When to say something again to a vehicle that does not answer. Where TIMESYNC has measured the round trip: after
/// what an answer usually takes, half as long again each time, up to `longest`; where it has not: after `longest`.
/// Gives up when it has waited for `tries` times `longest`.
class Repeats {
 public:
  /// The connection outlives it.
  Repeats(Connection const& connection, Address target, int tries, base::Duration longest)
      : connection_(connection), system_id_(target.system), longest_(longest), left_(tries * longest) {}

  [[nodiscard]] bool are_over() const { return left_ <= base::Duration{}; }
  /// How long to wait for the answer to what is sent now.
  [[nodiscard]] base::Duration next() {
    auto wait = longest_;
    if (auto const round_trip = connection_.round_trip(system_id_)) {
      grown_ = grown_ == base::Duration{} ? usual_answer(*round_trip) : grown_ + grown_ / 2;
      wait = std::min(grown_, longest_);
    }
    wait = std::min(wait, left_);
    left_ -= wait;
    return wait;
  }

 private:
  Connection const& connection_;
  std::uint8_t system_id_;
  base::Duration longest_;
  base::Duration left_;
  base::Duration grown_{};
};

}  // namespace lapwing::mavlink::internal
