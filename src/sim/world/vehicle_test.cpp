#include "sim/world/vehicle.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

WorldOptions realistic() {
  WorldOptions options;
  options.boot = BootStyle::realistic;
  return options;
}

// ---- start-up and telemetry

TEST(VehicleStart, SendsOnlyHeartbeatsTimesyncAndHomeUnasked) {
  TestGround ground("copter", realistic(), false);
  ground.run_for(30s);
  EXPECT_NEAR(static_cast<double>(ground.all<Heartbeat>().size()), 30.0, 1.0);
  EXPECT_EQ(ground.all<Timesync>().size(), 3u);
  EXPECT_EQ(ground.all<HomePosition>().size(), 1u);
  EXPECT_EQ(ground.all<GpsGlobalOrigin>().size(), 1u);
  auto const others = ground.heard.size() - ground.all<Heartbeat>().size() - 3 - 2;
  EXPECT_EQ(others, 0u);
}

TEST(VehicleStart, HeartbeatSaysWhatItIsAndComesHalfASecondAfterPowerOn) {
  TestGround ground("copter,rover,plane", realistic());
  ASSERT_TRUE(ground.run_until([&] { return ground.last<Heartbeat>(3).has_value(); }, 5s));
  EXPECT_NEAR(base::to_seconds(ground.heard.front().at.time_since_epoch()), 0.5, 0.06);
  EXPECT_EQ(ground.last<Heartbeat>(1)->type, MavType::quadrotor);
  EXPECT_EQ(ground.last<Heartbeat>(1)->base_mode, 0x51);
  EXPECT_EQ(ground.last<Heartbeat>(1)->system_status, MavState::active);
  EXPECT_EQ(ground.last<Heartbeat>(2)->type, MavType::ground_rover);
  EXPECT_EQ(ground.last<Heartbeat>(2)->custom_mode, 16u);
  EXPECT_EQ(ground.last<Heartbeat>(3)->type, MavType::fixed_wing);
  ground.run_for(5s);
  EXPECT_EQ(ground.last<Heartbeat>(1)->system_status, MavState::standby);
  EXPECT_EQ(ground.last<Heartbeat>(2)->custom_mode, 0u);
  EXPECT_EQ(ground.last<Heartbeat>(2)->base_mode, 0x41);
  EXPECT_EQ(ground.last<Heartbeat>(2)->system_status, MavState::active);
}

TEST(VehicleStart, SendsNoiseThatIsNoMavlinkBetweenItsFrames) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_GT(ground.gcs.parser_counters(0).junk_bytes, 5u);
  EXPECT_TRUE(ground.last<Heartbeat>().has_value());
}

TEST(VehicleStart, GoesThroughTheTimelineInOrder) {
  TestGround ground("copter", realistic());
  ground.run_for(1s);
  ground.request(MessageId::gps_raw_int, 10);
  ground.request(MessageId::global_position_int, 10);
  ground.request(MessageId::local_position_ned, 10);
  ground.request(MessageId::sys_status, 10);
  ground.request(MessageId::ekf_status_report, 10);
  ground.run_for(8s);
  EXPECT_EQ(ground.last<GpsRaw>()->fix, GpsFix::no_gps);
  EXPECT_EQ(ground.last<GlobalPosition>()->position->lat_rad, 0.0);
  ground.run_for(2s);
  EXPECT_EQ(ground.last<GpsRaw>()->fix, GpsFix::rtk_fixed);
  EXPECT_NEAR(ground.last<GlobalPosition>()->position->lat_deg(), 41.1780, 1e-5);
  EXPECT_NEAR(*ground.last<GlobalPosition>()->heading_rad, 106.0 * std::numbers::pi / 180.0, 0.02);
  EXPECT_FALSE(ground.last<HomePosition>().has_value());
  ground.run_for(10s);
  EXPECT_TRUE(ground.last<HomePosition>().has_value());
  EXPECT_EQ(ground.last<SysStatus>()->sensors_health & sensor_flag::prearm_check, 0u);
  ground.run_for(4s);
  EXPECT_NE(ground.last<SysStatus>()->sensors_health & sensor_flag::prearm_check, 0u);
  EXPECT_EQ(ground.last<EkfStatusReport>()->flags, 0xA7);
  EXPECT_FALSE(ground.last<LocalPosition>().has_value());
  ground.run_for(18s);
  EXPECT_EQ(ground.last<EkfStatusReport>()->flags, 0x33F);
  EXPECT_TRUE(ground.last<LocalPosition>().has_value());
  EXPECT_NEAR(*ground.last<GlobalPosition>()->heading_rad, 0.0, 0.02);
  EXPECT_EQ(ground.said("EKF3 IMU0 is using GPS"), 1);
}

