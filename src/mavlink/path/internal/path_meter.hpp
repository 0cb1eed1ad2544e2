#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "mavlink/path/internal/sequence.hpp"

namespace lapwing::mavlink::internal {

/// Means over a sliding window of 10 s.
struct PathRates {
  double messages_per_s = 0.0;
  double bytes_per_s = 0.0;
  double loss = 0.0;  ///< 0..1, by the gaps in the sequence
};

/// How one path (a source at one far end) does: rates and losses of late, round trips, silence.
class PathMeter {
 public:
  /// A message of `bytes` came; `before` are the counters without it. Costs next to nothing but once a second.
  void heard(std::size_t bytes, SourceCounters const& before, base::TimePoint now) {
    if (now >= next_mark_) mark(before, now);
    heard_ = now;
    bytes_ += bytes;
  }
  [[nodiscard]] PathRates rates(SourceCounters const& counters, base::TimePoint now) const;
  [[nodiscard]] base::TimePoint last_heard() const { return heard_; }
  /// Silent for longer than chance explains: ten messages at its rate, but at least 1 s, and two heartbeats at most.
  [[nodiscard]] bool is_alive(SourceCounters const& counters, base::TimePoint now) const;

  void asked() { ++unanswered_; }
  void answered(base::Duration round_trip);
  /// The median of the last five answers.
  [[nodiscard]] std::optional<base::Duration> round_trip() const;
  /// Answered before and does not any more: what we send does not arrive.
  [[nodiscard]] bool is_deaf() const { return trips_ > 0 && unanswered_ >= 3; }

 private:
  /// What had been counted at a moment, about one a second.
  struct Mark {
    base::TimePoint at = base::TimePoint::min();
    std::uint64_t received = 0;
    std::uint64_t lost = 0;
    std::uint64_t bytes = 0;
  };
  void mark(SourceCounters const& counters, base::TimePoint now);

  std::array<Mark, 11> marks_{};  ///< a ring
  std::size_t newest_ = 0;
  base::TimePoint next_mark_ = base::TimePoint::min();
  base::TimePoint heard_ = base::TimePoint::min();
  std::uint64_t bytes_ = 0;
  std::array<base::Duration, 5> round_trips_{};  ///< a ring
  std::size_t trips_ = 0;
  int unanswered_ = 0;
};

}  // namespace lapwing::mavlink::internal
