#include "fleet/control/fleet_control.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

TEST(FleetControl, ShowsACommandFromWaitingToConfirmed) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::arm});
  EXPECT_EQ(world.outcome(number).state, CommandState::waiting);
  EXPECT_TRUE(world.comes_to(number, CommandState::accepted));
  EXPECT_TRUE(world.comes_to(number, CommandState::confirmed));
  EXPECT_TRUE(copter.is_armed);
  EXPECT_EQ(world.control->commands().back().by, "operator 1");
}

TEST(FleetControl, GivesEachVehicleItsOwnOutcome) {
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

TEST(FleetControl, IsFastForManyVehicles) {
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

TEST(FleetControl, TakesOff) {
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

TEST(FleetControl, KeepsTheHeightWhenItGoesToAPlaceUnlessToldOtherwise) {
  ControlWorld world;
  auto& copter = world.add_flying();
  copter.height_m = 100.0;
  world.run_for(2s);
  (void)world.give({.action = Action::go_to, .place = TestAutopilot::home});
  world.run_for(2s);
  ASSERT_TRUE(copter.goal);
  EXPECT_NEAR(copter.goal->alt_m, 100.0, 0.1);
}

TEST(FleetControl, GivesPx4HeightsAboveTheSea) {
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

TEST(FleetControl, SendsAVehicleToAPlaceWithoutLosingPrecision) {
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

TEST(FleetControl, RefusesWhatAVehicleCannotDo) {
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
  EXPECT_EQ(world.end_of(on_ground), CommandState::refused);
  EXPECT_EQ(world.outcome(on_ground).reason, "copter 1 is on the ground: take off first");
  auto const resumed = world.give({.action = Action::resume_mission});
  EXPECT_EQ(world.outcome(resumed).reason, "copter 1 is not armed: start the mission instead");
}

TEST(FleetControl, RefusesCommandsWithoutWhatTheyNeed) {
  ControlWorld world;
  world.add_ready();
  std::vector<VehicleId> const one{{"1"}};
  EXPECT_FALSE(world.control->command({.action = Action::go_to}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::set_mode}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::take_off, .height_m = -5.0}, one, "operator 1", false));
  EXPECT_FALSE(world.control->command({.action = Action::hold}, {}, "operator 1", false));
  EXPECT_TRUE(world.control->commands().empty());
}

TEST(FleetControl, SetsModesByName) {
  ControlWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = Action::set_mode, .mode = "guided"});
  EXPECT_EQ(world.end_of(number), CommandState::confirmed);
  EXPECT_EQ(copter.mode, copter_mode::guided);
  EXPECT_EQ(world.outcome(number).reason, "GUIDED");
}

TEST(FleetControl, StartsPausesAndResumesAMission) {
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

TEST(FleetControl, LetsALaterCommandReplaceAnEarlierOne) {
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

}  // namespace
}  // namespace lapwing::fleet
