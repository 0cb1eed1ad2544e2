#include <gtest/gtest.h>

#include <cmath>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

/// Sends a vehicle in guided mode to a place seen from home.
void reposition(TestGround& ground, geo::Ned offset) {
  auto const there = ground.maker().at(MavCmd::do_reposition, offset, {-1});
  ground.send(CommandInt{.frame = there.frame, .command = there.command, .params = there.params, .place = there.place});
}

TEST(CopterFlight, TakesOffInGuidedAfterSpoolingUpWithoutOvershoot) {
  TestGround ground("copter");
  ground.arm_in(copter_guided);
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, {0, 0, 0, 0, 0, 0, 20}), MavResult::accepted);
  ground.run_for(2900ms);
  EXPECT_TRUE(ground.pilot().body().on_ground);
  double highest = 0.0;
  ground.run_until(
      [&] {
        highest = std::max(highest, ground.pilot().body().height_m());
        return false;
      },
      20s);
  EXPECT_NEAR(ground.pilot().body().height_m(), 20.0, 0.2);
  EXPECT_LT(highest, 20.3);
}

TEST(CopterFlight, FliesAnUploadedMissionAndEndsAtHome) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(30), make.waypoint(100, 0, 30), make.waypoint(100, 100, 35),
              make.waypoint(0, 100, 40), ItemMaker::plain(MavCmd::nav_return_to_launch)});
  auto const started = ground.loop.now();
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 300s));
  EXPECT_NEAR(base::to_seconds(ground.loop.now() - started), 115.0, 35.0);
  EXPECT_LT(ground.from_start(), 1.0);
  EXPECT_EQ(ground.said("Reached command #"), 3);
  EXPECT_EQ(ground.said("Mission: 2 WP"), 1);
  ground.run_for(200ms);
  EXPECT_EQ(ground.said("Disarming motors"), 1);
  EXPECT_EQ(ground.said("SIM Hit ground at 0.5"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::complete);
  EXPECT_EQ(ground.pilot().mission().current(), 0);
}

TEST(CopterFlight, HoldsAfterTheLastWaypointAndStaysInAuto) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(15), make.waypoint(40, 0, 15)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 60s));
  ground.run_for(20s);
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_NEAR(ground.from_start(), 40.0, 3.0);
}

TEST(CopterFlight, LandsAtALandItemAndDisarms) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(15), make.at(MavCmd::nav_land, {30, 10, 0})});
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 120s));
  auto const& here = ground.pilot().body().position_m;
  EXPECT_NEAR(here.north, 30.0, 0.5);
  EXPECT_NEAR(here.east, 10.0, 0.5);
  EXPECT_TRUE(ground.pilot().mission().complete());
}

TEST(CopterFlight, PerformsEveryKindOfItemOfTheLanguage) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(15), ItemMaker::plain(MavCmd::do_change_speed, {1, 6, -1, 0}),
              make.at(MavCmd::nav_loiter_time, {20, 0, -15}, {5, 0, 15, 0}),
              make.at(MavCmd::nav_loiter_turns, {20, 20, -15}, {1, 0, 8, 0}),
              ItemMaker::plain(MavCmd::image_start_capture, {0, 1, 3, 0}),
              ItemMaker::plain(MavCmd::nav_delay, {4, -1, -1, -1}), ItemMaker::plain(MavCmd::image_stop_capture),
              make.waypoint(0, 20, 15, 3.0F), ItemMaker::plain(MavCmd::do_jump, {8, 1, 0, 0}),
              make.at(MavCmd::nav_land, {0, 0, 0})});
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 300s));
  EXPECT_TRUE(ground.pilot().mission().complete());
  EXPECT_EQ(ground.all<CameraFeedback>().size(), 3u);
  EXPECT_EQ(ground.said("Mission: 9 Jump 1/1"), 1);
  EXPECT_EQ(ground.said("Mission: 8 WP"), 2);
}

TEST(CopterFlight, ReportsTheItemBehindAWaypointAsReached) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(30, 0, 10),
              ItemMaker::plain(MavCmd::do_change_speed, {1, 4, -1, 0}), make.waypoint(60, 0, 10)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 100s));
  ground.run_for(100ms);
  std::vector<int> reached;
  for (auto const& message : ground.all<MissionItemReached>()) reached.push_back(message.seq);
  EXPECT_EQ(reached, (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(ground.said("Reached command #2"), 1);
}

TEST(CopterFlight, SitsInAutoOnTheGroundUntilMissionStart) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.arm_in(copter_guided, {make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(30, 0, 10)});
  EXPECT_EQ(ground.set_mode(copter_auto), MavResult::accepted);
  ground.run_for(6s);
  EXPECT_TRUE(ground.pilot().body().on_ground);
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::active);
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted);
  ground.run_for(10s);
  EXPECT_GT(ground.pilot().body().height_m(), 5.0);
}

