#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

// Done means done: what vehicles, links and other people do to a mission in flight.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;
using vehicle::VehicleId;

VehicleId const one{"1"};

struct FlightWatch : ::testing::Test {
  /// The mission's run, in flight to its second place.
  std::unique_ptr<tasks::TaskRun> fly(plan::Mission mission) const {
    auto run = world->platform->start(task_of(std::move(mission)), one);
    EXPECT_TRUE(world->comes_to(*run, "item 3/")) << run->error();
    return run;
  }
  RunState end_of(tasks::TaskRun const& run, base::Duration limit = 300s) const {
    (void)world->run_until([&run] { return run.state() != RunState::in_progress; }, limit);
    return run.state();
  }
  void settle() const { world->loop.run_until_done(world->platform->settle()); }

  std::unique_ptr<TestWorld> world = std::make_unique<TestWorld>();
  TestAutopilot& copter = world->add();
};

// ---- somebody else's mission

TEST_F(FlightWatch, IsNotDoneByAMissionOfAnotherStation) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.mission.resize(3);
  copter.jump_to(2);
  copter.say(mavlink::MavSeverity::critical, "Auto mission changed but failed to restart command");
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_EQ(run->error(),
            "another station changed its mission in flight: Auto mission changed but failed to restart command");
  EXPECT_FALSE(run->vehicle_failed());
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(FlightWatch, NoticesAnotherNumberOfItemsWhereNoTextTells) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.mission.resize(5);
  EXPECT_EQ(end_of(*run, 10s), RunState::failed);
  EXPECT_EQ(run->error(), "another station changed its mission in flight: it has 4 items, 10 were uploaded");
}

TEST_F(FlightWatch, NoticesAMissionThatWasCleared) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.is_stuck = true;
  copter.stream(mavlink::MessageId::mission_current, 1h);  // as it comes from here on
  for (int i = 0; i < 5; ++i) {
    copter.send(mavlink::MissionCurrent{.seq = 0, .total = 0, .state = mavlink::MissionState::no_mission});
    world->run_for(1s);
  }
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(), "another station cleared its mission in flight");
}

TEST_F(FlightWatch, TakesOneOldWordAboutTheMissionForNoChange) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.send(mavlink::MissionCurrent{.seq = 3, .total = 2, .state = mavlink::MissionState::active});
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// ---- items that were skipped

TEST_F(FlightWatch, IsNotDoneWhenAnotherStationSkippedItems) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  ASSERT_TRUE(world->comes_to(*run, "item 6/"));
  copter.jump_to(10);  // to land
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_EQ(run->error(), "it came to the mission's end without passing items 6 to 9 (4 of 9 places)");
  EXPECT_TRUE(
      world->has_logged("it is at item 10 and has not passed items 6 to 9: another station or its pilot has chosen the "
                        "item"));
  EXPECT_FALSE(copter.is_armed);  // its end was a landing, which nobody stopped
}

