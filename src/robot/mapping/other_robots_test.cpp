#include "robot/mapping/other_robots.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr auto half_turn = std::numbers::pi_v<float>;

/// A laser 10 cm ahead of the middle of a robot at (1, 2) that looks to the map's left.
struct OtherRobots : ::testing::Test {
  OtherRobots() {
    sensor.mount_m.x() = 0.1F;
    sensor.no_return_m = 8.0F;
    sensor.bearings_rad = {-half_turn / 2, 0.0F, half_turn / 2};
    scan.ranges_m = {2.0F, 3.0F, 8.0F};
  }
  [[nodiscard]] std::vector<float> rest(std::vector<OtherRobot> const& others) const {
    return without_robots(scan, sensor, {1.0, 2.0, std::numbers::pi / 2.0}, others).ranges_m;
  }
  slam::Sensor sensor;
  slam::Scan scan;
};

TEST_F(OtherRobots, AreLeftOutOfWhatIsMapped) {
  EXPECT_EQ(rest({{.at = {1.0, 5.3}, .radius_m = 0.18}}), (std::vector{2.0F, 0.0F, 8.0F})) << "its front, 3.1 m ahead";
  EXPECT_EQ(rest({{.at = {3.2, 2.1}, .radius_m = 0.18}}), (std::vector{0.0F, 3.0F, 8.0F}));
}

TEST_F(OtherRobots, HideNoWallsThatTheyDoNotStandAt) {
  EXPECT_EQ(rest({{.at = {1.0, 4.0}, .radius_m = 0.18}}), scan.ranges_m) << "what is seen lies behind it";
  EXPECT_EQ(rest({{.at = {1.0, 5.7}, .radius_m = 0.18}}), scan.ranges_m);
  EXPECT_EQ(rest({}), scan.ranges_m);
}

TEST_F(OtherRobots, OfWhichNothingIsSeenTakeNothing) {
  EXPECT_EQ(rest({{.at = {-6.9, 2.1}, .radius_m = 0.18}}), scan.ranges_m) << "no return is no robot";
}

}  // namespace
}  // namespace lapwing::robot
