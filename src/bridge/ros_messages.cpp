#include "bridge/ros_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bridge/frames.hpp"

namespace lapwing::bridge {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Rounded, and within what the type holds.
template <class Integer>
Integer whole(double value) {
  using Limits = std::numeric_limits<Integer>;
  return static_cast<Integer>(std::clamp(std::round(value), double{Limits::lowest()}, double{Limits::max()}));
}

}  // namespace

bus::mavros::State ros_state(FlightController const& flight, base::TimePoint now) {
  if (!flight.is_connected(now)) return {};
  auto const& heartbeat = *flight.heartbeat;
  auto const has = [&](std::uint8_t flag) { return (heartbeat.base_mode & flag) != 0; };
  return {.connected = true,
          .armed = heartbeat.armed(),
          .guided = has(mavlink::mode_flag::guided_enabled),
          .manual_input = has(mavlink::mode_flag::manual_input_enabled),
          .mode = flight.mode(),
          .system_status = static_cast<std::uint8_t>(heartbeat.system_status)};
}

bus::mavros::SysStatus ros_system_status(mavlink::SysStatus const& status) {
  bus::mavros::SysStatus told;
  told.sensors_present = status.sensors_present;
  told.sensors_enabled = status.sensors_enabled;
  told.sensors_health = status.sensors_health;
  told.load = whole<std::uint16_t>(status.load.value_or(0.0) * 1000);
  told.voltage_battery = whole<std::uint16_t>(status.battery_voltage_v.value_or(65.535) * 1000);
  told.current_battery = whole<std::int16_t>(status.battery_current_a.value_or(-0.01) * 100);
  told.battery_remaining = whole<std::int8_t>(status.battery_remaining.value_or(-0.01) * 100);
  told.drop_rate_comm = whole<std::uint16_t>(status.drop_rate_comm.value_or(0.0) * 10'000);
  told.errors_comm = status.errors_comm;
  return told;
}

bus::BatteryState ros_battery(mavlink::SysStatus const& status) {
  constexpr std::uint8_t discharging = 2;
  constexpr auto none = std::numeric_limits<float>::quiet_NaN();
  return {.voltage = static_cast<float>(status.battery_voltage_v.value_or(unknown)),
          .temperature = none,
          .current = static_cast<float>(-status.battery_current_a.value_or(unknown)),
          .charge = none,
          .capacity = none,
          .design_capacity = none,
          .percentage = static_cast<float>(status.battery_remaining.value_or(unknown)),
          .power_supply_status = discharging,
          .present = status.battery_voltage_v.has_value()};
}

bus::NavSatFix ros_fix(mavlink::GlobalPosition const& position, std::optional<mavlink::GpsRaw> const& gps,
                       double geoid_m) {
  bus::NavSatFix told;
  bool const has_fix = gps && gps->fix >= mavlink::GpsFix::fix_3d;
  told.status = {.status = has_fix ? bus::NavSatStatus::fix : bus::NavSatStatus::no_fix, .service = 1};
  told.latitude = position.position->lat_deg();
  told.longitude = position.position->lon_deg();
  told.altitude = position.position->alt_m + geoid_m;
  if (gps && gps->horizontal_accuracy_m && gps->vertical_accuracy_m) {
    constexpr std::uint8_t diagonal_known = 2;
    double const level = *gps->horizontal_accuracy_m * *gps->horizontal_accuracy_m;
    told.position_covariance = {level, 0, 0, 0, level, 0, 0, 0, *gps->vertical_accuracy_m * *gps->vertical_accuracy_m};
    told.position_covariance_type = diagonal_known;
  }
  return told;
}

bus::mavros::HomePosition ros_home(geo::Wgs84 home, geo::Wgs84 origin, double geoid_m) {
  bus::mavros::HomePosition told;
  told.geo = {.latitude = home.lat_deg(), .longitude = home.lon_deg(), .altitude = home.alt_m + geoid_m};
  told.position = ros_point(geo::LocalFrame(origin).ned_from(home));
  return told;
}

}  // namespace lapwing::bridge
