#include "mavlink/path/internal/sequence.hpp"

#include <algorithm>

namespace lapwing::mavlink {

SourceCounters& SourceCounters::operator+=(SourceCounters const& more) {
  received += more.received;
  lost += more.lost;
  duplicated += more.duplicated;
  redundant += more.redundant;
  out_of_order += more.out_of_order;
  unknown_ids += more.unknown_ids;
  return *this;
}

namespace internal {

bool SequenceTracker::take(std::uint8_t seq, std::uint16_t checksum) {
  Seen const seen{true, seq, checksum};
  if (std::ranges::find(recent_, seen) != recent_.end()) {
    ++counters_.duplicated;
    return false;
  }
  recent_[next_recent_] = seen;
  next_recent_ = (next_recent_ + 1) % recent_.size();
  ++counters_.received;

  auto const ahead = static_cast<std::uint8_t>(seq - expected_);
  if (started_ && ahead >= 128) {
    // Behind the newest: it was counted as lost and came after all.
    ++counters_.out_of_order;
    if (counters_.lost > 0) --counters_.lost;
    return true;
  }
  if (started_) counters_.lost += ahead;
  started_ = true;
  expected_ = static_cast<std::uint8_t>(seq + 1);
  return true;
}

}  // namespace internal

}  // namespace lapwing::mavlink
