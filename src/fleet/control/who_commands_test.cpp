#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using vehicle::Action;
using vehicle::VehicleId;

struct WhoCommands : ::testing::Test {
  WhoCommands() {
    world.add_ready();
    (void)world.give({.action = Action::set_mode, .mode = "GUIDED"}, {"1"}, "anna");
    world.run_for(3s);
  }
  std::string commander() { return world.state().control.commander; }

  ControlWorld world;
  VehicleId const one{"1"};
};

TEST_F(WhoCommands, BelongsToWhoCommandsAVehicleThatNobodyHas) {
  EXPECT_EQ(commander(), "anna");
  auto const number = world.give({.action = Action::arm}, {"1"}, "ben");
  EXPECT_EQ(world.outcome(number).reason, "copter 1 is commanded by anna");
}

TEST_F(WhoCommands, IsGrantedWhenNobodyAnswersInTime) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  EXPECT_EQ(world.state().control.asked_for_by, "ben");
  world.run_for(9s);
  EXPECT_EQ(commander(), "anna");
  world.run_for(2s);
  EXPECT_EQ(commander(), "ben");
  EXPECT_EQ(world.state().control.asked_for_by, "");
}

TEST_F(WhoCommands, IsHandedOverAtOnceWhenItsHolderAgrees) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  EXPECT_TRUE(world.control->yield_control(one, "anna"));
  EXPECT_EQ(commander(), "ben");
}

TEST_F(WhoCommands, StaysWhenItsHolderRefuses) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  EXPECT_TRUE(world.control->keep_control(one, "anna"));
  world.run_for(20s);
  EXPECT_EQ(commander(), "anna");
}

TEST_F(WhoCommands, IsGrantedWhenItsHolderIsGone) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  world.control->forget("anna");
  EXPECT_EQ(commander(), "ben");
  world.control->forget("ben");
  EXPECT_EQ(commander(), "");
  EXPECT_TRUE(world.control->request_control(one, "anna"));
  EXPECT_EQ(commander(), "anna") << "nobody has to be asked";
}

TEST_F(WhoCommands, DoesNotGoToWhoAskedAndIsGone) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  world.control->forget("ben");
  EXPECT_EQ(world.state().control.asked_for_by, "");
  EXPECT_TRUE(world.control->request_control(one, "carla")) << "nobody else asks any more";
  world.control->forget("carla");
  world.run_for(15s);
  EXPECT_EQ(commander(), "anna");
}

TEST_F(WhoCommands, IsAskedForByOneAtATime) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  auto const second = world.control->request_control(one, "carla");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message, "ben asks for copter 1 already");
}

TEST_F(WhoCommands, AnswersOnlyItsHolder) {
  EXPECT_FALSE(world.control->yield_control(one, "ben"));
  EXPECT_FALSE(world.control->keep_control(one, "ben"));
  EXPECT_FALSE(world.control->request_control(VehicleId{"9"}, "ben"));
}

TEST_F(WhoCommands, ForgetsARequestThatWasMadeBeforeAnother) {
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  world.run_for(5s);
  EXPECT_TRUE(world.control->keep_control(one, "anna"));
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  world.run_for(7s);
  EXPECT_EQ(commander(), "anna") << "the time of the second request counts";
  world.run_for(4s);
  EXPECT_EQ(commander(), "ben");
}

TEST_F(WhoCommands, OfAScriptGoesToAnOperatorWhoWaits) {
  world.control->forget("anna");
  auto const run = world.platform->start(task_of(mission_ending_with(mavlink::MavCmd::nav_loiter_unlim)), one);
  ASSERT_TRUE(world.run_until([&] { return run->progress().contains("item"); }));
  EXPECT_TRUE(world.control->request_control(one, "ben"));
  world.run_for(11s);
  EXPECT_EQ(commander(), "ben");
  EXPECT_EQ(run->error(), "ben took copter 1 over");
}

}  // namespace
}  // namespace lapwing::fleet
