#include "fleet/control/emergency.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/raw_message.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::StopAction;
using vehicle::VehicleId;

TEST(EmergencyStop, StopsEveryVehicleInItsOwnWay) {
  ControlWorld world;
  auto& copter = world.add_flying();
  auto& rover = world.add(a_rover(2));
  auto& standing = world.add({.address = {3, 1}});
  rover.is_armed = true;
  rover.change_mode(rover_mode::automatic);
  world.run_for(4s);
  EXPECT_TRUE(world.stops_all());
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_TRUE(copter.is_flying);
  EXPECT_EQ(rover.mode, rover_mode::hold);
  EXPECT_FALSE(rover.is_armed);
  EXPECT_EQ(standing.commands_heard(MavCmd::component_arm_disarm), 1) << "an arming may be on its way to it";
  EXPECT_TRUE(world.stop_of("1").is_acknowledged);
  EXPECT_EQ(world.stop_of("1").detail, "BRAKE, armed");
}

TEST(EmergencyStop, DoesWhatItIsSetTo) {
  for (auto const& [action, mode] :
       {std::pair{StopAction::land, copter_mode::land}, std::pair{StopAction::return_home, copter_mode::rtl}}) {
    ControlWorld world;
    auto& copter = world.add_flying();
    EXPECT_TRUE(world.stops_all(action));
    EXPECT_EQ(copter.mode, mode);
  }
}

TEST(EmergencyStop, StopsMotorsInTheAirOnlyWhenAskedTo) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all(StopAction::terminate));
  EXPECT_FALSE(copter.is_armed);
}

TEST(EmergencyStop, StaysAsStrongAsItWasWhenItIsPressedOnceMore) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  world.control->emergency_stop(StopAction::terminate, "operator 1");
  world.run_for(1s);
  world.control->emergency_stop(std::nullopt, "operator 2");
  EXPECT_EQ(world.control->emergency().action, StopAction::terminate);
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.run_until([&] { return world.stop_of("1").is_confirmed; }, 10s));
  EXPECT_FALSE(copter.is_armed);
  world.control->release_emergency_stop("operator 1");
  world.control->emergency_stop(std::nullopt, "operator 1");
  EXPECT_EQ(world.control->emergency().action, StopAction::hold) << "a new one is what the station is set to";
}

TEST(EmergencyStop, IsRepeatedUntilItIsConfirmed) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(100s);
  EXPECT_FALSE(world.stop_of("1").is_acknowledged);
  EXPECT_FALSE(world.stop_of("1").is_confirmed);
  EXPECT_GT(world.stop_of("1").tries, 1);
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.all_confirm());
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST(EmergencyStop, ReachesVehiclesThatComeLater) {
  ControlWorld world;
  world.add_flying();
  EXPECT_TRUE(world.stops_all());
  auto& late = world.add({.address = {7, 1}});
  late.is_armed = late.is_flying = true;
  late.change_mode(copter_mode::automatic);
  EXPECT_TRUE(world.run_until([&] { return world.stop_of("7").is_confirmed; }, 20s));
  EXPECT_EQ(late.mode, copter_mode::brake);
}

