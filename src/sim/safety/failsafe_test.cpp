// What ArduPilot's vehicles did in the same situations: texts, modes and their order were taken from ArduCopter,
// ArduRover and ArduPlane 4.7 in software.

#include "sim/safety/failsafe.hpp"

#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr float no_pulses = 1;
constexpr float low_throttle = 2;

/// A copter on its mission, in the air.
void fly_mission(TestGround& ground) {
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(300, 0, 10)});
  ground.run_for(12s);
}

/// A plane that circles at height.
void circle(TestGround& ground) {
  ground.arm_in(plane_take_off);
  ground.run_for(30s);
  ASSERT_EQ(ground.set_mode(12), MavResult::accepted);
}

TEST(RadioFailsafe, ReturnsHomeASecondAfterTheLastPulse) {
  TestGround ground("copter");
  ground.hover(20);
  ground.request(MessageId::sys_status, 5);
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(800ms);
  EXPECT_EQ(ground.said("Radio Failsafe"), 0);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Radio Failsafe"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
  EXPECT_EQ(ground.last<SysStatus>()->sensors_health & sensor_flag::rc_receiver, 0u);
  ground.set("SIM_RC_FAIL", 0);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Radio Failsafe Cleared"), 1);
  EXPECT_EQ(ground.pilot().system_status(), MavState::active);
  EXPECT_EQ(ground.pilot().mode().name, "RTL") << "the pilot has to leave it";
}

TEST(RadioFailsafe, ActsAtOnceOnAThrottleBelowTheLeast) {
  TestGround ground("copter");
  ground.hover(10);
  ground.request(MessageId::rc_channels, 5);
  ground.set("SIM_RC_FAIL", low_throttle);
  ground.run_for(400ms);
  EXPECT_EQ(ground.said("Radio Failsafe"), 1);
  EXPECT_EQ(ground.last<RcChannels>()->pulses_us[2], 950);
}

TEST(RadioFailsafe, DoesWhatItsActionSays) {
  struct Case {
    float enable;
    std::string_view mode;
  };
  for (auto const& [enable, mode] :
       {Case{0, "GUIDED"}, {1, "RTL"}, {3, "LAND"}, {4, "SMART_RTL"}, {5, "SMART_RTL"}, {7, "BRAKE"}}) {
    TestGround ground("copter");
    ground.set("FS_THR_ENABLE", enable);
    ground.hover(10);
    ground.set("SIM_RC_FAIL", no_pulses);
    ground.run_for(1500ms);
    EXPECT_EQ(ground.pilot().mode().name, mode) << enable;
  }
}

TEST(RadioFailsafe, DisarmsOnTheGroundAndRefusesArming) {
  TestGround ground("copter");
  ground.arm_in(copter_guided);
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(1500ms);
  EXPECT_EQ(ground.said("Radio Failsafe - Disarming"), 1);
  EXPECT_FALSE(ground.pilot().armed());
  EXPECT_EQ(ground.arm(), MavResult::failed);
  ground.run_for(100ms);
  EXPECT_EQ(ground.said("Arm: Radio failsafe on"), 1);
  EXPECT_EQ(ground.said("PreArm: Radio failsafe on"), 1);
}

