#include "fleet/control/fleet_control.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// What a link delivers late must not move a vehicle: it is not sent, or taken back.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;

TEST(LateArming, SendsNoArmingIntoALinkThatStalls) {
  ControlWorld world;
  auto& copter = world.add_ready();
  world.way->begin();
  world.run_for(5s);
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.end_of(number), CommandState::expired);
  world.way->end();
  world.run_for(10s);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
  EXPECT_FALSE(copter.is_armed);
}

TEST(LateArming, CarriesOutWhatTheLinkLetsThroughInTime) {
  ControlWorld world;
  world.add_ready();
  world.way->begin();
  world.run_for(5s);
  auto const number = world.give({.action = Action::arm});
  world.run_for(5s);
  world.way->end();
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
}

TEST(LateArming, TakesBackAnArmingThatTheLinkDeliversLate) {
  ControlWorld world;
  auto& copter = world.add_ready();
  world.way->begin();
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.end_of(number), CommandState::expired) << world.outcome(number).reason;
  world.run_for(20s);
  EXPECT_FALSE(copter.is_armed);
  world.way->end();
  EXPECT_TRUE(world.run_until([&] { return world.has_logged("an arming that came too late"); }));
  EXPECT_TRUE(world.run_until([&] { return !copter.is_armed; }, 3s));
  world.run_for(5s);
  EXPECT_FALSE(copter.is_armed);
}

TEST(LateArming, DoesNotTakeADisarmingForALateArming) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_EQ(world.end_of(world.give({.action = Action::disarm})), CommandState::confirmed);
  world.run_for(10s);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(LateArming, LeavesAnArmingAloneThatIsWantedAgain) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_EQ(world.end_of(world.give({.action = Action::take_off})), CommandState::confirmed);
  world.run_for(10s);
  EXPECT_TRUE(copter.is_armed);
}

TEST(LateArming, LeavesAnArmingAloneThatFollowsADisarmingAtOnce) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  (void)world.give({.action = Action::disarm});
  world.run_for(200ms);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::confirmed);
  world.run_for(4s);
  EXPECT_TRUE(copter.is_armed);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(LateArming, LeavesAnArmingOfSomebodyElseAlone) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.is_armed = true;  // by its pilot's sticks
  copter.is_flying = true;
  world.run_for(10s);
  EXPECT_TRUE(copter.is_armed);
}

/// Armed by somebody else, under the id of this station.
void arm_as_if_asked_here(ControlWorld& world, TestAutopilot& copter) {
  copter.is_armed = copter.is_flying = true;
  copter.send(mavlink::CommandAck{
      .target = world.connection.self(), .command = MavCmd::component_arm_disarm, .progress = std::nullopt});
  world.run_for(8s);
}

TEST(LateArming, TakesNoArmingBackAfterOneThatWasRefused) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.arming_refusal = "Arm: Throttle too high";
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::refused);
  arm_as_if_asked_here(world, copter);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(LateArming, TakesNoArmingBackThatComesMuchTooLate) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  world.run_for(61s);
  arm_as_if_asked_here(world, copter);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(LateArming, TakesALateArmingBackThoughADisarmingWasAcknowledgedBefore) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_EQ(world.end_of(world.give({.action = Action::disarm})), CommandState::confirmed);
  world.run_for(5s);
  EXPECT_TRUE(world.connection.send({1, 1}, mavlink::CommandLong{.command = MavCmd::component_arm_disarm,
                                                                 .params = {1.0F}}));  // as a link delivers it late
  EXPECT_TRUE(world.run_until([&] { return copter.is_armed; }, 1s));
  EXPECT_TRUE(world.run_until([&] { return !copter.is_armed; }, 5s));
  EXPECT_TRUE(world.has_logged("an arming that came too late"));
}

TEST(LateArming, TakesNoArmingBackThatItHasPassedOn) {
  ControlWorld world;
  auto& copter = world.add_ready();
  mavlink::PeerRef peer{};
  auto const ear = world.connection.subscribe(1, [&](mavlink::Received const& heard) { peer = heard.from; });
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  mavlink::CommandLong const arming{
      .target = {1, 1}, .command = MavCmd::component_arm_disarm, .confirmation = 0, .params = {1.0F}};
  auto const frame = mavlink::encode(arming, world.connection.self(), 0);
  EXPECT_TRUE(world.connection.pass_on(peer, mavlink::serialize(frame).bytes()));
  world.run_for(6s);
  EXPECT_TRUE(copter.is_armed);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(LateArming, SendsNothingThatMovesToALostVehicle) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.is_silent = true;
  world.run_for(25s);
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.outcome(number).state, CommandState::refused);
  EXPECT_EQ(world.outcome(number).reason, "copter 1 is not heard: nothing that moves it is sent");
}

}  // namespace
}  // namespace lapwing::fleet
