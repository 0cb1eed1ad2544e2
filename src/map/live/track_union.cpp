#include "map/live/internal/track_union.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace lapwing::map::internal {

namespace {

using Samples = std::vector<Track::Sample>;

auto order_of(Track::Sample const& sample) {
  return std::tuple(sample.at, sample.position.x(), sample.position.y(), sample.up_m);
}

/// `thinning` is at least 1.
base::Duration span_of(int thinning) {
  constexpr base::Duration shortest = std::chrono::milliseconds(125);
  constexpr int longest = 31;  // 2^31 eighths of a second are 8 years
  return shortest * (std::int64_t{1} << std::min(thinning - 1, longest));
}

/// The first in each span, and the last of all.
void keep_firsts(Samples& samples, base::Duration span) {
  auto const span_at = [&](base::UtcTime time) {
    auto const since = time.time_since_epoch();
    return since / span - (since % span < base::Duration::zero() ? 1 : 0);
  };
  if (samples.empty()) return;
  auto const last = samples.back();
  auto const rest = std::ranges::unique(samples, {}, [&](auto const& sample) { return span_at(sample.at); });
  samples.erase(rest.begin(), rest.end());
  if (samples.back() != last) samples.push_back(last);
}

}  // namespace

void thin(Track& track) {
  if (track.thinning > 0) keep_firsts(track.samples, span_of(track.thinning));
  while (track.samples.size() > most_track_samples) keep_firsts(track.samples, span_of(++track.thinning));
}

void take_samples(Track& track, Track const& other) {
  Samples all;
  all.reserve(track.samples.size() + other.samples.size());
  std::ranges::merge(track.samples, other.samples, std::back_inserter(all), {}, order_of, order_of);
  auto const rest = std::ranges::unique(all, {}, &Track::Sample::at);
  all.erase(rest.begin(), rest.end());
  track.samples = std::move(all);
  track.thinning = std::max(track.thinning, other.thinning);
  thin(track);
}

}  // namespace lapwing::map::internal
