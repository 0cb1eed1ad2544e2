#include "fleet/state/telemetry.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using base::TimePoint;

struct Telemetry : ::testing::Test {
  void take(mavlink::Message const& message, base::Duration at) { (void)take_telemetry(craft, message, TimePoint(at)); }
  void take_position(geo::Wgs84 place, base::Duration at, std::optional<double> heading_rad = 1.0) {
    take(mavlink::GlobalPosition{.since_boot = {},
                                 .position = place,
                                 .relative_alt_m = 20.0,
                                 .velocity_m_s = geo::Ned{1.0, 2.0, 3.0},
                                 .heading_rad = heading_rad},
         at);
  }
  void take_ekf(std::uint16_t flags, base::Duration at) {
    mavlink::EkfStatusReport report;
    report.flags = flags;
    take(report, at);
  }

  base::Loop loop{{.unpaced = true}};
  mavlink::Connection connection{loop, {}, base::Logger()};
  vehicle::VehicleState state;
  MavlinkVehicle craft{connection, state};
  geo::Wgs84 const here = geo::Wgs84::from_degrees(40.0, -8.0, 120.0);
};

TEST_F(Telemetry, GivesEveryFieldTheTimeAtWhichItWasHeard) {
  take_position(here, 5s);
  take(mavlink::Attitude{.roll_rad = 0.1, .pitch_rad = 0.2, .yaw_rad = 0.3}, 6s);
  EXPECT_EQ(state.motion.position.value, here);
  EXPECT_EQ(*state.motion.position.age(TimePoint(8s)), 3s);
  EXPECT_EQ(state.motion.relative_alt_m.value, 20.0);
  EXPECT_EQ(state.motion.velocity_m_s.value, (geo::Ned{1.0, 2.0, 3.0}));
  EXPECT_EQ(state.motion.attitude.value->pitch_rad, 0.2);
  EXPECT_EQ(*state.motion.attitude.age(TimePoint(8s)), 2s);
  EXPECT_FALSE(state.power.battery.known());
}

TEST_F(Telemetry, IgnoresThePositionThatIsSentBeforeTheFirstFix) {
  take_position({}, 1s);
  EXPECT_FALSE(state.motion.position.known());
  mavlink::GpsRaw gps;
  gps.fix = mavlink::GpsFix::no_fix;
  take(gps, 2s);
  take_position(here, 3s);
  EXPECT_FALSE(state.motion.position.known());
  gps.fix = mavlink::GpsFix::rtk_fixed;
  take(gps, 4s);
  take_position(here, 5s);
  EXPECT_TRUE(state.motion.position.known());
}

TEST_F(Telemetry, KnowsNoHeadingUntilTheEstimatorIsSure) {
  take_position(here, 1s);
  EXPECT_FALSE(state.motion.heading_rad.known());
  take_ekf(0x33F, 2s);
  take_position(here, 3s);
  EXPECT_EQ(state.motion.heading_rad.value, 1.0);
}

TEST_F(Telemetry, TakesTheEstimatorForGoodOnlyWithAnAbsolutePositionThatIsNotConstant) {
  take_ekf(0xA7, 1s);  // ArduCopter 4.6 before it uses GPS
  EXPECT_FALSE(state.arming.health.value->position_ok);
  take_ekf(0x33F, 2s);
  EXPECT_TRUE(state.arming.health.value->position_ok);
  take_ekf(0x33F | mavlink::ekf_flag::constant_position_mode, 3s);
  EXPECT_FALSE(state.arming.health.value->position_ok);
}

TEST_F(Telemetry, LeavesABatteryUnknownThatTheVehicleDoesNotKnow) {
  take(mavlink::SysStatus{}, 1s);
  EXPECT_FALSE(state.power.battery.known());
  mavlink::SysStatus status;
  status.battery_remaining = 0.25;
  status.battery_voltage_v = 11.1;
  take(status, 2s);
  EXPECT_EQ(state.power.battery.value->remaining, 0.25);
  EXPECT_EQ(state.power.battery.value->voltage_v, 11.1);
}

