#include "fleet/mission/mission_end.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using Kind = MissionVerdict::Kind;

MissionShape const survey{.last_nav_seq = 5, .ending = MissionEnding::at_place};
MissionShape const home_and_land{.last_nav_seq = 5, .ending = MissionEnding::on_ground};
MissionShape const wait_there{.last_nav_seq = 5, .ending = MissionEnding::never};

MissionSight flying(int current) {
  return {.since_start = 60s, .mode = "AUTO", .was_active = true, .current_seq = current};
}

TEST(MissionEnd, GoesOnWhileInAutoBeforeTheLastItem) {
  EXPECT_EQ(judge(survey, flying(3)).kind, Kind::running);
}

TEST(MissionEnd, IsDoneWhenTheAutopilotSaysComplete) {
  auto sight = flying(5);
  sight.reports_complete = true;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::done);
}

TEST(MissionEnd, DoesNotBelieveACompletionLeftFromTheMissionBefore) {
  auto sight = flying(1);
  sight.reports_complete = true;
  sight.was_active = false;
  sight.since_start = 1s;
  EXPECT_EQ(judge(survey, sight).kind, Kind::running);
}

TEST(MissionEnd, IsDoneWhenTheLastPlaceIsReached) {
  auto sight = flying(5);
  sight.reached_seq = 5;
  EXPECT_EQ(judge(survey, sight).kind, Kind::done);
}

TEST(MissionEnd, AcceptsTheRunnersIndexPastTheLastPlace) {
  auto sight = flying(5);
  sight.reached_seq = 6;
  EXPECT_EQ(judge(survey, sight).kind, Kind::done);
}

TEST(MissionEnd, NeverEndsAnUnlimitedLoiterByItself) {
  auto sight = flying(5);
  sight.reached_seq = 5;
  EXPECT_EQ(judge(wait_there, sight).kind, Kind::running);
}

TEST(MissionEnd, WaitsForTheGroundAfterALandItem) {
  auto sight = flying(5);
  sight.reached_seq = 5;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::running);
  sight.on_ground_for = 1s;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::running);
  sight.on_ground_for = 6s;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::done);
}

TEST(MissionEnd, IsDoneWhenTheVehicleDisarmsAfterLandingAndStaysInAuto) {
  auto sight = flying(5);
  sight.armed = false;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::done);
}

TEST(MissionEnd, StandingOnTheGroundBeforeTakeOffIsNoLanding) {
  auto sight = flying(1);
  sight.on_ground_for = 60s;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::running);
}

TEST(MissionEnd, FailsWhenTheVehicleDisarmsOnTheWay) {
  auto sight = flying(3);
  sight.armed = false;
  sight.disarmed_for = 1s;
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::running);  // perhaps the news of the landing is late
  sight.disarmed_for = 6s;
  auto const verdict = judge(home_and_land, sight);
  EXPECT_EQ(verdict.kind, Kind::failed);
  EXPECT_EQ(verdict.reason, "disarmed at item 3 of 5");
}

TEST(MissionEnd, IsDoneWhenTheAutopilotReturnsAfterTheLastItem) {
  auto sight = flying(5);
  sight.mode_is_auto = false;
  sight.mode_is_return = true;
  sight.mode = "RTL";
  EXPECT_EQ(judge(survey, sight).kind, Kind::done);
}

TEST(MissionEnd, IsDoneWhenTheAutopilotHoldsByItselfAfterTheLastPlace) {
  auto sight = flying(5);
  sight.mode_is_auto = false;
  sight.mode = "HOLD";
  sight.mode_for = 10s;
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to HOLD by operator");
  sight.reached_seq = 5;
  EXPECT_EQ(judge(survey, sight).kind, Kind::done);
}

TEST(MissionEnd, AwaitsTheNewsOfTheEndThatABadLinkMayHaveLost) {
  auto sight = flying(4);
  sight.mode_is_auto = false;
  sight.mode = "HOLD";
  sight.mode_for = 2s;
  EXPECT_EQ(judge(survey, sight).kind, Kind::running);
  sight.current_seq = 5;
  EXPECT_EQ(judge(survey, sight).kind, Kind::running);
  sight.reports_complete = true;
  EXPECT_EQ(judge(survey, sight).kind, Kind::done);
  sight.reports_complete = false;
  sight.mode_for = 6s;
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to HOLD by operator");
}

TEST(MissionEnd, AwaitsTheReasonThatFollowsAChangeOfMode) {
  auto sight = flying(3);
  sight.mode_is_auto = false;
  sight.mode_is_return = true;
  sight.mode = "RTL";
  sight.mode_for = 200ms;
  sight.reason_wait = 600ms;
  EXPECT_EQ(judge(survey, sight).kind, Kind::running);
  sight.failsafe = "Fence Breached";
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to RTL by the vehicle: Fence Breached");
  sight.failsafe = {};
  sight.mode_for = 700ms;
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to RTL by operator");
}

TEST(MissionEnd, IsNoLandingWhenTheMotorsGoOffInTheAir) {
  auto sight = flying(5);
  sight.armed = false;
  sight.sinks = true;
  sight.reports_complete = true;  // ArduPilot says so then
  EXPECT_EQ(judge(home_and_land, sight).kind, Kind::running);
  sight.fell = true;
  EXPECT_EQ(judge(home_and_land, sight).reason, "its motors went off in the air, and it fell");
}

TEST(MissionEnd, BlamesNobodyForAModeThatChangedWithTheDisarming) {
  auto sight = flying(3);
  sight.mode_is_auto = false;
  sight.armed = false;
  sight.mode = "STABILIZE";
  EXPECT_EQ(judge(survey, sight).reason, "disarmed and mode changed to STABILIZE");
}

TEST(MissionEnd, FailsWhenSomebodyReturnsItInTheMiddle) {
  auto sight = flying(3);
  sight.mode_is_auto = false;
  sight.mode_is_return = true;
  sight.mode = "RTL";
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to RTL by operator");
}

TEST(MissionEnd, NamesTheFailsafeThatChangedTheMode) {
  auto sight = flying(3);
  sight.mode_is_auto = false;
  sight.mode = "LAND";
  sight.failsafe = "EKF Failsafe: changed to LAND Mode";
  EXPECT_EQ(judge(survey, sight).reason, "mode changed to LAND by the vehicle: EKF Failsafe: changed to LAND Mode");
}

}  // namespace
}  // namespace lapwing::fleet
