#include "fleet/control.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/test_control.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

TEST(Control, ShowsACommandFromWaitingToConfirmed) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.outcome(number).state, CommandState::waiting);
  EXPECT_TRUE(world.comes_to(number, CommandState::accepted));
  EXPECT_TRUE(world.comes_to(number, CommandState::confirmed));
  EXPECT_TRUE(copter.is_armed);
  EXPECT_EQ(world.control->commands().back().by, "operator 1");
}

TEST(Control, GivesEachVehicleItsOwnOutcome) {
  ControlWorld world;
  world.add({.address = {1, 1}});
  auto& refusing = world.add({.address = {2, 1}});
  auto& silent = world.add({.address = {3, 1}});
  refusing.arming_refusal = "Arm: Throttle too high";
  silent.ignored_commands.insert(MavCmd::component_arm_disarm);
  world.run_for(4s);
  auto const number = world.give({.action = Action::arm}, {"1", "2", "3", "9", "1"});
  ASSERT_EQ(world.control->commands().back().outcomes.size(), 4u) << "a vehicle that is named twice gets it once";
  EXPECT_EQ(world.end_of(number, 0), CommandState::confirmed);
  EXPECT_EQ(world.end_of(number, 1), CommandState::refused);
  EXPECT_EQ(world.outcome(number, 1).reason, "arming refused: Arm: Throttle too high");
  EXPECT_EQ(world.end_of(number, 2), CommandState::timed_out);
  EXPECT_EQ(world.outcome(number, 3).reason, "there is no vehicle 9");
}

TEST(Control, IsFastForManyVehicles) {
  ControlWorld world;
  std::vector<std::string> ids;
  for (std::uint8_t id = 1; id <= 50; ++id) {
    world.add({.address = {id, 1}});
    ids.push_back(std::to_string(id));
  }
  world.run_for(5s);
  auto const begun = world.loop.now();
  auto const number = world.give({.action = Action::arm}, ids);
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(world.end_of(number, i), CommandState::confirmed) << i;
  EXPECT_LT(world.loop.now() - begun, 3s);
}

TEST(Control, TakesOff) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 15.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  EXPECT_LT(copter.height_m, 10.0);
  EXPECT_TRUE(world.outcome(number).reason.ends_with(" of 15 m")) << world.outcome(number).reason;
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_EQ(world.outcome(number).reason, "at 15 m");
  EXPECT_GT(copter.height_m, 14.0);
  EXPECT_EQ(copter.mode, copter_mode::guided);
}

// ---- what is confirmed, and what is not

TEST(Control, DoesNotConfirmAnArmingIntoSilence) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.is_silent = true;
  world.run_for(13s);
  auto const number = world.give({.action = Action::arm});
  EXPECT_NE(world.end_of(number), CommandState::confirmed) << "it was armed before";
}

TEST(Control, ConfirmsAnArmingOfWhatIsArmedByANewerHeartbeat) {
  ControlWorld world;
  world.add_flying();
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::confirmed);
}

TEST(Control, DoesNotConfirmATakeOffThatGoesNoHigher) {
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

TEST(Control, SaysThatAnEmergencyStopCutATakeOffShort) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.run_until([&] { return copter.height_m > 20.0; }, 20s));
  EXPECT_TRUE(world.stops_all());
  EXPECT_EQ(world.outcome(number).state, CommandState::cut_short);
  EXPECT_TRUE(world.outcome(number).reason.starts_with("emergency stop by operator 1, at "))
      << world.outcome(number).reason;
}

TEST(Control, SaysWhereItIsWhenItIsCutShortAndNotWhereItWasWhenThatWasLastTold) {
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
  EXPECT_NEAR(said_m, world.state().relative_alt_m.value.value_or(0.0), 2.0) << cut;
}

TEST(Control, SaysThatALaterCommandCutAnEarlierOneShort) {
  ControlWorld world;
  world.add_ready();
  auto const number = world.give({.action = Action::take_off, .height_m = 100.0});
  EXPECT_TRUE(world.comes_to(number, CommandState::under_way));
  (void)world.give({.action = Action::hold}, {"1"}, "operator 2");
  EXPECT_EQ(world.outcome(number).state, CommandState::cut_short);
  EXPECT_TRUE(world.outcome(number).reason.starts_with("hold by operator 2 came after it, at "));
}