TEST(EmergencyStop, ReachesAVehicleThatIsBack) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.is_silent = true;
  world.run_for(30s);
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(60s);
  EXPECT_FALSE(world.stop_of("1").is_confirmed);
  copter.is_silent = false;
  EXPECT_TRUE(world.all_confirm(20s));
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST(EmergencyStop, LetsNothingMoveAVehicleWhileItIsLatched) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  EXPECT_EQ(world.latched_with, "emergency stop by operator 1") << "scripts are told";
  for (auto const action : {Action::arm, Action::take_off, Action::start_mission, Action::resume_mission}) {
    auto const number = world.give({.action = action}, {"1"}, "operator 2", true);
    EXPECT_EQ(world.outcome(number).state, CommandState::refused) << to_string(action);
    EXPECT_EQ(world.outcome(number).reason, "emergency stop by operator 1: release it first");
  }
  auto const run = world.platform->start(task_of(mission_ending_with(MavCmd::nav_land)), VehicleId{"1"});
  EXPECT_EQ(run->error(), "emergency stop by operator 1: release it first");
  std::vector<tasks::NamedValue> const fields{{"command", std::int64_t{400}}, {"param1", 1.0}};
  EXPECT_FALSE(world.send_message("1", "COMMAND_LONG", fields));
  mavlink::SetPositionTargetGlobalInt const setpoint{};
  EXPECT_FALSE(world.connection.send({1, 1}, setpoint));
  EXPECT_FALSE(world.connection.send({1, 1}, mavlink::SetPositionTargetLocalNed{}));
  EXPECT_FALSE(world.connection.send({1, 1}, mavlink::SetMode{1, 1, copter_mode::automatic}));
  EXPECT_TRUE(world.connection.send({1, 1}, mavlink::ParamRequestList{}));
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST(EmergencyStop, HoldsBackWhatAnotherStationSendsToOneOrToAll) {
  ControlWorld world;
  world.add_ready();
  mavlink::PeerRef vehicle{};
  auto const ear = world.connection.subscribe(1, [&](mavlink::Received const& heard) { vehicle = heard.from; });
  world.run_for(2s);
  auto const passes = [&](mavlink::Address target, float arms) {
    mavlink::CommandLong const arming{
        .target = target, .command = MavCmd::component_arm_disarm, .confirmation = 0, .params = {arms}};
    return world.connection.pass_on(vehicle, mavlink::serialize(mavlink::encode(arming, {254, 190}, 0)).bytes());
  };
  EXPECT_TRUE(passes({0, 0}, 0.0F));
  world.control->emergency_stop(std::nullopt, "operator 1");
  EXPECT_FALSE(passes({1, 1}, 1.0F));
  EXPECT_FALSE(passes({0, 0}, 1.0F)) << "system 0 is everybody";
  EXPECT_TRUE(passes({0, 0}, 0.0F)) << "a disarming moves nothing";
  auto const goes_on = [&](mavlink::Frame frame) {
    return world.connection.pass_on(vehicle, mavlink::serialize(frame).bytes());
  };
  for (auto const* name : {"SET_ATTITUDE_TARGET", "SET_POSITION_TARGET_LOCAL_NED", "SET_ACTUATOR_CONTROL_TARGET"}) {
    auto const setpoint = mavlink::raw_message(name, {}, {254, 190}, {1, 1});
    ASSERT_TRUE(setpoint) << name;
    EXPECT_FALSE(goes_on(*setpoint)) << name;
  }
  mavlink::MissionItem item{.target = {1, 1}, .command = MavCmd::nav_waypoint};
  EXPECT_TRUE(goes_on(mavlink::encode(item, {254, 190}, 0))) << "a plan moves nothing";
  item.current = 2;
  EXPECT_FALSE(goes_on(mavlink::encode(item, {254, 190}, 0))) << "a guided way point does";
}

TEST(EmergencyStop, LetsOnlyThoseCommandsThroughThatAreKnownToMoveNothing) {
  ControlWorld world;
  world.add_flying();
  EXPECT_TRUE(world.stops_all());
  auto const passes = [&](int number, std::array<float, 7> params = {}) {
    auto const command = static_cast<MavCmd>(number);
    return world.connection.send({1, 1}, mavlink::CommandLong{.command = command, .params = params}).has_value();
  };
  for (int const number : {22, 24, 34, 92, 183, 187, 189, 218, 224, 246, 3000, 31010, 43001})
    EXPECT_FALSE(passes(number)) << number;
  for (int const number : {17, 20, 21, 185, 193, 203, 205, 400, 410, 511, 512, 1000, 2000})
    EXPECT_TRUE(passes(number)) << number;
  EXPECT_FALSE(passes(193, {1.0F})) << "go on";
  EXPECT_FALSE(passes(400, {1.0F})) << "arm";
  EXPECT_TRUE(passes(176, {1.0F, float{copter_mode::rtl}}));
  EXPECT_FALSE(passes(176, {1.0F, float{copter_mode::automatic}}));
  EXPECT_FALSE(passes(176, {1.0F, std::nanf("")}));
  EXPECT_FALSE(world.connection.send({1, 1}, mavlink::CommandInt{.command = static_cast<MavCmd>(34), .params = {}}));
}

TEST(EmergencyStop, EndsWhatIsUnderWay) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.ignored_commands.insert(MavCmd::component_arm_disarm);
  auto const arming = world.give({.action = Action::arm});
  world.run_for(1s);
  world.control->emergency_stop(std::nullopt, "operator 2");
  EXPECT_EQ(world.outcome(arming).state, CommandState::superseded);
  EXPECT_EQ(world.outcome(arming).reason, "emergency stop by operator 2");
  copter.heard.clear();
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.all_confirm());
  for (auto const& message : copter.heard) {
    auto const* command = std::get_if<mavlink::CommandLong>(&message);
    EXPECT_FALSE(command && mavlink::is_hazardous({command->command, command->params}));
  }
}

