#include "robot/ranges/board_odometry.hpp"

#include <chrono>

namespace lapwing::robot {

namespace {

constexpr auto remembered = std::chrono::seconds(5);

}  // namespace

std::optional<Sensed> BoardOdometry::feed(firmware::Readings const& readings) {
  auto sensed = sensors_.feed(readings);
  if (!sensed) return std::nullopt;
  auto const& pose = sensed->pose;
  now_ = begin_ * slam::Pose2{pose.position.x(), pose.position.y(), pose.yaw_rad};
  track_.add({.stamp = sensed->time, .pose = now_});
  track_.forget_before(sensed->time - remembered);
  return sensed;
}

}  // namespace lapwing::robot
