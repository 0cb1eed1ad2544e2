#include "fleet/network/other_stations.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::Address;
using mavlink::MavCmd;
using vehicle::Action;

constexpr Address other{252, 190};

TEST(OtherStations, NameWhoCommandedAVehicle) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.send(mavlink::CommandAck{.target = other, .command = MavCmd::component_arm_disarm});
  world.run_for(100ms);
  EXPECT_EQ(world.state().foreign_change.value, "station 252/190 commanded COMPONENT_ARM_DISARM: accepted");
}

TEST(OtherStations, AreNoticedThoughTheyHaveOurId) {
  ControlWorld world;
  auto& copter = world.add_ready();
  Address const same{255, 190};
  copter.send_as(same, mavlink::Connection::ground_station_heartbeat());
  copter.send_as(same, mavlink::CommandLong{.target = {1, 1}, .command = MavCmd::mission_start});
  world.run_for(100ms);
  EXPECT_EQ(world.state().foreign_change.value, "station 255/190 commanded MISSION_START");
  auto const warns = [](std::string const& line) { return line.contains("this station's id, too"); };
  EXPECT_EQ(std::ranges::count_if(world.lines, warns), 1);
}

TEST(OtherStations, AreNotBlamedForAskingForMessages) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.send(mavlink::CommandAck{.target = other, .command = MavCmd::set_message_interval});
  copter.send(mavlink::CommandAck{.target = {255, 190}, .command = MavCmd::component_arm_disarm});
  world.run_for(100ms);
  EXPECT_FALSE(world.state().foreign_change.known());
}

TEST(OtherStations, ShowInCommandsThatAreForwarded) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.send_as(other, mavlink::CommandLong{.target = {1, 1}, .command = MavCmd::mission_start});
  world.run_for(100ms);
  EXPECT_EQ(world.state().foreign_change.value, "station 252/190 commanded MISSION_START");
}

TEST(OtherStations, AreToldOfOnceThoughTheyCommandAllTheTime) {
  ControlWorld world;
  auto& copter = world.add_ready();
  world.lines.clear();
  for (int i = 0; i < 50; ++i) {
    copter.send_as(other, mavlink::CommandLong{.target = {1, 1}, .command = MavCmd::do_change_speed});
    copter.send(mavlink::CommandAck{.target = other, .command = MavCmd::do_change_speed});
    world.run_for(100ms);
  }
  auto const tells = [](std::string const& line) { return line.contains("commanded DO_CHANGE_SPEED"); };
  EXPECT_EQ(std::ranges::count_if(world.lines, tells), 2) << "the command, and what came of it";
  world.run_for(10s);
  copter.send(mavlink::CommandAck{.target = other, .command = MavCmd::do_change_speed});
  world.run_for(100ms);
  EXPECT_EQ(std::ranges::count_if(world.lines, tells), 3);
}

TEST(OtherStations, ShowInPlansThatChange) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.send(mavlink::MissionAck{.target = other, .type = mavlink::MissionType::fence});
  world.run_for(100ms);
  EXPECT_EQ(world.state().foreign_change.value, "station 252/190 changed or read its fence");
}

TEST(OtherStations, AreSuspectedWhenAModeChangesByItself) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.send_as(other, mavlink::Heartbeat{.type = mavlink::MavType::gcs, .autopilot = mavlink::MavAutopilot::invalid});
  copter.change_mode(copter_mode::rtl);
  world.run_for(2s);
  EXPECT_EQ(world.state().foreign_change.value, "STABILIZE to RTL, not asked for here; station 252/190 is on the link");
  EXPECT_TRUE(world.has_logged("another ground station is on the link: station 252/190"));
}

TEST(OtherStations, HaveNothingToDoWithOurOwnModes) {
  ControlWorld world;
  world.add_ready();
  EXPECT_EQ(world.end_of(world.give({.action = Action::set_mode, .mode = "GUIDED"})), vehicle::CommandState::confirmed);
  world.run_for(2s);
  EXPECT_FALSE(world.state().foreign_change.known());
}

}  // namespace
}  // namespace lapwing::fleet