TEST(EmergencyStop, EndsARunWithAClearReason) {
  ControlWorld world;
  world.add_ready();
  auto const run = world.start_mission();
  ASSERT_TRUE(world.comes_to(*run, "item"));
  world.control->emergency_stop(std::nullopt, "operator 1");
  EXPECT_EQ(run->error(), "emergency stop by operator 1");
  EXPECT_TRUE(world.all_confirm());
}

TEST(EmergencyStop, StopsAgainWhatAnEarlierCommandMoves) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  copter.change_mode(copter_mode::automatic);  // what a link delivered late
  world.run_for(5s);
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_TRUE(world.stop_of("1").is_confirmed);
}

TEST(EmergencyStop, DoesNotFightAPilot) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  world.run_for(30s);
  copter.change_mode(copter_mode::stabilize);
  world.run_for(10s);
  EXPECT_EQ(copter.mode, copter_mode::stabilize);
  EXPECT_FALSE(world.stop_of("1").is_confirmed);
  EXPECT_EQ(world.stop_of("1").detail, "left its stop: STABILIZE, armed");
}

TEST(EmergencyStop, LetsAnOperatorBringAVehicleDown) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  auto const number = world.give({.action = Action::land});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  world.run_for(10s);
  EXPECT_EQ(copter.mode, copter_mode::land);
  EXPECT_EQ(world.stop_of("1").detail, "left to the operator's command");
}

TEST(EmergencyStop, GoesOnWhenAVehicleRefusesTheOperatorsCommand) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(1s);
  EXPECT_EQ(world.end_of(world.give({.action = Action::disarm})), CommandState::refused) << "it is in the air";
  EXPECT_EQ(world.stop_of("1").detail, "the operator's command came to nothing: stopped again");
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.all_confirm());
  EXPECT_EQ(copter.mode, copter_mode::brake);
}

TEST(EmergencyStop, GoesOnWhenTheOperatorsCommandGetsLost) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(1s);
  EXPECT_EQ(world.end_of(world.give({.action = Action::land})), CommandState::timed_out);
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.all_confirm());
}

TEST(EmergencyStop, GoesOnWhenTheOperatorsCommandEndsWithHisCommand) {
  ControlWorld world;
  auto& copter = world.add_flying();
  ASSERT_TRUE(world.control->request_control(VehicleId{"1"}, "operator 1"));
  ASSERT_TRUE(world.control->request_control(VehicleId{"1"}, "operator 2"));
  world.run_for(7s);
  copter.ignored_commands.insert(MavCmd::do_set_mode);
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(1s);
  auto const landing = world.give({.action = Action::land});
  EXPECT_EQ(world.end_of(landing), CommandState::superseded);
  EXPECT_EQ(world.outcome(landing).reason, "operator 2 took copter 1 over");
  copter.ignored_commands.clear();
  EXPECT_TRUE(world.all_confirm());
}

TEST(EmergencyStop, LeavesAPilotAloneWhenAnOperatorsCommandIsRefused) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  world.run_for(30s);
  copter.change_mode(copter_mode::stabilize);
  world.run_for(2s);
  EXPECT_EQ(world.end_of(world.give({.action = Action::disarm})), CommandState::refused);
  world.run_for(10s);
  EXPECT_EQ(copter.mode, copter_mode::stabilize);
}

TEST(EmergencyStop, IsReleasedByAnOperatorOnly) {
  ControlWorld world;
  auto& copter = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  world.run_for(3600s);
  EXPECT_TRUE(world.control->emergency().is_latched);
  world.control->release_emergency_stop("operator 2");
  EXPECT_FALSE(world.control->emergency().is_latched);
  world.run_for(10s);
  EXPECT_EQ(copter.mode, copter_mode::brake) << "a release moves nothing";
  EXPECT_EQ(world.end_of(world.give({.action = Action::set_mode, .mode = "GUIDED"})), CommandState::confirmed);
}

/// Loop time from the operator's press until the last of 50 copters in the air has confirmed its stop.
base::Duration time_to_stop_fifty(double loss) {
  ControlWorld world;
  for (std::uint8_t id = 1; id <= 50; ++id) {
    auto& copter = world.add({.address = {id, 1}}, {.loss = loss, .seed = id});
    copter.is_armed = copter.is_flying = true;
    copter.change_mode(copter_mode::automatic);
  }
  world.run_for(10s);
  auto const pressed = world.loop.now();
  world.control->emergency_stop(std::nullopt, "operator 1");
  EXPECT_TRUE(world.all_confirm(60s));
  EXPECT_EQ(world.control->emergency().vehicles.size(), 50u);
  return world.loop.now() - pressed;
}

