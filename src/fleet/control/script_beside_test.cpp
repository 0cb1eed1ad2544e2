#include "fleet/control/fleet_control.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// An operator beside a script: who commands a vehicle, and what is left on it when that changes.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

struct WithScript : ControlWorld {
  TestAutopilot& copter = add_ready();
  std::unique_ptr<tasks::TaskRun> run = start_mission();
  bool is_flying() { return comes_to(*run, "item"); }
};

TEST(ScriptBeside, KeepsItsHandsOffAVehicleThatAScriptCommands) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  EXPECT_EQ(world.state().control.commander, "script");
  auto const number = world.give({.action = Action::go_to, .place = TestAutopilot::home});
  EXPECT_EQ(world.outcome(number).reason, "copter 1 is commanded by script");
  EXPECT_EQ(world.run->state(), tasks::RunState::in_progress);
}

TEST(ScriptBeside, KeepsAScriptFromMovingAVehicleThatAnOperatorCommands) {
  ControlWorld world;
  auto& copter = world.add_ready();
  EXPECT_EQ(world.end_of(world.give({.action = Action::set_mode, .mode = "GUIDED"})), CommandState::confirmed);
  auto const says = [&](std::int64_t command) {
    std::vector<tasks::NamedValue> const fields{{"command", command}, {"param1", 1.0}};
    return world.send_message("1", "COMMAND_LONG", fields);
  };
  auto const arms = says(400);
  ASSERT_FALSE(arms);
  EXPECT_EQ(arms.error().message, "copter 1 is commanded by operator 1");
  EXPECT_TRUE(says(512)) << "a question moves nothing";
  ASSERT_TRUE(world.control->yield_control(VehicleId{"1"}, "operator 1"));
  EXPECT_TRUE(says(400));
  world.run_for(1s);
  EXPECT_TRUE(copter.is_armed);
}

TEST(ScriptBeside, TakesAVehicleOverFromAScript) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  auto const number = world.give({.action = Action::return_home}, {"1"}, "operator 1", true);
  EXPECT_EQ(world.run->state(), tasks::RunState::failed);
  EXPECT_EQ(world.run->error(), "operator 1 took copter 1 over");
  EXPECT_EQ(world.state().control.commander, "operator 1");
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  EXPECT_EQ(world.copter.modes_commanded().back(), copter_mode::rtl) << "the script's end sends nothing after it";
  auto const again = world.platform->start(task_of(mission_ending_with(MavCmd::nav_land)), VehicleId{"1"});
  EXPECT_EQ(again->error(), "copter 1 is commanded by operator 1");
}

TEST(ScriptBeside, LetsAStopThroughWhoeverCommands) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  auto const number = world.give({.action = Action::hold});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_EQ(world.copter.mode, copter_mode::brake);
  EXPECT_EQ(world.run->state(), tasks::RunState::failed);
}

TEST(ScriptBeside, StopsInTheMiddleOfAnUpload) {
  WithScript world;
  ASSERT_TRUE(world.comes_to(*world.run, "uploading"));
  auto const number = world.give({.action = Action::hold});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_TRUE(world.copter.was_upload_cancelled());
  world.run_for(20s);
  EXPECT_EQ(world.copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

/// A script's upload over a plan of fifty items, which has come to its third.
struct InMidUpload : ControlWorld {
  TestAutopilot& copter = add_ready({.request_spacing = 500ms});
  std::unique_ptr<tasks::TaskRun> run;
  InMidUpload() {
    copter.mission.resize(50);
    run = start_mission();
    EXPECT_TRUE(comes_to(*run, "uploading 2/"));
  }
  bool is_cleared() {
    return run_until([&] { return copter.mission.empty(); }, 10s);
  }
};

TEST(ScriptBeside, LeavesNoPartsOfTwoPlansWhenItTakesAVehicleOver) {
  InMidUpload world;
  auto const number = world.give({.action = Action::hold}, {"1"}, "operator 1", true);
  EXPECT_TRUE(world.is_cleared());
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_TRUE(world.has_logged("copter 1: the upload was given up: what the vehicle held was cleared"));
}

TEST(ScriptBeside, LeavesNoPartsOfTwoPlansAfterAnEmergencyStop) {
  InMidUpload world;
  EXPECT_TRUE(world.stops_all());
  EXPECT_TRUE(world.is_cleared());
}

TEST(ScriptBeside, LeavesNoPartsOfTwoPlansWhenAVehicleIsBackThatWasLost) {
  InMidUpload world;
  world.copter.is_silent = true;
  world.run_for(30s);
  EXPECT_TRUE(world.run->vehicle_failed());
  EXPECT_FALSE(world.copter.mission.empty());
  world.copter.is_silent = false;
  EXPECT_TRUE(world.is_cleared());
}

TEST(ScriptBeside, ClearsPartsOfPlansThoughTheFirstStopIsFollowedByAnother) {
  InMidUpload world;
  world.run->stop();
  world.run_for(1ms);
  (void)world.give({.action = Action::hold}, {"1"}, "operator 1", true);
  EXPECT_TRUE(world.is_cleared());
}

TEST(ScriptBeside, FliesNoMixtureOfTwoPlans) {
  InMidUpload world;
  auto const start = world.give({.action = Action::start_mission}, {"1"}, "operator 1", true);
  EXPECT_EQ(world.end_of(start), CommandState::refused);
  EXPECT_EQ(world.outcome(start).reason,
            "copter 1 may hold a part of one plan and a part of another: upload a plan first");
  auto const by_mode = world.give({.action = Action::set_mode, .mode = "AUTO"});
  EXPECT_EQ(world.end_of(by_mode), CommandState::refused);
  EXPECT_FALSE(world.copter.is_armed);
  EXPECT_TRUE(world.is_cleared());
  world.run_for(1s);
  auto const cleared = world.give({.action = Action::set_mode, .mode = "AUTO"});
  EXPECT_EQ(world.end_of(cleared), CommandState::confirmed) << "an empty plan is no mixture";
}

TEST(ScriptBeside, FliesAPlanThatSomebodyPutInPlaceOfAMixture) {
  InMidUpload world;
  world.copter.is_silent = true;
  world.run_for(30s);
  world.copter.is_silent = false;
  world.copter.send(mavlink::MissionAck{.target = {254, 190}, .type = mavlink::MissionType::mission});
  world.run_for(10s);
  EXPECT_FALSE(world.copter.mission.empty()) << "it is theirs";
  auto const start = world.give({.action = Action::set_mode, .mode = "AUTO"}, {"1"}, "operator 1", true);
  EXPECT_EQ(world.end_of(start), CommandState::confirmed);
}

TEST(ScriptBeside, GivesVehiclesBackWhenTheScriptHasEnded) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  world.run->stop();
  world.loop.run_until_done(world.platform->settle());
  EXPECT_EQ(world.state().control.commander, "");
}

}  // namespace
}  // namespace lapwing::fleet
