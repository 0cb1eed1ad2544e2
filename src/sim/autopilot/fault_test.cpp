#include <gtest/gtest.h>

#include <set>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

std::set<link::Peer> peers(TestGround const& ground, std::size_t from) {
  std::set<link::Peer> found;
  for (auto i = from; i < ground.heard.size(); ++i) found.insert(ground.heard[i].peer);
  return found;
}

TEST(Reboot, ComesBackFromANewPortWithoutRatesButWithItsMission) {
  TestGround ground("copter");
  ground.boot();
  auto const make = ground.maker();
  ground.upload({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(20, 0, 10)});
  ground.request(MessageId::attitude, 10);
  ground.set_mode(copter_guided);
  auto const before = peers(ground, 0);
  EXPECT_EQ(ground.command(MavCmd::preflight_reboot_shutdown, {1}), MavResult::accepted);
  ground.run_for(100ms);
  auto const from = ground.heard.size();
  ground.run_for(5s);
  auto const after = peers(ground, from);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_FALSE(before.contains(*after.begin()));
  EXPECT_TRUE(ground.all<Attitude>(1, from).empty());
  EXPECT_EQ(ground.pilot().mode().name, "STABILIZE");
  EXPECT_EQ(ground.vehicle().mission().size(), 3u);
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::not_started);
}

TEST(Reboot, IsRefusedWhileArmedButAFaultRebootsAnyway) {
  TestGround ground("copter");
  ground.hover(10);
  EXPECT_EQ(ground.command(MavCmd::preflight_reboot_shutdown, {1}), MavResult::failed);
  ground.vehicle().reboot();
  ground.run_for(3s);
  EXPECT_FALSE(ground.pilot().armed());
  EXPECT_TRUE(ground.pilot().body().on_ground);
}

TEST(Silence, StopsEverythingOnTheLinkWhileTheVehicleFliesOn) {
  TestGround ground("copter");
  ground.hover(10);
  ground.vehicle().fall_silent(10s);
  ground.run_for(100ms);
  auto const from = ground.heard.size();
  ground.run_for(9s);
  EXPECT_EQ(ground.heard.size(), from);
  EXPECT_EQ(ground.command(MavCmd::request_message, {148}), std::nullopt);
  EXPECT_NEAR(ground.pilot().body().height_m(), 10.0, 0.3);
  ground.run_for(2s);
  EXPECT_GT(ground.heard.size(), from);
}

TEST(Silence, CanLastForGood) {
  TestGround ground("copter:2");
  ground.boot();
  ground.vehicle(1).fall_silent_for_good();
  ground.run_for(100ms);
  auto const from = ground.heard.size();
  ground.run_for(1min);
  EXPECT_TRUE(ground.all<Heartbeat>(1, from).empty());
  EXPECT_EQ(ground.all<Heartbeat>(2, from).size(), 60u);
}

TEST(BatteryFailsafe, ReturnsHomeAndShowsACriticalState) {
  TestGround ground("copter");
  ground.set("BATT_LOW_MAH", 1000.0F);
  ground.set("BATT_FS_LOW_ACT", 2.0F);
  ground.hover(20);
  ground.vehicle().set_battery(0.19);
  ground.run_for(1500ms);
  EXPECT_EQ(ground.said("Battery 1 is low"), 1);
  EXPECT_EQ(ground.said("Battery Failsafe"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::critical);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 120s));
}

TEST(BatteryFailsafe, TakesTenSecondsOfLowVoltageAndDoesNothingByDefault) {
  TestGround ground("copter");
  ground.hover(10);
  ground.vehicle().set_battery(0.04);
  ground.run_for(9s);
  EXPECT_EQ(ground.said("Battery 1 is low"), 0);
  ground.run_for(2s);
  EXPECT_EQ(ground.said("Battery 1 is low"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
}

TEST(Battery, DrainsInFlightAndIsReported) {
  TestGround ground("copter@90%");
  ground.hover(10);
  ground.request(MessageId::sys_status, 2);
  ground.request(MessageId::battery_status, 2);
  ground.run_for(60s);
  auto const status = ground.last<SysStatus>();
  ASSERT_TRUE(status && status->battery_remaining);
  EXPECT_LT(*status->battery_remaining, 0.86);
  EXPECT_GT(*status->battery_remaining, 0.70);
  EXPECT_NEAR(*status->battery_voltage_v, 11.9, 0.5);
  EXPECT_GT(*status->battery_current_a, 10.0);
  EXPECT_NEAR(*ground.last<BatteryStatus>()->remaining, *status->battery_remaining, 0.02);
}

TEST(Battery, EmptyMeansFalling) {
  TestGround ground("copter");
  ground.hover(15);
  ground.vehicle().set_battery(0.0);
  ground.run_for(4s);
  EXPECT_TRUE(ground.pilot().body().on_ground);
  EXPECT_EQ(ground.said("SIM Hit ground at 1"), 1);
}

TEST(Battery, IsWhatTheCrewSaysAfterAChangeOfThePack) {
  constexpr auto battery_reset = static_cast<MavCmd>(42651);
  TestGround ground("copter@30%");
  ground.boot();
  EXPECT_EQ(ground.command(battery_reset, {2, 100}), MavResult::failed);  // there is no second battery
  EXPECT_EQ(ground.command(battery_reset, {1, 101}), MavResult::failed);
  EXPECT_LT(ground.pilot().battery().remaining(), 0.31);
  EXPECT_EQ(ground.command(battery_reset, {1, 100}), MavResult::accepted);
  EXPECT_GT(ground.pilot().battery().remaining(), 0.99);
}

TEST(GroundStationFailsafe, IsOffByDefault) {
  TestGround ground("copter", {}, false);
  ground.boot();
  ground.send(Connection::ground_station_heartbeat());
  ground.hover(10);
  ground.run_for(20s);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
}

TEST(GroundStationFailsafe, ReturnsHomeAfterFiveSecondsAndStaysInRtl) {
  TestGround ground("copter", {}, false);
  ground.set("FS_GCS_ENABLE", 1.0F);
  ground.hover(10);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(4500ms);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
  ground.run_for(2s);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
  EXPECT_EQ(ground.said("GCS Failsafe"), 1);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(500ms);
  EXPECT_EQ(ground.said("GCS Failsafe Cleared"), 1);
  EXPECT_EQ(ground.pilot().system_status(), MavState::active);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
}

TEST(GpsLoss, LandsEightSecondsLater) {
  TestGround ground("copter");
  ground.hover(10);
  ground.request(MessageId::gps_raw_int, 5);
  ground.request(MessageId::ekf_status_report, 5);
  ground.vehicle().lose_gps();
  ground.run_for(1s);
  EXPECT_EQ(ground.last<GpsRaw>()->fix, GpsFix::no_fix);
  EXPECT_EQ(ground.last<GpsRaw>()->satellites, 3);
  ground.run_for(8s);
  EXPECT_EQ(ground.said("EKF variance"), 1);
  EXPECT_EQ(ground.said("EKF Failsafe: changed to LAND Mode"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "LAND");
  EXPECT_EQ(ground.last<EkfStatusReport>()->flags, 0x25);
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::critical);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 60s));
}

