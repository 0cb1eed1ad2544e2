#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

// A run may be stopped in each of its phases; none of them may leave a command behind that starts the mission later.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;
using vehicle::VehicleId;

VehicleId const one{"1"};

struct MissionStop : ::testing::Test {
  std::unique_ptr<tasks::TaskRun> start(MavCmd last = MavCmd::nav_loiter_unlim) const {
    return world->platform->start(task_of(mission_ending_with(last)), one);
  }
  void settle() const { world->loop.run_until_done(world->platform->settle()); }

  std::unique_ptr<TestWorld> world = std::make_unique<TestWorld>();
};

TEST_F(MissionStop, SendsNothingWhileItWaitsForTheVehicle) {
  auto& copter = world->add({.position_ok_after = 60s});
  world->run_for(10s);
  auto const run = start();
  world->run_for(5s);
  auto const heard = copter.heard.size();
  run->stop();
  settle();
  world->run_for(5s);
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(copter.heard.size(), heard);
  EXPECT_EQ(world->platform->missions(one)[0].outcome, "stopped");
}

TEST_F(MissionStop, CancelsAnUpload) {
  auto& copter = world->add({.request_spacing = 500ms});
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "uploading 2/"));
  run->stop();
  settle();
  world->run_for(60s);
  EXPECT_TRUE(copter.was_upload_cancelled());
  EXPECT_FALSE(copter.is_armed);
  EXPECT_TRUE(copter.modes_commanded().empty());
  EXPECT_EQ(copter.commands_heard(MavCmd::mission_start), 0);
}

TEST_F(MissionStop, LeavesNoPartsOfTwoPlansBehind) {
  auto& copter = world->add({.request_spacing = 500ms});
  copter.mission.resize(50);
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "uploading 2/"));
  run->stop();
  settle();
  EXPECT_TRUE(copter.mission.empty());
  EXPECT_TRUE(copter.modes_commanded().empty());
}

TEST_F(MissionStop, LeavesAPlanAloneThatItHadNotBegunToReplace) {
  auto& copter = world->add({.position_ok_after = 60s});
  copter.mission.resize(50);
  world->run_for(10s);
  auto const run = start();
  world->run_for(5s);
  run->stop();
  settle();
  EXPECT_EQ(copter.mission.size(), 50u);
}

