#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr int sub_auto = 3;
constexpr int sub_poshold = 16;

TEST(SubDive, FliesAMissionUnderWaterAndSurfaces) {
  TestGround ground("sub");
  auto const make = ground.maker();
  ground.arm_in(sub_auto, {make.waypoint(0, 0, 0), make.waypoint(20, 0, -4), make.waypoint(20, 20, 5),
                           make.waypoint(0, 20, -2), make.at(MavCmd::nav_land, {0, 0, 0}, {0, 0, 0, 0})});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 300s));
  ground.run_for(1s);
  // A place above the water is one at its surface.
  EXPECT_EQ(ground.said("Reached waypoint #"), 4);
  EXPECT_NEAR(ground.pilot().body().position_m.down, 0.0, 0.5);
  EXPECT_LT(ground.from_start(), 4.0);
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.last<Heartbeat>()->type, MavType::submarine);
}

TEST(SubDive, HoldsItsDepthAndComesUpWithoutThrust) {
  TestGround ground("sub");
  auto const make = ground.maker();
  ground.arm_in(sub_auto, {make.waypoint(0, 0, 0), make.waypoint(10, 0, -5)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 100s));
  EXPECT_EQ(ground.set_mode(sub_poshold), MavResult::accepted);
  ground.run_for(60s);
  EXPECT_NEAR(ground.pilot().body().position_m.down, 5.0, 2.0);
  ground.command(MavCmd::component_arm_disarm, {0.0F, 21196.0F});
  ground.run_for(60s);
  EXPECT_FALSE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().body().position_m.down, 0.0);
}

TEST(BoatTrip, DrivesLikeARoverAndCallsItselfABoat) {
  TestGround ground("boat");
  auto const make = ground.maker();
  ground.arm_in(rover_auto, {make.waypoint(0, 0, 0), make.waypoint(30, 10, 0)});
  EXPECT_EQ(ground.last<Heartbeat>()->type, MavType::surface_boat);
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 60s));
  EXPECT_NEAR(ground.from_start(), 31.6, 3.0);
}

}  // namespace
}  // namespace lapwing::sim