TEST(EmergencyStop, TakesAMomentForFiftyVehicles) {
  auto const clean = time_to_stop_fifty(0.0);
  auto const lossy = time_to_stop_fifty(0.3);
  RecordProperty("clean_ms", static_cast<int>(clean / 1ms));
  RecordProperty("lossy_ms", static_cast<int>(lossy / 1ms));
  EXPECT_LT(clean, 2s);
  EXPECT_LT(lossy, 20s);
}

TEST(EmergencyStop, StopsBothVehiclesOfOneId) {
  ControlWorld world;
  auto& first = world.add_flying();
  auto& second = world.add({});
  second.is_armed = second.is_flying = true;
  second.change_mode(copter_mode::automatic);
  ASSERT_TRUE(world.run_until([&] { return world.connection.conflict(1).has_value(); }));
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(10s);
  EXPECT_EQ(first.mode, copter_mode::brake);
  EXPECT_EQ(second.mode, copter_mode::brake);
  EXPECT_FALSE(world.stop_of("1").is_confirmed) << "which of them shows it cannot be told";
}

TEST(EmergencyStop, StopsAnAutopilotWithoutKnownModesByWhatItAccepts) {
  ControlWorld world;
  auto& copter = world.add_flying({.autopilot = mavlink::MavAutopilot::generic});
  copter.modes_by_command[MavCmd::nav_land] = 77;
  EXPECT_TRUE(world.stops_all());
  EXPECT_EQ(copter.mode, 77u);
  EXPECT_EQ(copter.commands_heard(MavCmd::do_pause_continue), 1) << "it would rather stay";
  EXPECT_EQ(copter.commands_heard(MavCmd::nav_return_to_launch), 0);
  EXPECT_EQ(copter.commands_heard(MavCmd::do_set_mode), 0);
}

TEST(EmergencyStop, GoesOnAskingAnAutopilotThatTakesNoStop) {
  ControlWorld world;
  auto& copter = world.add_flying({.autopilot = mavlink::MavAutopilot::generic});
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(10s);
  EXPECT_GT(copter.commands_heard(MavCmd::nav_return_to_launch), 1);
  EXPECT_FALSE(world.stop_of("1").is_confirmed);
  EXPECT_TRUE(world.stop_of("1").detail.starts_with("no mode to stop in is known; vehicle 1 answered"))
      << world.stop_of("1").detail;
}

TEST(EmergencyStop, SetsNoModeOfTwoVehiclesWhoseModesAreUnknown) {
  ControlWorld world;
  auto& first = world.add_flying({.autopilot = mavlink::MavAutopilot::generic});
  auto& second = world.add({.autopilot = mavlink::MavAutopilot::generic});
  second.is_armed = second.is_flying = true;
  for (auto* const copter : {&first, &second}) copter->modes_by_command[MavCmd::nav_loiter_unlim] = 50;
  ASSERT_TRUE(world.run_until([&] { return world.connection.conflict(1).has_value(); }));
  world.control->emergency_stop(std::nullopt, "operator 1");
  world.run_for(10s);
  for (auto const* const copter : {&first, &second}) {
    EXPECT_EQ(copter->mode, 50u);
    EXPECT_EQ(copter->commands_heard(MavCmd::do_set_mode), 0);
  }
}

TEST(EmergencyStop, StopsASecondVehicleOfOneIdThatComesLater) {
  ControlWorld world;
  auto& first = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  world.run_for(30s);
  auto& second = world.add({});
  second.is_armed = second.is_flying = true;
  second.change_mode(copter_mode::automatic);
  EXPECT_TRUE(world.run_until([&] { return second.mode == copter_mode::brake; }, 5s));
  world.run_for(10s);
  EXPECT_EQ(first.mode, copter_mode::brake);
  EXPECT_EQ(second.mode, copter_mode::brake);
  EXPECT_FALSE(world.stop_of("1").is_confirmed);
  second.is_silent = true;
  EXPECT_TRUE(world.all_confirm(30s)) << "one is left, and it stands";
}

TEST(EmergencyStop, StopsASecondVehicleBesideOneThatAPilotHasTaken) {
  ControlWorld world;
  auto& first = world.add_flying();
  EXPECT_TRUE(world.stops_all());
  world.run_for(30s);
  first.change_mode(copter_mode::stabilize);
  world.run_for(30s);
  auto& second = world.add({});
  second.is_armed = second.is_flying = true;
  second.change_mode(copter_mode::automatic);
  EXPECT_TRUE(world.run_until([&] { return second.mode == copter_mode::brake; }, 10s));
}

}  // namespace
}  // namespace lapwing::fleet