TEST(CopterFlight, TakesOffInAutoByItselfWhenAutoOptionsAllowIt) {
  TestGround ground("copter");
  ground.boot();
  auto const make = ground.maker();
  ground.send(ParamSet{.target = {}, .name = "AUTO_OPTIONS", .value = 3.0F});
  ground.upload({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(30, 0, 10)});
  EXPECT_EQ(ground.set_mode(copter_auto), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::accepted);
  ground.run_for(10s);
  EXPECT_GT(ground.pilot().body().height_m(), 5.0);
}

TEST(CopterFlight, ReturnsHomeAtTheReturnHeightWaitsAndLands) {
  TestGround ground("copter");
  ground.hover(8);
  reposition(ground, {60, 0, -8});
  ground.run_for(15s);
  EXPECT_NEAR(ground.from_start(), 60.0, 1.0);
  EXPECT_EQ(ground.command(MavCmd::nav_return_to_launch), MavResult::accepted);
  double highest = 0.0;
  ASSERT_TRUE(ground.run_until(
      [&] {
        highest = std::max(highest, ground.pilot().body().height_m());
        return !ground.pilot().armed();
      },
      120s));
  EXPECT_NEAR(highest, 15.0, 0.4);
  EXPECT_LT(ground.from_start(), 1.0);
}

TEST(CopterFlight, StopsThreeSecondsAfterTheLastVelocitySetpoint) {
  TestGround ground("copter");
  ground.hover(10);
  SetPositionTargetGlobalInt target;
  target.setpoint.frame = MavFrame::global_relative_alt_int;
  target.setpoint.ignore = 0b110111000111;
  target.setpoint.velocity_m_s = {3, 0, 0};
  ground.send(target);
  ground.run_for(2500ms);
  EXPECT_NEAR(ground.pilot().body().velocity_m_s.north, 3.0, 0.3);
  ground.run_for(5s);
  EXPECT_NEAR(ground.pilot().body().velocity_m_s.north, 0.0, 0.1);
}

TEST(CopterFlight, SinksInLoiterButHoldsInBrake) {
  TestGround ground("copter");
  ground.hover(30);
  ground.set_mode(17);
  ground.run_for(5s);
  EXPECT_NEAR(ground.pilot().body().height_m(), 30.0, 0.3);
  ground.set_mode(5);
  ground.run_for(5s);
  EXPECT_LT(ground.pilot().body().height_m(), 22.0);
}

TEST(CopterFlight, ResumesTheMissionWhereItWasLeft) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(60, 0, 10), make.waypoint(60, 60, 10)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().current() == 2; }, 30s));
  ground.set_mode(17);
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::not_started);
  ground.run_for(5s);
  ground.set_mode(copter_auto);
  EXPECT_EQ(ground.pilot().mission().current(), 2);
  EXPECT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 60s));
}

TEST(CopterFlight, FliesTheOldTargetToTheEndWhenAShorterMissionComes) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(20, 0, 10), make.waypoint(60, 0, 10)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().current() == 3; }, 60s));
  EXPECT_EQ(ground.upload({make.waypoint(0, 0, 0), make.take_off(10)}), MavMissionResult::accepted);
  EXPECT_GE(ground.said("Auto mission changed but failed to restart command"), 1);
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 60s));
  EXPECT_NEAR(ground.from_start(), 60.0, 3.0);
}

TEST(CopterFlight, RestartsTheCommandWhenItIsReplacedInFlight) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(80, 0, 10)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().current() == 2; }, 60s));
  ground.upload({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(0, 50, 10)});
  EXPECT_EQ(ground.said("Auto mission changed, restarted command"), 1);
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 60s));
  EXPECT_NEAR(ground.pilot().body().position_m.east, 50.0, 3.0);
}

TEST(CopterFlight, CannotBeDisarmedInTheAirUnlessForced) {
  TestGround ground("copter");
  ground.hover(10);
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {0, 0}), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {0, 21196}), MavResult::accepted);
  ground.run_for(4s);
  EXPECT_EQ(ground.said("SIM Hit ground at 1"), 1);
}