TEST(GpsLoss, IsAParameterAsInArduPilotsSimulator) {
  TestGround ground("copter");
  ground.hover(10);
  ground.request(MessageId::gps_raw_int, 5);
  ground.send(ParamSet{.name = "SIM_GPS_DISABLE", .value = 1.0F});
  ground.run_for(1s);
  EXPECT_EQ(ground.last<GpsRaw>()->fix, GpsFix::no_fix);
  ground.send(ParamSet{.name = "SIM_GPS_DISABLE", .value = 0.0F});
  ground.run_for(5s);
  EXPECT_EQ(ground.last<GpsRaw>()->fix, GpsFix::rtk_fixed);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED") << "it came back in time";
  ground.send(ParamSet{.name = "SIM_GPS_DISABLE", .value = 1.0F});
  ground.run_for(9s);
  EXPECT_EQ(ground.pilot().mode().name, "LAND") << "a second loss is a loss";
}

TEST(EstimatorFailsafe, DoesWhatItsActionSays) {
  struct Case {
    float action;
    std::string_view mode;
  };
  for (auto const& [action, mode] : {Case{0, "GUIDED"}, {1, "LAND"}, {2, "ALT_HOLD"}, {3, "LAND"}}) {
    TestGround ground("copter");
    ground.set("FS_EKF_ACTION", action);
    ground.hover(10);
    ground.vehicle().lose_gps();
    ground.run_for(9s);
    EXPECT_EQ(ground.pilot().mode().name, mode) << action;
    EXPECT_EQ(ground.said("EKF variance"), 1);
    EXPECT_EQ(ground.said("EKF Failsafe"), action == 0 ? 0 : 1);
    EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
  }
}

TEST(EstimatorFailsafe, StopsARover) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  ground.vehicle().lose_gps();
  ground.run_for(9s);
  EXPECT_EQ(ground.pilot().mode().name, "HOLD");
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
}

TEST(GroundStationFailsafe, DoesWhatItsActionSays) {
  struct Case {
    float enable;
    std::string_view mode;
  };
  for (auto const& [enable, mode] : {Case{1, "RTL"}, {5, "LAND"}, {7, "BRAKE"}}) {
    TestGround ground("copter", {}, false);
    ground.set("FS_GCS_ENABLE", enable);
    ground.hover(10);
    ground.send(Connection::ground_station_heartbeat());
    ground.run_for(6s);
    EXPECT_EQ(ground.pilot().mode().name, mode);
  }
}

TEST(BatteryFailsafe, BecomesCriticalAfterLow) {
  TestGround ground("copter");
  for (auto const& [name, value] : {std::pair{"BATT_LOW_MAH", 1000.0F},
                                    {"BATT_FS_LOW_ACT", 2.0F},
                                    {"BATT_CRT_MAH", 500.0F},
                                    {"BATT_FS_CRT_ACT", 1.0F}})
    ground.set(name, value);
  ground.hover(20);
  ground.vehicle().set_battery(0.19);
  ground.run_for(1s);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  ground.vehicle().set_battery(0.09);
  ground.run_for(1s);
  EXPECT_EQ(ground.said("Battery 1 is critical"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "LAND");
}

TEST(Pilot, ChangesTheModeOfAFlyingVehicle) {
  TestGround ground("copter");
  ground.hover(10);
  EXPECT_TRUE(ground.vehicle().pilot_sets_mode(9));
  ground.run_for(100ms);
  EXPECT_EQ(ground.last<Heartbeat>()->custom_mode, 9u);
  EXPECT_EQ(ground.last<Heartbeat>()->base_mode, 0xD1);
  EXPECT_FALSE(ground.vehicle().pilot_sets_mode(13));
}

}  // namespace
}  // namespace lapwing::sim