TEST(RadioFailsafe, LetsAMissionGoOnIfToldSo) {
  TestGround ground("copter");
  ground.set("FS_OPTIONS", 1);
  fly_mission(ground);
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(1500ms);
  EXPECT_EQ(ground.said("Radio Failsafe - Continuing Auto"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
}

TEST(RadioFailsafe, OfAPlaneWaitsBeforeItReturns) {
  TestGround ground("plane");
  circle(ground);
  EXPECT_EQ(ground.said("SmartRTL"), 0) << "planes have no such mode";
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(2s);
  EXPECT_EQ(ground.said("Throttle failsafe on"), 1);
  EXPECT_EQ(ground.said("RC Short Failsafe On"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "LOITER");
  ground.run_for(5s);
  EXPECT_EQ(ground.said("RC Long Failsafe On: RTL"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  ground.set("SIM_RC_FAIL", 0);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Throttle failsafe off"), 1);
  EXPECT_EQ(ground.said("RC Long Failsafe Cleared"), 1);
}

TEST(RadioFailsafe, OfAPlaneMakesAPilotedOneCircleMeanwhile) {
  TestGround ground("plane");
  circle(ground);
  ground.set_mode(5);
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(2s);
  EXPECT_EQ(ground.said("RC Short Failsafe: switched to CIRCLE"), 1);
  ground.set("SIM_RC_FAIL", 0);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Short Failsafe Cleared"), 1);
}

TEST(RadioFailsafe, OfARoverTakesTwoSecondsInAll) {
  TestGround ground("rover");
  ground.set("FS_ACTION", 1);
  ground.arm_in(rover_guided);
  ground.set("SIM_RC_FAIL", no_pulses);
  ground.run_for(1800ms);
  EXPECT_EQ(ground.said("Radio Failsafe"), 0);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Radio Failsafe"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
}

TEST(GroundStationFailsafe, DisarmsACopterThatStands) {
  TestGround ground("copter", {}, false);
  ground.set("FS_GCS_ENABLE", 1);
  ground.set("DISARM_DELAY", 0);
  ground.arm_in(copter_guided);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(6s);
  EXPECT_EQ(ground.said("GCS Failsafe - Disarming"), 1);
  EXPECT_FALSE(ground.pilot().armed());
}

TEST(GroundStationFailsafe, LetsAMissionGoOnIfToldSo) {
  for (auto const& [options, mode] : {std::pair{0.0F, "RTL"}, {2.0F, "AUTO"}}) {
    TestGround ground("copter", {}, false);
    ground.set("FS_GCS_ENABLE", 1);
    ground.set("FS_OPTIONS", options);
    fly_mission(ground);
    ground.send(Connection::ground_station_heartbeat());
    ground.run_for(6s);
    EXPECT_EQ(ground.pilot().mode().name, mode);
    EXPECT_EQ(ground.said("GCS Failsafe - Continuing Auto Mode"), options == 2.0F ? 1 : 0);
  }
}

TEST(GroundStationFailsafe, OfAPlaneNamesTheModeItIsInThen) {
  TestGround ground("plane", {}, false);
  ground.set("FS_GCS_ENABL", 1);
  circle(ground);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(6s);
  EXPECT_EQ(ground.said("GCS Failsafe On: RTL"), 1);
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("GCS Failsafe Off"), 1);
  EXPECT_EQ(ground.pilot().system_status(), MavState::active);
}

/// What the vehicle does when its battery becomes low, and how often it tells of a failsafe.
void expect_when_low(TestGround& ground, int told, std::string_view mode, MavState status) {
  ground.set("BATT_LOW_MAH", 9000);
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("Battery 1 is low"), 1);
  EXPECT_EQ(ground.said("Battery Failsafe"), told);
  EXPECT_EQ(ground.pilot().mode().name, mode);
  EXPECT_EQ(ground.pilot().system_status(), status);
}

TEST(BatteryFailsafe, IsToldByACopterEvenWhenNothingIsDone) {
  TestGround ground("copter");
  ground.hover(10);
  expect_when_low(ground, 1, "GUIDED", MavState::critical);
}

TEST(BatteryFailsafe, OfARoverIsNeitherToldNorCritical) {
  TestGround ground("rover");
  ground.set("BATT_FS_LOW_ACT", 1);
  ground.arm_in(rover_guided);
  expect_when_low(ground, 0, "RTL", MavState::active);
}

TEST(BatteryFailsafe, WaitsUntilTheVehicleIsArmed) {
  TestGround ground("copter");
  ground.set("BATT_LOW_MAH", 9000);
  ground.boot();
  ground.run_for(5s);
  EXPECT_EQ(ground.said("Battery 1 is low"), 0);
}

}  // namespace
}  // namespace lapwing::sim
