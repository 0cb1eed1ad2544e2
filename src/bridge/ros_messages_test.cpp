#include "bridge/ros_messages.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::bridge {
namespace {

using namespace std::chrono_literals;

FlightController copter(std::uint32_t mode, bool is_armed) {
  FlightController flight;
  flight.heartbeat =
      mavlink::Heartbeat{.type = mavlink::MavType::quadrotor,
                         .autopilot = mavlink::MavAutopilot::ardupilotmega,
                         .base_mode = static_cast<std::uint8_t>(mavlink::mode_flag::custom_mode_enabled |
                                                                (is_armed ? mavlink::mode_flag::safety_armed : 0)),
                         .custom_mode = mode,
                         .system_status = mavlink::MavState::active};
  flight.heard = base::TimePoint(10s);
  return flight;
}

TEST(RosState, HasTheAutopilotsOwnNamesOfModes) {
  auto const state = ros_state(copter(4, true), base::TimePoint(11s));
  EXPECT_TRUE(state.connected);
  EXPECT_TRUE(state.armed);
  EXPECT_EQ(state.mode, "GUIDED");
  EXPECT_EQ(state.system_status, 4);
  EXPECT_EQ(ros_state(copter(6, false), base::TimePoint(11s)).mode, "RTL");
}

TEST(RosState, OfOneThatIsSilentSaysNothingButThat) {
  EXPECT_EQ(ros_state(copter(4, true), base::TimePoint(14s)), bus::mavros::State{});
  EXPECT_EQ(ros_state(FlightController{}, base::TimePoint(1s)), bus::mavros::State{});
}

TEST(FlightModes, AreFoundByNameAndByNumber) {
  auto const flight = copter(0, false);
  EXPECT_EQ(flight.mode_number("GUIDED"), 4U);
  EXPECT_EQ(flight.mode_number("guided"), 4U);
  EXPECT_EQ(flight.mode_number("6"), 6U);
  EXPECT_FALSE(flight.mode_number("NO SUCH MODE"));
  EXPECT_FALSE(flight.mode_number(""));
  EXPECT_FALSE(flight.mode_number("4x"));
  EXPECT_FALSE(FlightController{}.mode_number("GUIDED")) << "nobody knows what it is";
}

TEST(RosBattery, SaysWhatIsNotKnown) {
  auto const battery = ros_battery({.battery_voltage_v = 15.2, .battery_current_a = 12.0, .battery_remaining = 0.63});
  EXPECT_FLOAT_EQ(battery.voltage, 15.2F);
  EXPECT_FLOAT_EQ(battery.current, -12.0F) << "it is discharging";
  EXPECT_FLOAT_EQ(battery.percentage, 0.63F);
  EXPECT_TRUE(battery.present);
  auto const unknown = ros_battery({});
  EXPECT_TRUE(std::isnan(unknown.percentage) && std::isnan(unknown.voltage) && std::isnan(unknown.current));
  EXPECT_FALSE(unknown.present);
}

TEST(RosSystemStatus, HasMavlinksUnitsAndUnknowns) {
  auto const told = ros_system_status({.sensors_health = 5, .load = 0.25, .battery_voltage_v = 12.345});
  EXPECT_EQ(told.sensors_health, 5U);
  EXPECT_EQ(told.load, 250);
  EXPECT_EQ(told.voltage_battery, 12345);
  EXPECT_EQ(told.current_battery, -1);
  EXPECT_EQ(told.battery_remaining, -1);
  EXPECT_EQ(ros_system_status({}).voltage_battery, 65535);
}

TEST(RosFix, IsOneFromThreeDimensionsOn) {
  mavlink::GlobalPosition const position{.position = geo::Wgs84::from_degrees(43, -79, 100)};
  EXPECT_EQ(ros_fix(position, std::nullopt, 0).status.status, bus::NavSatStatus::no_fix);
  EXPECT_EQ(ros_fix(position, mavlink::GpsRaw{.fix = mavlink::GpsFix::fix_2d}, 0).status.status,
            bus::NavSatStatus::no_fix);
  auto const fix = ros_fix(
      position,
      mavlink::GpsRaw{.fix = mavlink::GpsFix::rtk_fixed, .horizontal_accuracy_m = 2.0, .vertical_accuracy_m = 3.0},
      -36.0);
  EXPECT_EQ(fix.status.status, bus::NavSatStatus::fix);
  EXPECT_NEAR(fix.latitude, 43, 1e-9);
  EXPECT_NEAR(fix.altitude, 64, 1e-9) << "above the ellipsoid";
  EXPECT_NEAR(fix.position_covariance[0], 4, 1e-9);
  EXPECT_NEAR(fix.position_covariance[8], 9, 1e-9);
}

TEST(RosHome, LiesInTheLocalFrameWhereItLiesOnTheGlobe) {
  auto const origin = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
  auto const home = ros_home(geo::displaced(origin, {.north = 7, .east = -3, .down = -1}), origin, 0);
  EXPECT_NEAR(home.position.x, -3, 1e-3);
  EXPECT_NEAR(home.position.y, 7, 1e-3);
  EXPECT_NEAR(home.position.z, 1, 1e-3);
}

}  // namespace
}  // namespace lapwing::bridge
