#include "robot/platform/board_odometry.hpp"

#include <algorithm>
#include <chrono>

namespace lapwing::robot {

namespace {

constexpr std::size_t most_samples = 50;  ///< five seconds

}  // namespace

std::optional<Sensed> BoardOdometry::feed(firmware::Readings const& readings) {
  auto sensed = sensors_.feed(readings);
  if (!sensed) return std::nullopt;
  auto const& pose = sensed->pose;
  samples_.push_back({sensed->time, begin_ * slam::Pose2{pose.position.x(), pose.position.y(), pose.yaw_rad}});
  if (samples_.size() > most_samples) samples_.pop_front();
  return sensed;
}

slam::Pose2 BoardOdometry::at(firmware::Time time) const {
  auto const after = std::ranges::upper_bound(samples_, time, {}, &Sample::time);
  if (after == samples_.begin()) return samples_.empty() ? begin_ : samples_.front().pose;
  if (after == samples_.end()) return samples_.back().pose;
  auto const& before = *std::prev(after);
  using Seconds = std::chrono::duration<double>;
  double const share = Seconds(time - before.time) / Seconds(after->time - before.time);
  auto const driven = slam::between(before.pose, after->pose);
  return before.pose * slam::Pose2{share * driven.x, share * driven.y, share * driven.yaw};
}

}  // namespace lapwing::robot