TEST(VehicleTexts, AreLostUntilAGroundStationSpoke) {
  TestGround ground("copter", {}, false);
  ground.run_for(2s);
  EXPECT_EQ(ground.all<StatusText>().size(), 0u);
  ground.send(Connection::ground_station_heartbeat());
  ground.run_for(2s);
  EXPECT_EQ(ground.said("EKF3 IMU0 is using GPS"), 1);
  EXPECT_EQ(ground.said("ArduPilot Ready"), 0);
}

TEST(VehicleTelemetry, KeepsTheRateThatIsAsked) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.request(MessageId::attitude, 10), MavResult::accepted);
  EXPECT_EQ(ground.request(MessageId::vfr_hud, 100), MavResult::accepted);
  auto const from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<Attitude>(1, from).size()), 100.0, 1.0);
  EXPECT_NEAR(static_cast<double>(ground.all<VfrHud>(1, from).size()), 1000.0, 3.0);
}

TEST(VehicleTelemetry, ClampsStopsAndRestoresIntervals) {
  TestGround ground("copter");
  ground.boot();
  auto const interval = [&](MessageId id) {
    EXPECT_EQ(ground.command(MavCmd::get_message_interval, {static_cast<float>(id)}), MavResult::accepted);
    return ground.last<MessageInterval>()->interval;
  };
  EXPECT_EQ(interval(MessageId::attitude), std::nullopt);
  ground.command(MavCmd::set_message_interval, {30, 1000});
  EXPECT_EQ(interval(MessageId::attitude), std::chrono::microseconds(3000));
  ground.command(MavCmd::set_message_interval, {30, -1});
  EXPECT_EQ(interval(MessageId::attitude), std::nullopt);
  ground.command(MavCmd::set_message_interval, {0, 200000});
  auto from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<Heartbeat>(1, from).size()), 50.0, 1.0);
  ground.command(MavCmd::set_message_interval, {0, 0});
  from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<Heartbeat>(1, from).size()), 10.0, 1.0);
}

TEST(VehicleTelemetry, DeniesAnUnknownMessageWithAText) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::set_message_interval, {9999, 100000}), MavResult::denied);
  EXPECT_EQ(ground.said("No ap_message for mavlink id (9999)"), 1);
}

TEST(VehicleTelemetry, StreamsStartWithoutAcknowledgement) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(RequestDataStream{.target = {}, .stream = 0, .rate_hz = 4, .start = true});
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<GlobalPosition>(1, from).size()), 40.0, 1.0);
  EXPECT_NEAR(static_cast<double>(ground.all<EkfStatusReport>(1, from).size()), 40.0, 1.0);
  EXPECT_TRUE(ground.all<CommandAck>(1, from).empty());
  ground.send(RequestDataStream{.target = {}, .stream = 0, .rate_hz = 0, .start = false});
  ground.run_for(1s);
  auto const stopped = ground.heard.size();
  ground.run_for(5s);
  EXPECT_TRUE(ground.all<GlobalPosition>(1, stopped).empty());
}

TEST(VehicleTelemetry, ItsParametersStartStreams) {
  WorldOptions options;
  options.parameters = {{"SR0_POSITION", 10}};
  TestGround ground("copter", options);
  ground.boot();
  auto from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<GlobalPosition>(1, from).size()), 100.0, 1.0);
  EXPECT_TRUE(ground.all<SysStatus>(1, from).empty());

  ParamSet set;
  set.name = "SR0_EXT_STAT";
  set.value = 2;
  ground.send(set);
  ground.run_for(1s);
  from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<SysStatus>(1, from).size()), 20.0, 1.0);
}

TEST(VehicleRequests, AnswersWhatItHasAndFailsTheRest) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::request_message, {148}), MavResult::accepted);
  EXPECT_EQ(ground.last<AutopilotVersion>()->capabilities, 0xFBEFu);
  EXPECT_EQ(ground.command(MavCmd::request_message, {300}), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::request_protocol_version, {1}), MavResult::unsupported);
  EXPECT_EQ(ground.command(MavCmd::request_autopilot_capabilities, {1}), MavResult::accepted);
  EXPECT_EQ(ground.command(static_cast<MavCmd>(31999)), MavResult::unsupported);
  auto const homes = ground.all<HomePosition>().size();
  EXPECT_EQ(ground.command(MavCmd::get_home_position), MavResult::accepted);
  EXPECT_EQ(ground.all<HomePosition>().size(), homes + 1);
}

