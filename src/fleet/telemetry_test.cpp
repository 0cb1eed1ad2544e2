#include "fleet/telemetry.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using base::TimePoint;

struct Telemetry : testing::Test {
  void take(mavlink::Message const& message, base::Duration at) { (void)take_telemetry(craft, message, TimePoint(at)); }
  void take_position(geo::Wgs84 place, base::Duration at, std::optional<double> heading_rad = 1.0) {
    take(mavlink::GlobalPosition{.since_boot = {},
                                 .position = place,
                                 .relative_alt_m = 20.0,
                                 .velocity_m_s = {1.0, 2.0, 3.0},
                                 .heading_rad = heading_rad},
         at);
  }
  void take_ekf(std::uint16_t flags, base::Duration at) {
    mavlink::EkfStatusReport report;
    report.flags = flags;
    take(report, at);
  }

  base::Loop loop{{.unpaced = true}};
  vehicle::VehicleState state;
  Craft craft{loop, state};
  geo::Wgs84 const here = geo::Wgs84::from_degrees(40.0, -8.0, 120.0);
};

TEST_F(Telemetry, GivesEveryFieldTheTimeAtWhichItWasHeard) {
  take_position(here, 5s);
  take(mavlink::Attitude{.roll_rad = 0.1, .pitch_rad = 0.2, .yaw_rad = 0.3}, 6s);
  EXPECT_EQ(state.position.value, here);
  EXPECT_EQ(*state.position.age(TimePoint(8s)), 3s);
  EXPECT_EQ(state.relative_alt_m.value, 20.0);
  EXPECT_EQ(state.velocity_m_s.value, (geo::Ned{1.0, 2.0, 3.0}));
  EXPECT_EQ(state.attitude.value->pitch_rad, 0.2);
  EXPECT_EQ(*state.attitude.age(TimePoint(8s)), 2s);
  EXPECT_FALSE(state.battery.known());
}

TEST_F(Telemetry, IgnoresThePositionThatIsSentBeforeTheFirstFix) {
  take_position({}, 1s);
  EXPECT_FALSE(state.position.known());
  mavlink::GpsRaw gps;
  gps.fix = mavlink::GpsFix::no_fix;
  take(gps, 2s);
  take_position(here, 3s);
  EXPECT_FALSE(state.position.known());
  gps.fix = mavlink::GpsFix::rtk_fixed;
  take(gps, 4s);
  take_position(here, 5s);
  EXPECT_TRUE(state.position.known());
}

TEST_F(Telemetry, KnowsNoHeadingUntilTheEstimatorIsSure) {
  take_position(here, 1s);
  EXPECT_FALSE(state.heading_rad.known());
  take_ekf(0x33F, 2s);
  take_position(here, 3s);
  EXPECT_EQ(state.heading_rad.value, 1.0);
}

TEST_F(Telemetry, TakesTheEstimatorForGoodOnlyWithAnAbsolutePositionThatIsNotConstant) {
  take_ekf(0xA7, 1s);  // ArduCopter 4.6 before it uses GPS
  EXPECT_FALSE(state.health.value->position_ok);
  take_ekf(0x33F, 2s);
  EXPECT_TRUE(state.health.value->position_ok);
  take_ekf(0x33F | mavlink::ekf_flag::constant_position_mode, 3s);
  EXPECT_FALSE(state.health.value->position_ok);
}

TEST_F(Telemetry, LeavesABatteryUnknownThatTheVehicleDoesNotKnow) {
  take(mavlink::SysStatus{}, 1s);
  EXPECT_FALSE(state.battery.known());
  mavlink::SysStatus status;
  status.battery_remaining = 0.25;
  status.battery_voltage_v = 11.1;
  take(status, 2s);
  EXPECT_EQ(state.battery.value->remaining, 0.25);
  EXPECT_EQ(state.battery.value->voltage_v, 11.1);
}

TEST_F(Telemetry, TakesTheFirstBatteryOnlyFromBatteryStatus) {
  mavlink::BatteryStatus status;
  status.id = 1;
  status.remaining = 0.1;
  take(status, 1s);
  EXPECT_FALSE(state.battery.known());
  status.id = 0;
  status.remaining = 0.9;
  take(status, 2s);
  EXPECT_EQ(state.battery.value->remaining, 0.9);
}

TEST_F(Telemetry, ReadsThePrearmBit) {
  mavlink::SysStatus status;
  take(status, 1s);
  EXPECT_FALSE(state.health.value->prearm_ok);
  status.sensors_health = mavlink::sensor_flag::prearm_check;
  take(status, 2s);
  EXPECT_TRUE(state.health.value->prearm_ok);
}

TEST_F(Telemetry, FollowsMissionHomeAndLanding) {
  take(mavlink::MissionCurrent{.seq = 3, .total = 7, .state = mavlink::MissionState::active}, 1s);
  EXPECT_EQ(state.mission.value->current_seq, 3);
  EXPECT_EQ(state.mission.value->total, 7);
  take(mavlink::MissionCurrent{.seq = 0, .total = std::nullopt, .state = mavlink::MissionState::complete}, 2s);
  EXPECT_TRUE(state.mission.value->complete);
  EXPECT_EQ(state.mission.value->total, 7);
  EXPECT_EQ(craft.trace.current_seq, 3);
  take(mavlink::HomePosition{.position = here, .local_m = {}}, 3s);
  EXPECT_EQ(state.home.value, here);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::undefined}, 4s);
  EXPECT_FALSE(state.landed.known());
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::on_ground}, 5s);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::on_ground}, 7s);
  EXPECT_EQ(state.landed.value, true);
  EXPECT_EQ(craft.trace.on_ground_for(), 2s);
  take(mavlink::ExtendedSysState{.landed_state = mavlink::MavLandedState::in_air}, 8s);
  EXPECT_FALSE(craft.trace.on_ground_for());
}

TEST_F(Telemetry, AddsUpTheTrackWithoutNoiseAndJumps) {
  take_position(here, 0s);
  take_position(geo::displaced(here, {0.2, 0.0, 0.0}), 1s);  // noise
  EXPECT_EQ(state.track_m, 0.0);
  take_position(geo::displaced(here, {10.0, 0.0, 0.0}), 2s);
  take_position(geo::displaced(here, {10.0, 10.0, 0.0}), 3s);
  EXPECT_NEAR(state.track_m, 20.0, 0.01);
  take_position(geo::displaced(here, {5000.0, 10.0, 0.0}), 4s);  // the estimator jumped
  take_position(geo::displaced(here, {5010.0, 10.0, 0.0}), 5s);
  EXPECT_NEAR(state.track_m, 30.0, 0.01);
}

TEST_F(Telemetry, KeepsTheLastTextsOnly) {
  for (int i = 0; i < 60; ++i)
    (void)take_text(craft, {.severity = mavlink::MavSeverity::info, .text = std::to_string(i)}, TimePoint(1s));
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
