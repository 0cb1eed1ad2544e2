#pragma once

#include <array>
#include <cstdint>

#include "mavlink/path/link_report.hpp"

namespace lapwing::mavlink::internal {

/// Follows the 8-bit packet sequence of one source over one path.
class SequenceTracker {
 public:
  /// False for a frame that was seen before (the link delivered it twice).
  [[nodiscard]] bool take(std::uint8_t seq, std::uint16_t checksum);
  /// Notes that the frame just taken told what another path had told already.
  void count_redundant() { ++counters_.redundant; }
  void count_unknown() { ++counters_.unknown_ids; }
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
