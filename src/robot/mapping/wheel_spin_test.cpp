#include "robot/mapping/wheel_spin.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

/// For so many seconds at 0.3 m/s by the wheels, of which the map sees this part; gives what is said at the end.
struct Drive {
  WheelSpin spin;
  double time_s = 0.0;
  slam::Pose2 by_wheels;
  slam::Pose2 on_map;

  bool go(double seconds, double part) {
    bool spins = false;
    for (double const until_s = time_s + seconds; time_s < until_s; time_s += 0.1) {
      by_wheels.x += 0.03;
      on_map.x += 0.03 * part;
      spins = spin.feed(time_s, by_wheels, on_map);
    }
    return spins;
  }
};

TEST(WheelSpin, IsSaidWhenTheMapDoesNotFollowTheWheelsAndNoMoreWhenItDoes) {
  Drive drive;
  EXPECT_FALSE(drive.go(20.0, 1.0));
  EXPECT_FALSE(drive.go(2.0, 0.0)) << "a key frame may come late";
  EXPECT_TRUE(drive.go(5.0, 0.0));
  EXPECT_FALSE(drive.go(7.0, 0.9));
}

TEST(WheelSpin, IsNoneWhereAWheelSlipsAndTheRobotGetsOn) {
  Drive drive;
  EXPECT_FALSE(drive.go(30.0, 0.6));
}

TEST(WheelSpin, StaysWhileTheRobotStands) {
  Drive drive;
  EXPECT_TRUE(drive.go(10.0, 0.0));
  for (int i = 0; i < 200; ++i)
    EXPECT_TRUE(drive.spin.feed(drive.time_s += 0.1, drive.by_wheels, drive.on_map)) << "nothing is known that is new";
  drive.spin.forget();
  EXPECT_FALSE(drive.spin.feed(drive.time_s, drive.by_wheels, drive.on_map));
}

TEST(WheelSpin, IsNotSaidOfARobotThatStandsOrWhoseMapMoves) {
  Drive drive;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(drive.spin.feed(drive.time_s += 0.1, drive.by_wheels, drive.on_map));
  drive.on_map.x += 1.0;  // a loop closes
  EXPECT_FALSE(drive.go(10.0, 1.0));
}

}  // namespace
}  // namespace lapwing::robot
