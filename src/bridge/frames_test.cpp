#include "bridge/frames.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace lapwing::bridge {
namespace {

using std::numbers::pi;

Eigen::Quaterniond eigen(bus::Quaternion const& q) {
  return {q.w, q.x, q.y, q.z};
}

/// By the definition of MAVLink's angles: the body in north, east, down.
Eigen::Matrix3d ned_from_body(Attitude const& a) {
  return (Eigen::AngleAxisd(a.yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(a.pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(a.roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(Frames, PlacesAreEastNorthUp) {
  EXPECT_EQ(ros_point({.north = 1, .east = 2, .down = 3}), (bus::Point{2, 1, -3}));
  EXPECT_EQ(ned_from({2, 1, -3}), (geo::Ned{.north = 1, .east = 2, .down = 3}));
}

TEST(Frames, WhoLooksEastIsNotTurned) {
  auto const q = ros_orientation({.yaw_rad = pi / 2});
  EXPECT_NEAR(q.w, 1, 1e-12);
  EXPECT_NEAR(q.z, 0, 1e-12);
}

TEST(Frames, WhatIsAheadLeftAndAboveIsThereWhicheverWayTheBodyIsTurned) {
  Eigen::Matrix3d enu_from_ned;
  enu_from_ned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  Eigen::Matrix3d const frd_from_flu = Eigen::Vector3d(1, -1, -1).asDiagonal();
  for (Attitude const& attitude : {Attitude{}, Attitude{0.3, 0, 0}, Attitude{0, 0.2, 0}, Attitude{0, 0, 1},
                                   Attitude{0.4, -0.3, 2.5}, Attitude{-1.2, 0.8, -3}}) {
    Eigen::Matrix3d const expected = enu_from_ned * ned_from_body(attitude) * frd_from_flu;
    Eigen::Matrix3d const got = eigen(ros_orientation(attitude)).toRotationMatrix();
    EXPECT_TRUE(got.isApprox(expected, 1e-12)) << attitude.roll_rad << ' ' << attitude.pitch_rad;
  }
}

TEST(Frames, HeadingsGoThereAndBack) {
  for (double const yaw : {0.0, 0.1, pi / 2, 3.0, 4.0, 6.2}) {
    auto const heading = heading_rad(ros_orientation({.yaw_rad = yaw}));
    ASSERT_TRUE(heading);
    EXPECT_NEAR(*heading, yaw, 1e-9);
  }
  EXPECT_NEAR(heading_rad({.w = 1}).value(), pi / 2, 1e-12) << "no turn is east";
}

TEST(Frames, ZerosAndNoNumbersAreNoHeading) {
  EXPECT_FALSE(heading_rad({.w = 0}));
  EXPECT_FALSE(heading_rad({.x = std::numeric_limits<double>::quiet_NaN(), .w = 1}));
  EXPECT_FALSE(heading_rad({.w = std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace lapwing::bridge
