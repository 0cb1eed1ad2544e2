#include "slam/match/point_to_line.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace lapwing::slam {
namespace {

/// What a scanner in a room of 6 by 4 m sees from `pose`, without noise.
Frame room_from(Pose2 const& pose) {
  Sensor sensor;
  for (int b = 0; b < 361; ++b)
    sensor.bearings_rad.push_back(static_cast<float>((b - 180) * 0.5 * 3.14159265358979 / 180.0));
  Scan scan;
  for (auto const bearing : sensor.bearings_rad) {
    auto const yaw = pose.yaw + double{bearing};
    auto const to = [](double way, double speed) { return speed > 1e-9 ? way / speed : 1e9; };
    auto const x = std::min(to(6.0 - pose.x, std::cos(yaw)), to(pose.x, -std::cos(yaw)));
    auto const y = std::min(to(4.0 - pose.y, std::sin(yaw)), to(pose.y, -std::sin(yaw)));
    scan.ranges_m.push_back(static_cast<float>(std::min(x, y)));
  }
  return frame_of(scan, sensor, {});
}

Pose2 const target_pose{3.0, 1.0, 0.4};
Pose2 const source_pose{3.2, 1.1, 0.6};

TEST(PointToLine, HasNothingToSayAgainstTheTruth) {
  auto const term = point_to_line(room_from(source_pose), source_pose, room_from(target_pose), target_pose, {});
  ASSERT_TRUE(term.is_usable());
  EXPECT_GT(term.matches, 200);
  EXPECT_LT(term.cost / term.matches, 1e-6);
}

TEST(PointToLine, LeadsBackToTheTruth) {
  auto const source = room_from(source_pose);
  auto const target = room_from(target_pose);
  auto pose = stepped(source_pose, {0.05, -0.04, 0.03});
  for (int round = 0; round < 10; ++round) {
    auto const term = point_to_line(source, pose, target, target_pose, {.gate_m = 0.3, .scale_m = 0.1});
    Eigen::Matrix3d const hessian = term.hessian.topLeftCorner<3, 3>();
    Eigen::Vector3d const gradient = term.gradient.head<3>();
    pose = stepped(pose, hessian.inverse() * -gradient);
  }
  EXPECT_NEAR(distance_m(pose, source_pose), 0.0, 2e-3);
  EXPECT_NEAR(turn_rad(pose, source_pose), 0.0, 1e-3);
}

TEST(PointToLine, GradientIsThatOfTheCostByBothPoses) {
  // With a kernel so wide that every weight is 1, the cost is a plain sum of squares, whose slope is twice the
  // gradient.
  Association const plain{.gate_m = 0.3, .scale_m = 1e6};
  auto const source = room_from(source_pose);
  auto const target = room_from(target_pose);
  auto const moved = stepped(source_pose, {0.02, 0.01, 0.0});
  auto const term = point_to_line(source, moved, target, target_pose, plain);
  constexpr double h = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step(i % 3) = h;
    auto const cost_at = [&](double sign) {
      auto const s = i < 3 ? stepped(moved, sign * step) : moved;
      auto const t = i < 3 ? target_pose : stepped(target_pose, sign * step);
      return point_to_line(source, s, target, t, plain).cost;
    };
    auto const slope = (cost_at(1.0) - cost_at(-1.0)) / (2.0 * h);
    EXPECT_NEAR(slope, 2.0 * term.gradient(i), 1e-3 * std::max(1.0, std::abs(slope))) << i;
  }
}

TEST(PointToLine, OneWallSaysNothingAlongItself) {
  Sensor sensor;
  Scan scan;
  for (int b = -40; b <= 40; ++b) {
    sensor.bearings_rad.push_back(static_cast<float>(b * 0.0174532925));
    scan.ranges_m.push_back(static_cast<float>(2.0 / std::cos(b * 0.0174532925)));
  }
  auto const wall = frame_of(scan, sensor, {});
  auto const term = point_to_line(wall, {}, wall, {}, {});
  ASSERT_TRUE(term.is_usable());
  EXPECT_NEAR(term.hessian(1, 1), 0.0, 1e-3 * term.hessian(0, 0));
}

}  // namespace
}  // namespace lapwing::slam
