#pragma once

#include <array>
#include <cstdint>

#include "mavlink/connection.hpp"

namespace lapwing::mavlink::internal {

/// Follows the 8-bit packet sequence of one source on one link.
class SequenceTracker {
 public:
  /// False for a frame that was seen before (the link delivered it twice).
  [[nodiscard]] bool take(std::uint8_t seq, std::uint16_t checksum);
  /// The source began anew: the next number is not a gap.
  void restart() {
    started_ = false;
    recent_ = {};
  }
  [[nodiscard]] SourceCounters const& counters() const { return counters_; }

 private:
  struct Seen {
    bool valid = false;
    std::uint8_t seq = 0;
    std::uint16_t checksum = 0;
    friend bool operator==(Seen const&, Seen const&) = default;
  };
  SourceCounters counters_;
  bool started_ = false;
  std::uint8_t expected_ = 0;
  std::array<Seen, 16> recent_{};
  std::size_t next_recent_ = 0;
};

}  // namespace lapwing::mavlink::internal
