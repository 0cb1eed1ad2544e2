#include "fleet/plausibility/own_home.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// Vehicles tell their home every ten seconds, and who has just been heard has not yet. What is measured from there is
// known all the same.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MessageId;
using tasks::RunState;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

geo::Wgs84 north(double metres) {
  return geo::displaced(TestAutopilot::home, {.north = metres, .down = -20.0});
}

/// A copter in the air whose home nobody has heard of.
struct OwnHome : ::testing::Test {
  OwnHome() : copter(world.add()) {
    copter.denied_intervals.insert(MessageId::home_position);
    copter.parameters = {{"FENCE_ENABLE", 1.0F},   {"FENCE_TYPE", 2.0F},   {"FENCE_RADIUS", 300.0F},
                         {"FENCE_ACTION", 1.0F},   {"FENCE_MARGIN", 2.0F}, {"FENCE_AUTOENABLE", 0.0F},
                         {"FENCE_OPTIONS", 0.0F},  {"FENCE_TOTAL", 0.0F},  {"FENCE_ALT_MAX", 80.0F},
                         {"FENCE_ALT_MIN", -10.0F}};
    world.run_for(4s);
    copter.is_armed = copter.is_flying = true;
    copter.change_mode(copter_mode::guided);
    copter.place = north(180);
    world.run_for(2s);
  }

  /// The outcome of a flight over `metres` from home, once it is refused or sent.
  vehicle::CommandOutcome go_to(double metres) {
    auto const sent = copter.commands_heard(MavCmd::do_reposition);
    auto const number = world.give({.action = Action::go_to, .place = north(metres)});
    (void)world.run_until([&] {
      return world.outcome(number).state != CommandState::waiting ||
             copter.commands_heard(MavCmd::do_reposition) > sent;
    });
    return world.outcome(number);
  }

  ControlWorld world;
  TestAutopilot& copter;
};

TEST_F(OwnHome, IsAskedForBeforeAFenceIsMeasuredFromIt) {
  auto const outcome = go_to(420);
  EXPECT_EQ(outcome.state, CommandState::refused);
  EXPECT_NE(outcome.reason.find("120 m outside copter 1's own fence: 300 m round home"), std::string::npos)
      << outcome.reason;
  EXPECT_NE(go_to(200).state, CommandState::refused);
}

TEST_F(OwnHome, IsAskedForOnce) {
  (void)go_to(200);
  auto const asked = copter.commands_heard(MavCmd::request_message);
  (void)go_to(210);
  EXPECT_EQ(copter.commands_heard(MavCmd::request_message), asked);
}

TEST_F(OwnHome, ThatIsNotToldIsSaidAndHoldsNobodyUpForLong) {
  copter.has_home = false;
  auto const before = world.loop.now();
  EXPECT_NE(go_to(420).state, CommandState::refused);
  EXPECT_LT(world.loop.now() - before, 3s);
  EXPECT_TRUE(world.has_logged("copter 1 has not told its home"));
  auto const again = world.loop.now();
  EXPECT_NE(go_to(430).state, CommandState::refused);
  EXPECT_LT(world.loop.now() - again, 100ms) << "it is not asked in vain with every command";
}

TEST_F(OwnHome, IsNoMoveOfHomeForAMissionThatHasIt) {
  copter.parameters.clear();
  auto mission = mission_ending_with(MavCmd::nav_land);
  mission.home = TestAutopilot::home;
  auto const run = world.platform->start(task_of(mission), VehicleId{"1"});
  EXPECT_TRUE(world.run_until([&] { return !copter.mission.empty() || run->state() != RunState::in_progress; }, 60s));
  EXPECT_EQ(run->error(), "") << "it is in the air, 180 m from where its home is and stays";
  EXPECT_FALSE(copter.mission.empty());
}

}  // namespace
}  // namespace lapwing::fleet