TEST(Control, SaysThatThePilotCutACommandShort) {
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

TEST(Control, DoesNotConfirmGoingToAPlaceByBeingGuided) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.moves = false;
  auto const there = geo::displaced(TestAutopilot::home, {.north = 400, .east = 0, .down = 0});
  auto const number = world.give({.action = Action::go_to, .place = there});
  EXPECT_EQ(world.end_of(number), CommandState::timed_out);
  EXPECT_EQ(world.outcome(number).reason, "accepted, but it does not come nearer");
}

TEST(Control, TellsHowFarItIsToAPlaceUntilItIsThere) {
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

TEST(Control, SaysThatWhatIsUnderWayIsNotHeard) {
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

TEST(Control, CorrectsALandingThatShowsLate) {
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

TEST(Control, DoesNotCorrectWhatTheVehicleWasSeenNotToDo) {
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

TEST(Control, KeepsTheHeightWhenItGoesToAPlaceUnlessToldOtherwise) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.height_m = 100.0;
  world.run_for(2s);
  (void)world.give({.action = Action::go_to, .place = TestAutopilot::home});
  world.run_for(2s);
  ASSERT_TRUE(copter.goal);
  EXPECT_NEAR(copter.goal->alt_m, 100.0, 0.1);
}

TEST(Control, GivesPx4HeightsAboveTheSea) {
  ControlWorld world;
  auto& copter = world.add_ready({.autopilot = mavlink::MavAutopilot::px4});
  copter.is_armed = copter.is_flying = true;  // 120 m above the sea
  copter.height_m = 20.0;
  world.run_for(2s);
  (void)world.give({.action = Action::go_to, .place = TestAutopilot::home});
  world.run_for(1s);
  ASSERT_TRUE(copter.goal);
  EXPECT_NEAR(copter.goal->alt_m, 120.0, 0.1);
  (void)world.give({.action = Action::go_to, .height_m = 50.0, .place = TestAutopilot::home});
  world.run_for(1s);
  EXPECT_NEAR(copter.goal->alt_m, 150.0, 0.1);
}

TEST(Control, KeepsACommandInSightAsLongAsItIsUnderWay) {
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

TEST(Control, SendsAVehicleToAPlaceWithoutLosingPrecision) {
  ControlWorld world;
  auto& copter = world.add_flying();
  auto const there = geo::Wgs84::from_degrees(40.0012345, -8.0012345, 0.0);
  auto const number = world.give({.action = Action::go_to, .height_m = 25.0, .place = there});
  copter.height_m = 25.0;
  EXPECT_EQ(world.end_of(number), CommandState::confirmed) << world.outcome(number).reason;
  auto const found = std::ranges::find_if(copter.heard, [](auto const& message) {
    auto const* sent = std::get_if<mavlink::CommandInt>(&message);
    return sent && sent->command == MavCmd::do_reposition;
  });
  ASSERT_NE(found, copter.heard.end());
  auto const& sent = std::get<mavlink::CommandInt>(*found);
  EXPECT_NEAR(sent.place.lat_rad, there.lat_rad, 1e-9);
  EXPECT_EQ(sent.place.z_m, 25.0);
  EXPECT_EQ(sent.frame, mavlink::MavFrame::global_relative_alt);
}

TEST(Control, RefusesWhatAVehicleCannotDo) {
  ControlWorld world;
  world.add(a_rover(2));
  world.add_ready();
  auto const rovers = world.give({.action = Action::take_off}, {"2"});
  EXPECT_EQ(world.end_of(rovers), CommandState::refused);
  EXPECT_EQ(world.outcome(rovers).reason, "rover 2 does not fly");
  EXPECT_EQ(world.state("2").control.commander, "") << "it has not been commanded";
  auto const lands = world.give({.action = Action::land}, {"2"});
  EXPECT_EQ(world.outcome(lands).reason, "rover 2 cannot land by itself");
  auto const mode = world.give({.action = Action::set_mode, .mode = "SIDEWAYS"});
  EXPECT_EQ(world.outcome(mode).reason, "copter 1 has no mode SIDEWAYS");
  auto const on_ground = world.give({.action = Action::go_to, .place = TestAutopilot::home});
  EXPECT_EQ(world.outcome(on_ground).reason, "copter 1 is on the ground: take off first");
  auto const resumed = world.give({.action = Action::resume_mission});
  EXPECT_EQ(world.outcome(resumed).reason, "copter 1 is not armed: start the mission instead");
}

TEST(Control, RefusesCommandsWithoutWhatTheyNeed) {
  ControlWorld world;
  world.add_ready();
  std::vector<VehicleId> const one{{"1"}};
  EXPECT_FALSE(world.control->command({.action = Action::go_to}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::set_mode}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::take_off, .height_m = -5.0}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::hold}, {}, "operator 1", false));
  EXPECT_TRUE(world.control->commands().empty());
}

TEST(Control, SetsModesByName) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::set_mode, .mode = "guided"});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_EQ(copter.mode, copter_mode::guided);
  EXPECT_EQ(world.outcome(number).reason, "GUIDED");
}

