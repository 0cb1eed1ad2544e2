#include "mavlink/path/internal/path_meter.hpp"

#include <algorithm>

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

base::Duration constexpr window = 10s;
base::Duration constexpr mark_period = 1s;
/// Two heartbeats and a little.
base::Duration constexpr longest_silence = 2500ms;
base::Duration constexpr shortest_silence = 1s;

}  // namespace

void PathMeter::mark(SourceCounters const& counters, base::TimePoint now) {
  newest_ = (newest_ + 1) % marks_.size();
  marks_[newest_] = {now, counters.received, counters.lost, bytes_};
  next_mark_ = now + mark_period;
}

PathRates PathMeter::rates(SourceCounters const& counters, base::TimePoint now) const {
  Mark const* oldest = nullptr;
  for (auto const& mark : marks_)
    if (mark.at != base::TimePoint::min() && now - mark.at <= window && (!oldest || mark.at < oldest->at))
      oldest = &mark;
  if (!oldest) return {};
  // What came within the first second says little about a rate.
  auto const seconds = base::to_seconds(std::max<base::Duration>(now - oldest->at, mark_period));
  auto const received = static_cast<double>(counters.received - oldest->received);
  // A late message takes a loss back, perhaps one from before the window.
  auto const lost = counters.lost > oldest->lost ? static_cast<double>(counters.lost - oldest->lost) : 0.0;
  return {.messages_per_s = received / seconds,
          .bytes_per_s = static_cast<double>(bytes_ - oldest->bytes) / seconds,
          .loss = received + lost > 0 ? lost / (received + lost) : 0.0};
}

bool PathMeter::is_alive(SourceCounters const& counters, base::TimePoint now) const {
  if (heard_ == base::TimePoint::min()) return false;
  auto const silence = now - heard_;
  if (silence <= shortest_silence) return true;
  if (silence > longest_silence) return false;
  // The rate that it had while it spoke.
  auto const rate = rates(counters, heard_).messages_per_s;
  return base::to_seconds(silence) * rate <= 10.0;
}

void PathMeter::answered(base::Duration round_trip) {
  round_trips_[trips_++ % round_trips_.size()] = round_trip;
  unanswered_ = 0;
}

std::optional<base::Duration> PathMeter::round_trip() const {
  if (trips_ == 0) return std::nullopt;
  auto sorted = round_trips_;
  auto const end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(trips_, sorted.size()));
  auto const middle = sorted.begin() + (end - sorted.begin()) / 2;
  std::nth_element(sorted.begin(), middle, end);
  return *middle;
}

}  // namespace lapwing::mavlink::internal