TEST_F(FlightWatch, PutsAVehicleToRestThatSkippedItsWayToAnEndInTheAir) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_waypoint, 8));
  copter.jump_to(10);
  EXPECT_EQ(end_of(*run), RunState::failed);
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(FlightWatch, IsDoneWhenAnotherStationOnlySentItBack) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.jump_to(1);
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(FlightWatch, IsDoneWhenThePlacesWerePassedInAnOutage) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 3));
  copter.is_silent = true;
  world->run_for(15s);  // it flies on and lands
  ASSERT_FALSE(copter.is_armed);
  copter.is_silent = false;
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(FlightWatch, IsDoneWhenNothingButItsPlaceIsHeardSlowly) {
  world->run_for(5s);
  copter.denied_intervals.insert(mavlink::MessageId::global_position_int);
  copter.stream(mavlink::MessageId::global_position_int, 4s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// ---- on the ground, and nowhere

TEST_F(FlightWatch, FailsWhenACopterStandsOnTheGroundInTheMiddle) {
  copter.keeps_armed = true;
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.is_flying = false;
  copter.is_stuck = true;
  EXPECT_EQ(end_of(*run, 15s), RunState::failed);
  EXPECT_EQ(run->error(), "it stands on the ground with its motors running at item 3 of 10");
  settle();
  EXPECT_FALSE(copter.is_armed);
}

TEST_F(FlightWatch, FailsWhenThereIsNoProgress) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.is_stuck = true;
  EXPECT_EQ(end_of(*run, 60s), RunState::in_progress);
  EXPECT_EQ(end_of(*run, 5min), RunState::failed);
  EXPECT_TRUE(run->error().starts_with("no progress at item 3 of 10 for 1")) << run->error();
  EXPECT_TRUE(world->has_logged("s; after "));
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(FlightWatch, WaitsForAVehicleWhoseMissionWaits) {
  world->run_for(5s);
  auto mission = mission_ending_with(MavCmd::nav_land, 2);
  auto wait = item_at(MavCmd::nav_loiter_time, 100.0);
  wait.params[0] = 600.0F;
  mission.items.insert(mission.items.begin() + 2, wait);
  auto const run = fly(std::move(mission));
  copter.is_stuck = true;
  world->run_for(10min);
  EXPECT_EQ(run->state(), RunState::in_progress) << run->error();
  copter.is_stuck = false;
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// ---- a place where it cannot be

TEST_F(FlightWatch, FailsWhenItsPositionJumpsAndStaysThere) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.false_position = geo::Wgs84::from_degrees(41.0, -8.0, 120.0);
  EXPECT_EQ(end_of(*run, 10s), RunState::failed);
  EXPECT_TRUE(run->error().starts_with("its position jumped by 11")) << run->error();
  EXPECT_TRUE(run->error().ends_with("and stays there: where it is, is not known")) << run->error();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST(FlightWatchToHome, HoldsAVehicleThatDoesNotKnowWhereItIs) {
  TestWorld world({}, FleetPlatform::Options{.run = {.on_stop = OnStop::rtl}, .plan_library = {}});
  auto& copter = world.add();
  world.run_for(5s);
  auto const run = world.platform->start(task_of(mission_ending_with(MavCmd::nav_land, 8)), one);
  ASSERT_TRUE(world.comes_to(*run, "item 3/"));
  copter.false_position = geo::Wgs84::from_degrees(41.0, -8.0, 120.0);
  ASSERT_TRUE(world.run_until([&] { return run->state() == RunState::failed; }, 10s));
  world.loop.run_until_done(world.platform->settle());
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(FlightWatch, SaysThatItsPositionJumpedForAMoment) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.false_position = geo::Wgs84::from_degrees(41.0, -8.0, 120.0);
  world->run_for(500ms);
  copter.false_position.reset();
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  EXPECT_TRUE(world->has_logged("copter 1: its position jumped by 11"));
}

// ---- why it left its mission

TEST_F(FlightWatch, AwaitsTheTextThatFollowsAChangeOfMode) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.change_mode(copter_mode::rtl);
  world->run_for(300ms);
  EXPECT_EQ(run->state(), RunState::in_progress);
  copter.say(mavlink::MavSeverity::notice, "Fence Breached");
  EXPECT_EQ(end_of(*run, 3s), RunState::failed);
  EXPECT_EQ(run->error(), "mode changed to RTL by the vehicle: Fence Breached");
}

TEST_F(FlightWatch, KnowsABreachByItsCountWhenTheTextWasLost) {
  copter.denied_intervals.insert(mavlink::MessageId::fence_status);
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  copter.send(mavlink::FenceStatus{.breach_count = 4});
  world->run_for(100ms);
  copter.send(mavlink::FenceStatus{.breach_count = 5, .breach_type = 3});  // over already
  copter.change_mode(copter_mode::rtl);
  EXPECT_EQ(end_of(*run, 3s), RunState::failed);
  EXPECT_EQ(run->error(), "mode changed to RTL by the vehicle: fence breached: boundary");
}

// ---- what it is

TEST_F(FlightWatch, BlamesNobodyWhenAHeartbeatNamesAnotherKindOfVehicle) {
  world->run_for(5s);
  auto const run = fly(mission_ending_with(MavCmd::nav_land, 8));
  for (int i = 0; i < 5 && run->state() == RunState::in_progress; ++i) {
    copter.is_silent = true;
    world->run_for(900ms);
    copter.is_silent = false;
    copter.send(
        mavlink::Heartbeat{.type = mavlink::MavType::ground_rover,
                           .autopilot = mavlink::MavAutopilot::ardupilotmega,
                           .base_mode = mavlink::mode_flag::custom_mode_enabled | mavlink::mode_flag::safety_armed,
                           .custom_mode = copter_mode::automatic,
                           .system_status = mavlink::MavState::active});
    world->run_for(100ms);
  }
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(),
            "it calls itself a rover now, and was a copter when the mission began: what its modes mean is not known "
            "any more");
}

}  // namespace
}  // namespace lapwing::fleet
