#include "perceive/pose_track.hpp"

#include <algorithm>

namespace lapwing::perceive {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration kept = 3s;
constexpr base::Duration longest_gap = 500ms;
constexpr base::Duration set_back = 1s;

}  // namespace

void PoseTrack::add(base::UtcTime at, video::BodyPlace const& place) {
  if (!place.origin().is_finite() || !place.rotation().coeffs().allFinite()) return;
  if (!poses_.empty() && at < poses_.back().at - set_back) poses_.clear();
  if (!poses_.empty() && at <= poses_.back().at) return;
  poses_.push_back({at, place});
  while (poses_.front().at < at - kept) poses_.pop_front();
}

std::optional<video::BodyPlace> PoseTrack::at(base::UtcTime time) const {
  auto const after = std::ranges::lower_bound(poses_, time, {}, &Pose::at);
  if (after == poses_.end()) return std::nullopt;
  if (after->at == time) return after->place;
  if (after == poses_.begin()) return std::nullopt;
  auto const& from = *std::prev(after);
  auto const gap = after->at - from.at;
  if (gap > longest_gap) return std::nullopt;
  double const share = base::to_seconds(time - from.at) / base::to_seconds(gap);
  auto const a = from.place.origin();
  return video::BodyPlace(a + share * (after->place.origin() - a),
                          from.place.rotation().slerp(share, after->place.rotation()));
}

double PoseTrack::speed_m_s() const {
  constexpr base::Duration of_late = 300ms;
  if (poses_.size() < 2) return 0.0;
  auto const& last = poses_.back();
  auto const before = std::find_if(std::next(poses_.rbegin()), poses_.rend(),
                                   [&](Pose const& pose) { return last.at - pose.at >= of_late; });
  auto const& from = before == poses_.rend() ? poses_.front() : *before;
  return geo::distance_m(from.place.origin(), last.place.origin()) / base::to_seconds(last.at - from.at);
}

}  // namespace lapwing::perceive
