#include "slam/log/pose_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::slam {

namespace {

using namespace std::chrono_literals;

constexpr auto most_beyond_an_end = 100ms;

}  // namespace

PoseTrack::PoseTrack(std::vector<Moment> moments) : moments_(std::move(moments)) {
  std::erase_if(moments_, [](Moment const& moment) { return !numbers(moment.pose).allFinite(); });
  std::ranges::stable_sort(moments_, {}, &Moment::stamp);
  auto const again = std::ranges::unique(moments_, {}, &Moment::stamp);
  moments_.erase(again.begin(), again.end());
}

void PoseTrack::add(Moment const& moment) {
  if (!moments_.empty() && moment.stamp <= moments_.back().stamp) moments_.clear();
  moments_.push_back(moment);
}

void PoseTrack::forget_before(std::chrono::nanoseconds stamp) {
  moments_.erase(moments_.begin(), std::ranges::lower_bound(moments_, stamp, {}, &Moment::stamp));
}

std::optional<Pose2> PoseTrack::at(std::chrono::nanoseconds stamp) const {
  auto const next = std::ranges::lower_bound(moments_, stamp, {}, &Moment::stamp);
  if (next != moments_.end() && next->stamp == stamp) return next->pose;
  if (next == moments_.begin() || next == moments_.end()) {
    if (moments_.empty()) return std::nullopt;
    auto const& end = next == moments_.end() ? moments_.back() : moments_.front();
    return std::chrono::abs(stamp - end.stamp) <= most_beyond_an_end ? std::optional(end.pose) : std::nullopt;
  }
  auto const before = std::prev(next);
  auto const share = std::chrono::duration<double>(stamp - before->stamp) / (next->stamp - before->stamp);
  return on_the_way(before->pose, next->pose, share);
}

}  // namespace lapwing::slam