TEST(Control, StartsPausesAndResumesAMission) {
  ControlWorld world;
  auto& vehicle = world.add_ready(a_rover(1));
  vehicle.mission.resize(4);
  EXPECT_EQ(world.end_of(world.give({.action = Action::start_mission})), CommandState::confirmed);
  EXPECT_EQ(vehicle.mode, rover_mode::automatic);
  EXPECT_EQ(world.end_of(world.give({.action = Action::pause_mission})), CommandState::confirmed);
  EXPECT_EQ(vehicle.mode, rover_mode::hold);
  EXPECT_EQ(world.end_of(world.give({.action = Action::resume_mission})), CommandState::confirmed);
  EXPECT_EQ(vehicle.mode, rover_mode::automatic);
}

TEST(Control, LetsALaterCommandReplaceAnEarlierOne) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  auto const first = world.give({.action = Action::arm});
  world.run_for(1s);
  auto const arms = copter.commands_heard(MavCmd::component_arm_disarm);
  auto const second = world.give({.action = Action::hold});
  EXPECT_EQ(world.outcome(first).state, CommandState::superseded);
  EXPECT_EQ(world.end_of(second), CommandState::confirmed);
  world.run_for(15s);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), arms) << "nothing of it follows";
}

// ---- late commands

TEST(Control, SendsNoArmingIntoALinkThatStalls) {
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

TEST(Control, CarriesOutWhatTheLinkLetsThroughInTime) {
  ControlWorld world;
  world.add_ready();
  world.way->begin();
  world.run_for(5s);
  auto const number = world.give({.action = Action::arm});
  world.run_for(5s);
  world.way->end();
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
}

TEST(Control, TakesBackAnArmingThatTheLinkDeliversLate) {
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

TEST(Control, DoesNotTakeADisarmingForALateArming) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_EQ(world.end_of(world.give({.action = Action::disarm})), CommandState::confirmed);
  world.run_for(10s);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(Control, LeavesAnArmingAloneThatIsWantedAgain) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_EQ(world.end_of(world.give({.action = Action::take_off})), CommandState::confirmed);
  world.run_for(10s);
  EXPECT_TRUE(copter.is_armed);
}

TEST(Control, LeavesAnArmingAloneThatFollowsADisarmingAtOnce) {
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

TEST(Control, LeavesAnArmingOfSomebodyElseAlone) {
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

TEST(Control, TakesNoArmingBackAfterOneThatWasRefused) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.arming_refusal = "Arm: Throttle too high";
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::refused);
  arm_as_if_asked_here(world, copter);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(Control, TakesNoArmingBackThatComesMuchTooLate) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  EXPECT_EQ(world.end_of(world.give({.action = Action::arm})), CommandState::timed_out);
  copter.ignored_commands.clear();
  world.run_for(61s);
  arm_as_if_asked_here(world, copter);
  EXPECT_FALSE(world.has_logged("came too late"));
}

TEST(Control, TakesALateArmingBackThoughADisarmingWasAcknowledgedBefore) {
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

TEST(Control, TakesNoArmingBackThatItHasPassedOn) {
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

TEST(Control, SendsNothingThatMovesToALostVehicle) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.is_silent = true;
  world.run_for(25s);
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.outcome(number).state, CommandState::refused);
  EXPECT_EQ(world.outcome(number).reason, "copter 1 is not heard: nothing that moves it is sent");
}

// ---- beside a script

struct WithScript : ControlWorld {
  TestAutopilot& copter = add_ready();
  std::unique_ptr<tasks::TaskRun> run = start_mission();
  bool is_flying() { return comes_to(*run, "item"); }
};

TEST(Control, KeepsItsHandsOffAVehicleThatAScriptCommands) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  EXPECT_EQ(world.state().control.commander, "script");
  auto const number = world.give({.action = Action::go_to, .place = TestAutopilot::home});
  EXPECT_EQ(world.outcome(number).reason, "copter 1 is commanded by script");
  EXPECT_EQ(world.run->state(), tasks::RunState::in_progress);
}