TEST(VehicleRequests, IgnoresWhatIsMeantForAnotherSystem) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(CommandLong{.target = {}, .command = MavCmd::request_message, .params = {148}}, 9);
  ground.run_for(1s);
  EXPECT_TRUE(ground.all<CommandAck>(1, from).empty());
}

TEST(VehicleRequests, AnswersTimesync) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(Timesync{.tc1 = {}, .ts1 = 12345ns});
  ground.run_for(100ms);
  ASSERT_EQ(ground.all<Timesync>(1, from).size(), 1u);
  EXPECT_EQ(ground.all<Timesync>(1, from)[0].ts1, 12345ns);
  EXPECT_GT(ground.all<Timesync>(1, from)[0].tc1, 0ns);
}

// ---- arming and modes

TEST(Arming, IsRefusedBeforeTheChecksPassed) {
  TestGround ground("copter", realistic());
  ground.run_for(10s);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: AHRS: waiting for home"), 1);
}

TEST(Arming, NeedsAPositionInGuidedButNotInStabilize) {
  TestGround ground("copter", realistic());
  ground.run_for(25s);
  EXPECT_EQ(ground.set_mode(copter_guided), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: Need Position Estimate"), 1);
  EXPECT_EQ(ground.all<StatusText>().back().severity, MavSeverity::critical);
  EXPECT_EQ(ground.set_mode(0), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::accepted);
}

TEST(Arming, IsRefusedInModesThatAreNotArmable) {
  TestGround ground("copter");
  ground.boot();
  auto const make = ground.maker();
  ground.upload({make.waypoint(0, 0, 0), make.take_off(10)});
  EXPECT_EQ(ground.set_mode(3), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: AUTO mode not armable"), 1);
  ground.send(MissionClearAll{});
  ground.run_for(100ms);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: Mode requires mission"), 1);
  ground.set_mode(6);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: RTL mode not armable"), 1);
  ground.set_mode(9);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: LAND mode not armable"), 1);
}

TEST(Arming, CanBeForcedAndRepeated) {
  TestGround ground("copter");
  ground.boot();
  ground.vehicle().refuse_arming("Compass not calibrated");
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {1, 2989}), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {0, 0}), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {0, 0}), MavResult::accepted);
}

TEST(Arming, AnInjectedFaultIsRepeatedEveryThirtySeconds) {
  TestGround ground("copter");
  ground.vehicle().refuse_arming("Compass not calibrated");
  ground.run_for(65s);
  EXPECT_EQ(ground.said("PreArm: Compass not calibrated"), 3);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: Compass not calibrated"), 1);
  ground.vehicle().refuse_arming("");
  ground.set_mode(copter_guided);
  EXPECT_EQ(ground.arm(), MavResult::accepted);
}

TEST(Arming, EndsAfterTenSecondsOnTheGround) {
  TestGround ground("copter");
  ground.arm_in(copter_guided);
  ground.run_for(9500ms);
  EXPECT_TRUE(ground.pilot().armed());
  ground.run_for(1s);
  EXPECT_FALSE(ground.pilot().armed());
}

TEST(Arming, ShowsAtTheNextRegularHeartbeatAndAnnouncesHome) {
  TestGround ground("copter");
  ground.boot();
  ground.set_mode(copter_guided);
  auto const homes = ground.all<HomePosition>().size();
  auto const from = ground.heard.size();
  ground.arm();
  ground.run_for(1100ms);
  EXPECT_EQ(ground.all<HomePosition>().size(), homes + 1);
  ASSERT_GE(ground.all<Heartbeat>(1, from).size(), 1u);
  EXPECT_EQ(ground.last<Heartbeat>()->base_mode, 0xD9);
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::standby);
}

TEST(TakeOff, IsRefusedUnlessGuidedArmedAndLanded) {
  TestGround ground("copter,rover");
  ground.boot();
  std::array<float, 7> const height{0, 0, 0, 0, 0, 0, 10};
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, height), MavResult::failed);
  ground.arm();
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, height), MavResult::failed);
  ground.set_mode(copter_guided);
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, height), MavResult::accepted);
  ground.run_for(8s);
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, height), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, height, 2), MavResult::failed);
}

TEST(Modes, UnknownAndRefusedOnesFailWithAText) {
  TestGround ground("copter", realistic());
  ground.run_for(5s);
  EXPECT_EQ(ground.set_mode(13), MavResult::failed);
  EXPECT_EQ(ground.said("No such mode 13"), 1);
  EXPECT_EQ(ground.command(MavCmd::do_set_mode, {0, 4}), MavResult::denied);
}

