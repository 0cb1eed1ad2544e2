#include "bridge/setpoints.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::bridge {
namespace {

geo::Wgs84 const origin = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
constexpr std::uint16_t yaw_is_ignored = 1U << 10U;

bus::PoseStamped local(double east, double north, double up) {
  return {.pose = {.position = {east, north, up}, .orientation = {.w = 0}}};
}

TEST(LocalSetpoints, AreThatPlaceOnTheGlobe) {
  auto const target = setpoint_of(local(30, 40, 12), origin);
  ASSERT_TRUE(target);
  auto const& setpoint = target->setpoint;
  auto const shift = geo::LocalFrame(origin).ned_from({setpoint.lat_rad, setpoint.lon_rad, setpoint.alt_m});
  EXPECT_NEAR(shift.east, 30, 1e-6);
  EXPECT_NEAR(shift.north, 40, 1e-6);
  EXPECT_NEAR(shift.down, -12, 1e-6);
  EXPECT_EQ(setpoint.frame, mavlink::MavFrame::global);
  EXPECT_EQ(setpoint.ignore & 0b111, 0) << "the place counts";
}

TEST(LocalSetpoints, LeaveTheHeadingWhenTheyHaveNone) {
  EXPECT_NE(setpoint_of(local(0, 0, 10), origin)->setpoint.ignore & yaw_is_ignored, 0);
  auto wanted = local(0, 0, 10);
  wanted.pose.orientation = {.z = std::numbers::sqrt2 / 2, .w = std::numbers::sqrt2 / 2};  // north
  auto const target = setpoint_of(wanted, origin);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->setpoint.ignore & yaw_is_ignored, 0);
  EXPECT_NEAR(geo::wrap_pi(target->setpoint.yaw_rad), 0, 1e-9);
}

TEST(LocalSetpoints, ThatAreNoPlacesAreRefused) {
  EXPECT_FALSE(setpoint_of(local(std::numeric_limits<double>::quiet_NaN(), 0, 10), origin));
  EXPECT_FALSE(setpoint_of(local(0, 1e7, 10), origin));
}

TEST(GlobalSetpoints, AreAboveTheSeaForMavlinkAndAboveTheEllipsoidForRos) {
  bus::GeoPoseStamped wanted;
  wanted.pose.position = {43.26, -79.92, 80.0};
  auto const target = setpoint_of(wanted, -36.0);  // the sea lies 36 m below the ellipsoid there
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->setpoint.alt_m, 116.0, 1e-9);
  EXPECT_NEAR(target->setpoint.lat_rad * 180 / std::numbers::pi, 43.26, 1e-9);
}

TEST(GlobalSetpoints, ThatAreNowhereOnEarthAreRefused) {
  bus::GeoPoseStamped wanted;
  wanted.pose.position = {91.0, 0, 80.0};
  EXPECT_FALSE(setpoint_of(wanted, 0));
  wanted.pose.position = {43.0, 0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(setpoint_of(wanted, 0));
}

}  // namespace
}  // namespace lapwing::bridge