TEST_F(Telemetry, TakesTheFirstBatteryOnlyFromBatteryStatus) {
  mavlink::BatteryStatus status;
  status.id = 1;
  status.remaining = 0.1;
  take(status, 1s);
  EXPECT_FALSE(state.power.battery.known());
  status.id = 0;
  status.remaining = 0.9;
  take(status, 2s);
  EXPECT_EQ(state.power.battery.value->remaining, 0.9);
}

TEST_F(Telemetry, ShowsFurtherBatteriesById) {
  for (int const id : {2, 1, 2}) {
    mavlink::BatteryStatus status;
    status.id = static_cast<std::uint8_t>(id);
    status.remaining = 0.1 * id;
    take(status, 1s);
  }
  ASSERT_EQ(state.power.further_batteries.size(), 2u);
  EXPECT_EQ(state.power.further_batteries[0].value->id, 1);
  EXPECT_NEAR(state.power.further_batteries[1].value->remaining, 0.2, 1e-9);
  EXPECT_EQ(state.power.further_batteries[1].heard, TimePoint(1s));
}

TEST_F(Telemetry, BelievesTheTimeLeftThatTheVehicleTells) {
  mavlink::BatteryStatus status;
  status.remaining = 0.9;
  status.consumed_ah = 0.5;
  status.time_remaining = 600s;
  take(status, 1s);
  EXPECT_EQ(state.power.battery.value->time_left, 600s);
  EXPECT_EQ(state.power.battery.value->time_left_error, 0s);
  EXPECT_FALSE(state.power.battery.value->time_left_is_estimate);
  EXPECT_EQ(state.power.battery.value->consumed_ah, 0.5);
}

TEST_F(Telemetry, EstimatesTheTimeLeftThatTheVehicleDoesNotTell) {
  state.family = vehicle::Family::copter;
  mavlink::ExtendedSysState ground;
  ground.landed_state = mavlink::MavLandedState::on_ground;
  take(ground, 0s);
  auto const report = [&](double remaining, double current_a, base::Duration at) {
    mavlink::BatteryStatus status;
    status.remaining = remaining;
    status.current_a = current_a;
    take(status, at);
  };
  for (int second = 0; second <= 600; ++second) report(1.0, 0.5, second * 1s);
  EXPECT_FALSE(state.power.battery.value->time_left) << "it stands";
  mavlink::ExtendedSysState air;
  air.landed_state = mavlink::MavLandedState::in_air;
  take(air, 600s);
  // A percent every six seconds: all of it in 600 s.
  for (int second = 0; second <= 60; ++second) {
    int const used_percent = second / 6;
    report(1.0 - 0.01 * used_percent, 30.0, 600s + second * 1s);
  }
  auto const& battery = *state.power.battery.value;
  ASSERT_TRUE(battery.time_left);
  EXPECT_TRUE(battery.time_left_is_estimate);
  EXPECT_NEAR(base::to_seconds(*battery.time_left), 540.0, 30.0);
  EXPECT_GT(battery.time_left_error, 10s);
  take(ground, 661s);
  report(0.9, 0.5, 662s);
  EXPECT_FALSE(state.power.battery.value->time_left);
  ASSERT_TRUE(vehicle::endurance_in_flight(state));
  EXPECT_NEAR(base::to_seconds(vehicle::endurance_in_flight(state)->time), 540.0, 30.0) << "by the flight before";
}

TEST_F(Telemetry, DoesNotForgetOverSysStatusWhatBatteryStatusTold) {
  mavlink::BatteryStatus status;
  status.remaining = 0.9;
  status.consumed_ah = 0.5;
  take(status, 1s);
  mavlink::SysStatus other;
  other.battery_remaining = 0.89;
  take(other, 2s);
  EXPECT_EQ(state.power.battery.value->consumed_ah, 0.5);
  take(other, 8s);  // BATTERY_STATUS has stopped
  EXPECT_EQ(state.power.battery.value->remaining, 0.89);
}