TEST(Modes, AChangeIsShownByAHeartbeatAtOnce) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(SetMode{.target_system = 1, .base_mode = 1, .custom_mode = 4});
  ground.run_for(20ms);
  ASSERT_GE(ground.all<Heartbeat>(1, from).size(), 1u);
  EXPECT_EQ(ground.last<Heartbeat>()->custom_mode, 4u);
  EXPECT_EQ(ground.last<Heartbeat>()->base_mode, 0x59);
  EXPECT_TRUE(ground.all<CommandAck>(1, from).empty());
}

TEST(Modes, AutoOnTheGroundNeedsATakeOffWhenArmed) {
  TestGround ground("copter");
  ground.boot();
  auto const make = ground.maker();
  ground.upload({make.waypoint(0, 0, 0), make.waypoint(10, 0, 10)});
  ground.set_mode(copter_guided);
  ground.arm();
  EXPECT_EQ(ground.set_mode(3), MavResult::failed);
  EXPECT_EQ(ground.said("Auto: Missing Takeoff Cmd"), 1);
}

TEST(Modes, MissionStartAndRtlAreAcceptedWhileDisarmed) {
  TestGround ground("copter");
  ground.boot();
  auto const make = ground.maker();
  ground.upload({make.waypoint(0, 0, 0), make.take_off(10)});
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_EQ(ground.command(MavCmd::nav_return_to_launch), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
}

TEST(Reposition, IsDeniedOutsideGuidedUnlessItMayChangeTheMode) {
  TestGround ground("copter");
  ground.boot();
  auto const home = ground.world.options().home;
  CommandInt go{.target = {},
                .frame = MavFrame::global_relative_alt,
                .command = MavCmd::do_reposition,
                .params = {},
                .place = {}};
  go.place = {.lat_rad = home.lat_rad, .lon_rad = home.lon_rad, .x = 0, .y = 0, .z_m = 10};
  ground.send(go);
  ground.run_for(50ms);
  EXPECT_EQ(ground.last<CommandAck>()->result, MavResult::denied);
  go.params[1] = 1;
  ground.send(go);
  ground.run_for(50ms);
  EXPECT_EQ(ground.last<CommandAck>()->result, MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
}

// ---- parameters

TEST(VehicleParameters, ListComesInOrderWithIndices) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(ParamRequestList{});
  ground.run_for(1s);
  auto const values = ground.all<ParamValue>(1, from);
  ASSERT_EQ(values.size(), ground.vehicle().parameters().all().size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i].index, i);
    EXPECT_EQ(values[i].count, values.size());
  }
}

TEST(VehicleParameters, ReadAndSetByNameAnswerWithoutIndex) {
  TestGround ground("copter");
  ground.boot();
  ground.send(ParamRequestRead{.target = {}, .name = "RTL_ALT", .index = -1});
  ground.run_for(50ms);
  EXPECT_EQ(ground.last<ParamValue>()->value, 1500.0F);
  EXPECT_EQ(ground.last<ParamValue>()->index, 65535);
  ground.send(ParamSet{.target = {}, .name = "RTL_ALT", .value = 2500.0F});
  ground.run_for(50ms);
  EXPECT_EQ(ground.last<ParamValue>()->value, 2500.0F);
  EXPECT_EQ(ground.vehicle().parameters().value("RTL_ALT"), 2500.0);
}

TEST(VehicleParameters, UnknownNamesMeetSilence) {
  TestGround ground("copter");
  ground.boot();
  auto const from = ground.heard.size();
  ground.send(ParamRequestRead{.target = {}, .name = "NO_SUCH", .index = -1});
  ground.send(ParamSet{.target = {}, .name = "NO_SUCH", .value = 1.0F});
  ground.run_for(1s);
  EXPECT_TRUE(ground.all<ParamValue>(1, from).empty());
}

TEST(VehicleParameters, KnowTheirSystemId) {
  TestGround ground("copter:3");
  EXPECT_EQ(ground.vehicle(3).parameters().value("SYSID_THISMAV"), 3.0);
}

TEST(Battery, IsSwappedWhenTheVehicleHasStoodLongEnough) {
  WorldOptions options;
  options.battery_swap_after = 20s;
  TestGround ground("copter:1@40%", options);
  ground.boot();
  EXPECT_LT(ground.pilot().battery().remaining(), 0.41);
  ground.hover(10);
  ground.run_for(47s);
  EXPECT_LT(ground.pilot().battery().remaining(), 0.4);
  EXPECT_EQ(ground.set_mode(9), MavResult::accepted);
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 60s));
  ground.run_for(18s);
  EXPECT_LT(ground.pilot().battery().remaining(), 0.4);
  ground.run_for(3s);
  EXPECT_GT(ground.pilot().battery().remaining(), 0.99);
}

}  // namespace
}  // namespace lapwing::sim