TEST_F(MissionStop, StartsNothingAfterAReadBack) {
  auto& copter = world->add({}, {.delay = 100ms});
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "reading back"));
  run->stop();
  settle();
  world->run_for(30s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST_F(MissionStop, DisarmsAVehicleThatIsStillOnTheGround) {
  auto& copter = world->add();
  copter.ignored_commands.insert(MavCmd::mission_start);
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->run_until([&] { return copter.commands_heard(MavCmd::mission_start) > 0; }));
  run->stop();
  copter.ignored_commands.clear();
  settle();
  world->run_for(2s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_NE(copter.mode, copter_mode::automatic);
}

TEST_F(MissionStop, TakesBackAnArmingThatWasNotConfirmed) {
  auto& copter = world->add({}, {.delay = 300ms});
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->run_until([&] { return copter.is_armed; }));
  run->stop();
  settle();
  world->run_for(2s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(copter.commands_heard(MavCmd::mission_start), 0);
}

TEST_F(MissionStop, HoldsAFlyingCopterInPlace) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_TRUE(copter.is_flying);
  world->run_for(60s);
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(MissionStop, HoldsARover) {
  auto& rover = world->add({.type = mavlink::MavType::ground_rover});
  world->run_for(5s);
  auto mission = mission_ending_with(MavCmd::nav_waypoint);
  mission.items.erase(mission.items.begin());  // no take-off
  auto const run = world->platform->start(task_of(std::move(mission)), one);
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  run->stop();
  settle();
  EXPECT_EQ(rover.mode, rover_mode::hold);
}

struct RoverAtTheEnd : MissionStop {
  RoverAtTheEnd() { world->run_for(5s); }
  std::unique_ptr<tasks::TaskRun> drive() {
    auto mission = mission_ending_with(MavCmd::nav_waypoint);
    mission.items.erase(mission.items.begin());  // no take-off
    auto run = world->platform->start(task_of(std::move(mission)), one);
    EXPECT_TRUE(world->run_until([&] { return run->state() == RunState::done; })) << run->error();
    return run;
  }

  TestAutopilot& rover = world->add({.type = mavlink::MavType::ground_rover});
};

TEST_F(RoverAtTheEnd, IsHeldAndDisarmed) {
  auto const run = drive();
  EXPECT_TRUE(rover.is_armed);
  settle();
  EXPECT_EQ(rover.mode, rover_mode::hold);
  EXPECT_FALSE(rover.is_armed);
  EXPECT_EQ(run->state(), RunState::done);
  EXPECT_TRUE(world->has_logged("rover 1 parked: HOLD, disarmed"));
}

TEST_F(RoverAtTheEnd, DrivesOnWhenTheNextTaskWantsIt) {
  auto const first = drive();
  world->run_for(100ms);
  auto const second = drive();
  EXPECT_EQ(second->state(), RunState::done) << second->error();
  EXPECT_EQ(rover.commands_heard(MavCmd::component_arm_disarm), 1);
  settle();
  EXPECT_FALSE(rover.is_armed);
}

TEST_F(RoverAtTheEnd, IsLeftToWhoeverTakesIt) {
  auto const run = drive();
  world->platform->yield(one, "somebody wants it");
  settle();
  world->run_for(10s);
  EXPECT_EQ(rover.mode, rover_mode::automatic);
  EXPECT_TRUE(rover.is_armed);
}

TEST_F(MissionStop, DisarmsAPlaneThatHasLandedInItsMode) {
  auto& plane = world->add({.type = mavlink::MavType::fixed_wing});
  plane.keeps_armed = true;
  plane.reports_complete = false;
  world->run_for(5s);
  auto const run = world->platform->start(task_of(mission_ending_with(MavCmd::nav_land)), one);
  ASSERT_TRUE(world->run_until([&] { return run->state() == RunState::done; })) << run->error();
  EXPECT_TRUE(plane.is_armed);
  settle();
  EXPECT_FALSE(plane.is_armed);
  EXPECT_EQ(plane.mode, plane_mode::automatic);
  EXPECT_TRUE(world->has_logged("plane 1 parked: AUTO, disarmed"));
}

TEST_F(MissionStop, LeavesAPlaneInTheAirAtTheEndOfItsMission) {
  auto& plane = world->add({.type = mavlink::MavType::fixed_wing});
  world->run_for(5s);
  auto const run = world->platform->start(task_of(mission_ending_with(MavCmd::nav_waypoint)), one);
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  plane.is_flying = true;
  ASSERT_TRUE(world->run_until([&] { return run->state() == RunState::done; })) << run->error();
  settle();
  EXPECT_TRUE(plane.is_armed);
}

TEST_F(MissionStop, LetsAPlaneCircle) {
  auto& plane = world->add({.type = mavlink::MavType::fixed_wing});
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  EXPECT_EQ(plane.mode, plane_mode::automatic);
  run->stop();
  settle();
  EXPECT_EQ(plane.mode, plane_mode::loiter);
}

TEST_F(MissionStop, RestsAStartThatTheVehicleHadNotConfirmed) {
  auto& copter = world->add({}, {.delay = 300ms});
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->run_until([&] { return copter.mode == copter_mode::automatic; }));
  ASSERT_EQ(world->state().mode.value, "STABILIZE");
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(MissionStop, LetsTheNextTaskUndoAStartThatTheVehicleHadNotConfirmed) {
  auto& copter = world->add({}, {.delay = 300ms});
  world->run_for(5s);
  auto const first = start();
  ASSERT_TRUE(world->run_until([&] { return copter.mode == copter_mode::automatic; }));
  first->stop();
  auto const second = start(MavCmd::nav_land);
  ASSERT_TRUE(world->comes_to(*second, "uploading"));
  EXPECT_EQ(copter.mode, copter_mode::brake);
  ASSERT_TRUE(world->run_until([&] { return second->state() != RunState::in_progress; }));
  EXPECT_EQ(second->state(), RunState::done) << second->error();
}

TEST_F(MissionStop, UsesTheConfiguredStopMode) {
  world = std::make_unique<TestWorld>(Fleet::Options{},
                                      FleetPlatform::Options{.run = {.on_stop = OnStop::land}, .plan_library = {}});
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::land);
}

TEST_F(MissionStop, RepeatsTheStopOnALossyLinkUntilAHeartbeatShowsIt) {
  auto& copter = world->add({}, {.loss = 0.3, .delay = 200ms, .seed = 7});
  world->run_for(10s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_TRUE(world->has_logged("copter 1 stopped: BRAKE"));
}

TEST_F(MissionStop, LandsWhenItCannotHold) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  copter.refused_modes.insert(copter_mode::brake);
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::land);
}