TEST_F(Telemetry, NamesTheSensorsThatAreSick) {
  mavlink::SysStatus status;
  status.sensors_present = 0x24;  // compass, GPS
  status.sensors_enabled = 0x24;
  status.sensors_health = 0x20;
  take(status, 1s);
  EXPECT_EQ(state.arming.unhealthy.value, std::vector<std::string_view>{"compass"});
  status.sensors_health = 0;
  status.sensors_enabled = 0x20;  // a compass that is not used may be sick
  take(status, 2s);
  EXPECT_EQ(state.arming.unhealthy.value, std::vector<std::string_view>{"GPS"});
  status.sensors_health = 0x20;
  take(status, 3s);
  EXPECT_TRUE(state.arming.unhealthy.value->empty());
  EXPECT_EQ(state.arming.unhealthy.heard, TimePoint(3s));
}

TEST_F(Telemetry, KeepsTheReasonsAgainstArmingUntilTheChecksPass) {
  take(mavlink::SysStatus{}, 1s);
  (void)take_text(craft, 1, {.severity = mavlink::MavSeverity::critical, .text = "PreArm: Compass not calibrated"},
                  TimePoint(2s));
  take(mavlink::SysStatus{}, 3s);
  ASSERT_EQ(state.arming.reasons.size(), 1u);
  mavlink::SysStatus passed;
  passed.sensors_health = mavlink::sensor_flag::prearm_check;
  take(passed, 4s);
  EXPECT_TRUE(state.arming.reasons.empty());
  // Refused in this mode though the checks pass.
  (void)take_text(craft, 1, {.severity = mavlink::MavSeverity::critical, .text = "Arm: Mode not armable"},
                  TimePoint(5s));
  take(passed, 6s);
  EXPECT_EQ(state.arming.reasons.size(), 1u);
}

TEST_F(Telemetry, TellsTheRemoteControlIsLostByItsChannelsOrItsHealth) {
  mavlink::RcChannels channels;
  channels.count = 8;
  channels.rssi = 0.5;
  take(channels, 1s);
  EXPECT_FALSE(state.links.remote_control.value->is_lost);
  mavlink::SysStatus status;
  status.sensors_present = status.sensors_enabled = mavlink::sensor_flag::rc_receiver;
  take(status, 2s);
  EXPECT_TRUE(state.links.remote_control.value->is_lost);
  take(channels, 3s);
  EXPECT_TRUE(state.links.remote_control.value->is_lost);
  status.sensors_health = mavlink::sensor_flag::rc_receiver;
  take(status, 4s);
  EXPECT_FALSE(state.links.remote_control.value->is_lost);
  channels.count = 0;
  take(channels, 5s);
  EXPECT_TRUE(state.links.remote_control.value->is_lost);
}