TEST(CopterFlight, LandModeEndsDisarmed) {
  TestGround ground("copter");
  ground.hover(12);
  EXPECT_EQ(ground.set_mode(copter_land), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 60s));
}

TEST(CopterFlight, KeepsItsPlaceInGustyWind) {
  TestGround ground("copter", {.wind_m_s = {4, -3, 0}, .gust_m_s = 1.5});
  ground.hover(12);
  ground.run_for(16s);
  EXPECT_LT(ground.from_start(), 1.0);
  EXPECT_GT(std::abs(ground.pilot().body().attitude.pitch_rad), 0.01);
}

TEST(PlaneFlight, FliesAMissionThenReturnsAndCircles) {
  TestGround ground("plane", {.wind_m_s = {0, 3, 0}});
  auto const make = ground.maker();
  ground.arm_in(plane_auto,
                {make.waypoint(0, 0, 0), make.take_off(60), make.waypoint(500, 0, 80), make.waypoint(500, 400, 80),
                 make.at(MavCmd::nav_loiter_turns, {0, 400, -80}, {1, 0, 70, 0})});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mode().name == "RTL"; }, 300s));
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::complete);
  EXPECT_EQ(ground.said("Reached waypoint #"), 2);
  ground.run_for(90s);
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_NEAR(ground.pilot().body().height_m(), 100.0, 8.0);
  EXPECT_NEAR(ground.from_start(), 60.0, 25.0);
}

TEST(PlaneFlight, LeavesTheMissionForRtlWhereItSaysReturn) {
  TestGround ground("plane");
  auto const make = ground.maker();
  ground.arm_in(plane_auto, {make.waypoint(0, 0, 0), make.take_off(60), make.waypoint(400, 0, 60),
                             ItemMaker::plain(MavCmd::nav_return_to_launch), make.waypoint(900, 0, 60)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mode().name == "RTL"; }, 120s));
  ground.run_for(90s);
  EXPECT_EQ(ground.said("Mission: 3 RTL"), 1);
  EXPECT_EQ(ground.said("Mission: 4"), 0);
  EXPECT_NEAR(ground.from_start(), 60.0, 25.0);
}

TEST(PlaneFlight, LandsAndDisarmsTwentySecondsLater) {
  TestGround ground("plane");
  auto const make = ground.maker();
  ground.arm_in(plane_auto, {make.waypoint(0, 0, 0), make.take_off(40), make.waypoint(600, 0, 40),
                             make.waypoint(600, 300, 40), make.at(MavCmd::nav_land, {0, 300, 0})});
  ASSERT_TRUE(ground.run_until(
      [&] { return ground.pilot().mission().current() == 4 && ground.pilot().body().on_ground; }, 300s));
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 60s));
  auto const& here = ground.pilot().body().position_m;
  EXPECT_LT(std::hypot(here.north, here.east - 300.0), 150.0);
  EXPECT_NE(ground.pilot().mission().state(), MissionState::complete);
}

TEST(PlaneFlight, ContinuesOnItsCourseWhileItChangesHeight) {
  TestGround ground("plane");
  auto const make = ground.maker();
  ground.arm_in(plane_auto, {make.waypoint(0, 0, 0), make.take_off(50),
                             make.at(MavCmd::nav_continue_and_change_alt, {0, 0, -90}, {1, 0, 0, 0}),
                             make.at(MavCmd::nav_loiter_unlim, {300, 0, -90}, {0, 0, 70, 0})});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().current() == 3; }, 120s));
  EXPECT_GT(ground.pilot().body().height_m(), 80.0);
  ground.run_for(120s);
  EXPECT_EQ(ground.pilot().mission().current(), 3);
}

TEST(RoverFlight, DrivesAMissionAndStops) {
  TestGround ground("rover");
  auto const make = ground.maker();
  ground.arm_in(rover_auto,
                {make.waypoint(0, 0, 0), make.waypoint(30, 0, 0), make.waypoint(30, 30, 0), make.waypoint(0, 30, 0)});
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mission().complete(); }, 120s));
  ground.run_for(3s);
  EXPECT_EQ(ground.said("Mission Complete"), 1);
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.2);
  EXPECT_NEAR(ground.pilot().body().position_m.east, 30.0, 4.0);
}