TEST(Control, KeepsAScriptFromMovingAVehicleThatAnOperatorCommands) {
  ControlWorld world;
  auto& copter = world.add_ready();
  EXPECT_EQ(world.end_of(world.give({.action = Action::set_mode, .mode = "GUIDED"})), CommandState::confirmed);
  auto const says = [&](std::int64_t command) {
    std::vector<tasks::MessageField> const fields{{"command", command}, {"param1", 1.0}};
    return world.platform->send_message(VehicleId{"1"}, "COMMAND_LONG", fields);
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

TEST(Control, TakesAVehicleOverFromAScript) {
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

TEST(Control, LetsAStopThroughWhoeverCommands) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  auto const number = world.give({.action = Action::hold});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_EQ(world.copter.mode, copter_mode::brake);
  EXPECT_EQ(world.run->state(), tasks::RunState::failed);
}

TEST(Control, StopsInTheMiddleOfAnUpload) {
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

TEST(Control, LeavesNoPartsOfTwoPlansWhenItTakesAVehicleOver) {
  InMidUpload world;
  auto const number = world.give({.action = Action::hold}, {"1"}, "operator 1", true);
  EXPECT_TRUE(world.is_cleared());
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_TRUE(world.has_logged("copter 1: the upload was given up: what the vehicle held was cleared"));
}

TEST(Control, LeavesNoPartsOfTwoPlansAfterAnEmergencyStop) {
  InMidUpload world;
  EXPECT_TRUE(world.stops_all());
  EXPECT_TRUE(world.is_cleared());
}

TEST(Control, LeavesNoPartsOfTwoPlansWhenAVehicleIsBackThatWasLost) {
  InMidUpload world;
  world.copter.is_silent = true;
  world.run_for(30s);
  EXPECT_TRUE(world.run->vehicle_failed());
  EXPECT_FALSE(world.copter.mission.empty());
  world.copter.is_silent = false;
  EXPECT_TRUE(world.is_cleared());
}

TEST(Control, ClearsPartsOfPlansThoughTheFirstStopIsFollowedByAnother) {
  InMidUpload world;
  world.run->stop();
  world.run_for(1ms);
  (void)world.give({.action = Action::hold}, {"1"}, "operator 1", true);
  EXPECT_TRUE(world.is_cleared());
}

TEST(Control, FliesNoMixtureOfTwoPlans) {
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

TEST(Control, FliesAPlanThatSomebodyPutInPlaceOfAMixture) {
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

TEST(Control, GivesVehiclesBackWhenTheScriptHasEnded) {
  WithScript world;
  ASSERT_TRUE(world.is_flying());
  world.run->stop();
  world.loop.run_until_done(world.platform->settle());
  EXPECT_EQ(world.state().control.commander, "");
}

}  // namespace
}  // namespace lapwing::fleet