TEST_F(MissionStop, SaysWhyAVehicleCouldNotBeStopped) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  copter.is_silent = true;
  run->stop();
  settle();
  EXPECT_TRUE(world->has_logged("copter 1 could not be stopped: "));
}

TEST_F(MissionStop, LeavesTheStopToATaskThatStartsInTheSameTurn) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const first = start();
  ASSERT_TRUE(world->comes_to(*first, "item 3/"));
  first->stop();
  auto const second = start(MavCmd::nav_land);
  settle();
  ASSERT_TRUE(world->run_until([&] { return second->state() != RunState::in_progress; }));
  EXPECT_EQ(second->state(), RunState::done) << second->error();
  // Once to leave AUTO before the upload; not once more for the stop.
  EXPECT_EQ(copter.modes_commanded(), std::vector{copter_mode::brake});
}

TEST_F(MissionStop, HoldsAVehicleThatStillFliesTheTaskBefore) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const first = start();
  ASSERT_TRUE(world->comes_to(*first, "item 3/"));
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  auto const second = start();
  ASSERT_TRUE(world->comes_to(*second, "stopping what it does"));
  world->run_for(300ms);
  second->stop();
  copter.ignored_commands.clear();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_TRUE(copter.is_flying);
}

TEST_F(MissionStop, HoldsAVehicleWhoseNextTaskCannotBeFlown) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const first = start();
  ASSERT_TRUE(world->comes_to(*first, "item 3/"));
  auto const second = world->platform->start(task_of({.name = "nothing", .home = std::nullopt, .items = {}}), one);
  EXPECT_EQ(second->error(), "the mission has no items");
  settle();
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST_F(MissionStop, SendsNothingWhenThePilotWasFaster) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start();
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  copter.change_mode(copter_mode::rtl);
  world->run_until([&] { return world->state().mode.value == "RTL"; });
  auto const commanded = copter.modes_commanded();
  run->stop();
  settle();
  EXPECT_EQ(copter.mode, copter_mode::rtl);
  EXPECT_EQ(copter.modes_commanded(), commanded);
}

TEST_F(MissionStop, DoesNothingToARunThatHasEnded) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(MavCmd::nav_land);
  ASSERT_TRUE(world->run_until([&] { return run->state() == RunState::done; }));
  auto const heard = copter.heard.size();
  run->stop();
  settle();
  world->run_for(5s);
  EXPECT_EQ(run->state(), RunState::done);
  EXPECT_EQ(copter.heard.size(), heard);
}

// Row 96: what Ctrl-C does.
TEST_F(MissionStop, MakesEveryVehicleWithARunOfOursSafeAndNoOther) {
  auto& first = world->add();
  auto& second = world->add({.address = {2, 1}});
  auto& bystander = world->add({.address = {3, 1}});
  bystander.is_armed = bystander.is_flying = true;
  bystander.change_mode(copter_mode::automatic);
  world->run_for(5s);
  auto const run = start();
  auto const other = world->platform->start(task_of(mission_ending_with(MavCmd::nav_loiter_unlim)), VehicleId{"2"});
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  ASSERT_TRUE(world->comes_to(*other, "item 3/"));
  world->loop.run_until_done(world->platform->make_safe(OnStop::rtl));
  EXPECT_EQ(first.mode, copter_mode::rtl);
  EXPECT_EQ(second.mode, copter_mode::rtl);
  EXPECT_EQ(bystander.mode, copter_mode::automatic);
  EXPECT_EQ(run->state(), RunState::failed);
}

/// Whenever the stop comes, on a bad link: afterwards the vehicle is not in AUTO, and does not get there.
class StopAtAnyTime : public MissionStop, public testing::WithParamInterface<int> {};

TEST_P(StopAtAnyTime, NeverLeavesAStartBehind) {
  auto& copter = world->add({.request_spacing = 100ms},
                            {.loss = 0.2, .delay = 150ms, .seed = static_cast<std::uint64_t>(GetParam())});
  world->run_for(10s);
  auto const run = start();
  world->run_for(GetParam() * 150ms);
  run->stop();
  settle();
  EXPECT_NE(copter.mode, copter_mode::automatic);
  world->run_for(30s);
  EXPECT_NE(copter.mode, copter_mode::automatic);
  EXPECT_TRUE(copter.is_flying || !copter.is_armed);
}

INSTANTIATE_TEST_SUITE_P(Times, StopAtAnyTime, testing::Range(0, 240, 5));

}  // namespace
}  // namespace lapwing::fleet