TEST(RoverFlight, DrivesToAGuidedPointAndHome) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  reposition(ground, {25, 10, 0});
  ground.run_for(25s);
  EXPECT_NEAR(ground.from_start(), std::hypot(25.0, 10.0), 1.0);
  EXPECT_EQ(ground.command(MavCmd::nav_return_to_launch), MavResult::accepted);
  ground.run_for(40s);
  EXPECT_LT(ground.from_start(), 2.5);
  EXPECT_TRUE(ground.pilot().armed());
}

SetPositionTargetLocalNed wheels(double speed_m_s, double turn_rate_rad_s) {
  SetPositionTargetLocalNed target;
  target.frame = MavFrame::body_ned;
  target.ignore = 0b010111000111;
  target.velocity_m_s = {speed_m_s, 0, 0};
  target.yaw_rate_rad_s = turn_rate_rad_s;
  return target;
}

TEST(RoverFlight, IsSteeredBySpeedAndTurnRate) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  auto const steer = [&](double speed_m_s, double turn_rate_rad_s) {
    ground.send(wheels(speed_m_s, turn_rate_rad_s));
    ground.run_for(2s);
  };
  steer(0.3, 0.0);
  EXPECT_NEAR(ground.pilot().body().ground_speed_m_s(), 0.3, 0.02);
  steer(0.0, 0.5);
  EXPECT_NEAR(ground.pilot().body().yaw_rate_rad_s, 0.5, 0.02) << "on the spot, clockwise";
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.02);
  steer(-0.2, 0.0);
  auto const& body = ground.pilot().body();
  EXPECT_NEAR(body.velocity_m_s.north * std::cos(body.attitude.yaw_rad) +
                  body.velocity_m_s.east * std::sin(body.attitude.yaw_rad),
              -0.2, 0.02)
      << "backwards";
  ground.run_for(3s);
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.02) << "the last setpoint is older than three seconds";
}

TEST(RoverFlight, ObeysNoSetpointInAnotherMode) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  ground.set_mode(4);  // HOLD
  ground.send(wheels(0.3, 0.0));
  ground.run_for(2s);
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.01);
}

TEST(World, SameSeedGivesTheSameTrajectory) {
  auto fly = [](std::uint64_t seed) {
    TestGround ground("copter", {.seed = seed, .wind_m_s = {3, 0, 0}, .gust_m_s = 2.0});
    auto const make = ground.maker();
    ground.fly({make.waypoint(0, 0, 0), make.take_off(15), make.waypoint(50, 20, 15)});
    std::vector<double> trajectory;
    ground.run_until(
        [&] {
          auto const& body = ground.pilot().body();
          trajectory.insert(trajectory.end(), {body.position_m.north, body.position_m.east, body.position_m.down,
                                               body.attitude.pitch_rad});
          return false;
        },
        30s);
    return trajectory;
  };
  auto const first = fly(7);
  EXPECT_EQ(first, fly(7));
  EXPECT_NE(first, fly(8));
}

TEST(World, TenCoptersFlyTheirOwnMissionsAtOnce) {
  TestGround ground("copter:10");
  ground.boot();
  auto const make = ground.maker();
  for (std::uint8_t id = 1; id <= 10; ++id) {
    EXPECT_EQ(ground.upload({make.waypoint(0, 0, 0), make.take_off(20 + id), make.waypoint(40, 4.0 * id, 20 + id),
                             ItemMaker::plain(MavCmd::nav_return_to_launch)},
                            id),
              MavMissionResult::accepted);
    ground.set_mode(copter_guided, id);
    EXPECT_EQ(ground.arm(id), MavResult::accepted);
    EXPECT_EQ(ground.command(MavCmd::mission_start, {}, id), MavResult::accepted);
  }
  std::array<double, 11> highest{};
  ASSERT_TRUE(ground.run_until(
      [&] {
        bool flying = false;
        for (int id = 1; id <= 10; ++id) {
          auto& high = highest[static_cast<std::size_t>(id)];
          high = std::max(high, ground.pilot(id).body().height_m());
          flying = flying || ground.pilot(id).armed();
        }
        return !flying;
      },
      200s));
  for (int id = 1; id <= 10; ++id) {
    EXPECT_NEAR(highest[static_cast<std::size_t>(id)], 20.0 + id, 0.3);
    EXPECT_LT(ground.from_start(id), 1.0);
  }
}

}  // namespace
}  // namespace lapwing::sim
