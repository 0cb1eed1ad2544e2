#include "fleet/control/fleet_control.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// What a command came to is told by what the vehicle has shown since, of it alone.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;

TEST(Confirmation, DoesNotConfirmAnArmingIntoSilence) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.is_silent = true;
  world.run_for(13s);
  auto const number = world.give({.action = Action::arm});
  EXPECT_NE(world.end_of(number), CommandState::confirmed) << "it was armed before";
}

TEST(Confirmation, ConfirmsAnArmingOfWhatIsArmedByANewerHeartbeat) {
  ControlWorld world;
  world.add_flying();
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::confirmed);
}

TEST(Confirmation, DoesNotConfirmATakeOffThatGoesNoHigher) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.climbs = false;
  auto const number = world.give({.action = Action::take_off, .height_m = 20.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  copter.height_m = 7.0;
  world.run_for(60s);
  EXPECT_EQ(world.outcome(number).state, CommandState::under_way);
  EXPECT_EQ(world.outcome(number).reason, "at 7 of 20 m");
  EXPECT_NEAR(world.outcome(number).left_m.value_or(0.0), 13.0, 0.1);
}

TEST(Confirmation, SaysThatAnEmergencyStopCutATakeOffShort) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.run_until([&] { return copter.height_m > 20.0; }, 20s));
  EXPECT_TRUE(world.stops_all());
  EXPECT_EQ(world.outcome(number).state, CommandState::cut_short);
  EXPECT_TRUE(world.outcome(number).reason.starts_with("emergency stop by operator 1, at "))
      << world.outcome(number).reason;
}

TEST(Confirmation, SaysWhereItIsWhenItIsCutShortAndNotWhereItWasWhenThatWasLastTold) {
  ControlWorld world;
  world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  auto const told = world.outcome(number).reason;
  EXPECT_TRUE(world.run_until([&] { return world.outcome(number).reason != told; }, 20s));
  world.run_for(900ms);
  EXPECT_TRUE(world.stops_all());
  auto const cut = world.outcome(number).reason;
  double const said_m = std::stod(cut.substr(cut.find(", at ") + 5));
  EXPECT_NEAR(said_m, world.state().motion.relative_alt_m.value.value_or(0.0), 2.0) << cut;
}

TEST(Confirmation, SaysThatALaterCommandCutAnEarlierOneShort) {
  ControlWorld world;
  world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  (void)world.give({.action = Action::hold}, {"1"}, "operator 2");
  EXPECT_EQ(world.outcome(number).state, CommandState::cut_short);
  EXPECT_TRUE(world.outcome(number).reason.starts_with("hold by operator 2 came after it, at "));
}

TEST(Confirmation, SaysThatThePilotCutACommandShort) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  copter.change_mode(copter_mode::stabilize);
  EXPECT_EQ(world.end_of(number), CommandState::cut_short);
  EXPECT_TRUE(world.outcome(number).reason.starts_with(
      "mode changed to STABILIZE (GUIDED to STABILIZE, not asked for here), at "))
      << world.outcome(number).reason;
}

TEST(Confirmation, DoesNotConfirmGoingToAPlaceByBeingGuided) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.moves = false;
  auto const there = geo::displaced(TestAutopilot::home, {.north = 400, .east = 0, .down = 0});
  auto const number = world.give({.action = Action::go_to, .place = there});
  EXPECT_EQ(world.end_of(number), CommandState::timed_out);
  EXPECT_EQ(world.outcome(number).reason, "accepted, but it does not come nearer");
}

TEST(Confirmation, TellsHowFarItIsToAPlaceUntilItIsThere) {
  for (bool const tells_target : {false, true}) {
    ControlWorld world;
    auto& copter = world.add_flying();
    copter.tells_target = tells_target;
    auto const there = geo::displaced(TestAutopilot::home, {.north = 400, .east = 0, .down = 0});
    auto const number = world.give({.action = Action::go_to, .place = there});
    EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
    EXPECT_TRUE(world.run_until([&] { return world.outcome(number).left_m.value_or(1e9) < 200.0; }, 40s));
    EXPECT_TRUE(world.outcome(number).reason.ends_with(" m to go")) << world.outcome(number).reason;
    EXPECT_EQ(world.end_of(number), CommandState::confirmed);
    EXPECT_EQ(world.outcome(number).reason, "there");
    EXPECT_FALSE(world.outcome(number).left_m);
  }
}

TEST(Confirmation, SaysThatWhatIsUnderWayIsNotHeard) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  copter.is_silent = true;
  world.run_for(12s);
  EXPECT_EQ(world.outcome(number).state, CommandState::under_way);
  EXPECT_NE(world.outcome(number).reason.find("of 100 m; not heard for 1"), std::string::npos)
      << world.outcome(number).reason;
}

TEST(Confirmation, CorrectsALandingThatShowsLate) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.is_silent = true;
  auto const number = world.give({.action = Action::land});
  EXPECT_TRUE(world.comes_to(number, CommandState::timed_out));
  world.run_for(30s);
  copter.change_mode(copter_mode::land);  // it had heard the command
  copter.disarm();
  copter.is_silent = false;
  EXPECT_TRUE(world.comes_to(number, CommandState::confirmed));
  EXPECT_EQ(world.outcome(number).reason, "on the ground, motors off");
  EXPECT_TRUE(world.has_logged("land of vehicle 1: confirmed after all"));
}

TEST(Confirmation, DoesNotCorrectWhatTheVehicleWasSeenNotToDo) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  auto const number = world.give({.action = Action::land});
  EXPECT_EQ(world.end_of(number), CommandState::timed_out);
  world.run_for(60s);
  copter.change_mode(copter_mode::land);  // by its pilot
  copter.disarm();
  world.run_for(10s);
  EXPECT_EQ(world.outcome(number).state, CommandState::timed_out);
}

TEST(Confirmation, KeepsACommandInSightAsLongAsItIsUnderWay) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.climbs = false;
  copter.height_m = 2.0;
  world.add({.address = {2, 1}});
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  for (int i = 0; i < 30; ++i) (void)world.end_of(world.give({.action = Action::hold}, {"2"}));
  EXPECT_EQ(world.outcome(number).state, CommandState::under_way);
  EXPECT_EQ(world.control->commands().size(), 12u);
}

}  // namespace
}  // namespace lapwing::fleet