TEST_F(Telemetry, TellsWhereTheWindComesFromForBothAutopilots) {
  take(mavlink::Wind{.from_rad = -0.5, .speed_m_s = 3.0}, 1s);
  EXPECT_NEAR(state.motion.wind.value->from_rad, 2.0 * std::numbers::pi - 0.5, 1e-9);
  take(mavlink::WindCov{.north_m_s = 0.0, .east_m_s = 4.0}, 2s);  // to the east: from the west
  EXPECT_NEAR(state.motion.wind.value->from_rad, 1.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(state.motion.wind.value->speed_m_s, 4.0, 1e-9);
  take(mavlink::WindCov{.east_m_s = 4.0}, 3s);
  EXPECT_EQ(state.motion.wind.heard, TimePoint(2s));
}

TEST_F(Telemetry, ShowsGpsEstimatorHudFenceAndTheWayToGo) {
  mavlink::GpsRaw gps;
  gps.fix = mavlink::GpsFix::rtk_fixed;
  gps.satellites = 14;
  gps.hdop = 0.7;
  take(gps, 1s);
  EXPECT_EQ(vehicle::gps_fix_name(state.positioning.gps.value->fix), "RTK fixed");
  EXPECT_EQ(state.positioning.gps.value->satellites, 14);
  take(mavlink::EkfStatusReport{.flags = 0x33F, .compass_variance = 0.5F}, 2s);
  EXPECT_EQ(state.positioning.estimator.value->compass, 0.5);
  take(mavlink::VfrHud{.airspeed_m_s = 14.0, .throttle = 0.5, .climb_m_s = -1.0}, 3s);
  EXPECT_EQ(state.motion.hud.value->climb_m_s, -1.0);
  take(mavlink::FenceStatus{.breached = true, .breach_count = 2, .breach_type = 3}, 4s);
  EXPECT_TRUE(state.mission.fence.value->is_breached);
  EXPECT_EQ(state.mission.fence.value->type, "boundary");
  take(mavlink::FenceStatus{.breach_type = 200}, 4s);
  EXPECT_EQ(state.mission.fence.value->type, "fence");
  take(mavlink::NavControllerOutput{.waypoint_distance_m = 120.0}, 5s);
  EXPECT_EQ(state.mission.waypoint_distance_m.value, 120.0);
  take(mavlink::MissionCurrent{.seq = 3, .total = 7, .state = mavlink::MissionState::paused}, 6s);
  EXPECT_EQ(state.mission.progress.value->state, "paused");
}

TEST_F(Telemetry, ReadsThePrearmBit) {
  mavlink::SysStatus status;
  take(status, 1s);
  EXPECT_FALSE(state.arming.health.value->prearm_ok);
  status.sensors_health = mavlink::sensor_flag::prearm_check;
  take(status, 2s);
  EXPECT_TRUE(state.arming.health.value->prearm_ok);
}

TEST_F(Telemetry, FollowsMissionHomeAndLanding) {
  take(mavlink::MissionCurrent{.seq = 3, .total = 7, .state = mavlink::MissionState::active}, 1s);
  EXPECT_EQ(state.mission.progress.value->current_seq, 3);
  EXPECT_EQ(state.mission.progress.value->total, 7);
  take(mavlink::MissionCurrent{.seq = 0, .total = std::nullopt, .state = mavlink::MissionState::complete}, 2s);
  EXPECT_TRUE(state.mission.progress.value->complete);
  EXPECT_EQ(state.mission.progress.value->total, 7);
  EXPECT_EQ(craft.heard->trace.current_seq, 3);
  take(mavlink::HomePosition{.position = here, .local_m = {}}, 3s);
  EXPECT_EQ(state.motion.home.value, here);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::undefined}, 4s);
  EXPECT_FALSE(state.motion.landed.known());
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::on_ground}, 5s);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::on_ground}, 7s);
  EXPECT_EQ(state.motion.landed.value, true);
  EXPECT_EQ(craft.heard->trace.on_ground_for(), 2s);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::in_air}, 8s);
  EXPECT_FALSE(craft.heard->trace.on_ground_for());
}

TEST_F(Telemetry, AddsUpTheTrackWithoutNoiseAndJumps) {
  take_position(here, 0s);
  take_position(geo::displaced(here, {0.2, 0.0, 0.0}), 1s);  // noise
  EXPECT_EQ(state.motion.track_m, 0.0);
  take_position(geo::displaced(here, {10.0, 0.0, 0.0}), 2s);
  take_position(geo::displaced(here, {10.0, 10.0, 0.0}), 3s);
  EXPECT_NEAR(state.motion.track_m, 20.0, 0.01);
  take_position(geo::displaced(here, {5000.0, 10.0, 0.0}), 4s);  // the estimator jumped
  take_position(geo::displaced(here, {5010.0, 10.0, 0.0}), 5s);
  EXPECT_NEAR(state.motion.track_m, 30.0, 0.01);
}

TEST_F(Telemetry, KeepsTheLastTextsOnly) {
  for (int i = 0; i < 60; ++i)
    (void)take_text(craft, 1, {.severity = mavlink::MavSeverity::info, .text = std::to_string(i)}, TimePoint(1s));
  EXPECT_EQ(state.recent_texts.size(), 50u);
  EXPECT_EQ(state.recent_texts.back().text, "59");
}

TEST_F(Telemetry, AsksPx4ForItsOwnEstimatorMessage) {
  auto const wants = [](vehicle::Autopilot autopilot, mavlink::MessageId id) {
    for (auto const& message : wanted_messages(autopilot))
      if (message.id == id) return true;
    return false;
  };
  EXPECT_TRUE(wants(vehicle::Autopilot::ardupilot, mavlink::MessageId::ekf_status_report));
  EXPECT_FALSE(wants(vehicle::Autopilot::px4, mavlink::MessageId::ekf_status_report));
  EXPECT_TRUE(wants(vehicle::Autopilot::px4, mavlink::MessageId::estimator_status));
}

}  // namespace
}  // namespace lapwing::fleet
