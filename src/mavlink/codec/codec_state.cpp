// Identity, time and health.
#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/intake.hpp"
#include "mavlink/wire/wire.hpp"

#include <ardupilotmega/mavlink_msg_ekf_status_report.hpp>
#include <common/mavlink_msg_battery_status.hpp>
#include <common/mavlink_msg_estimator_status.hpp>
#include <common/mavlink_msg_extended_sys_state.hpp>
#include <common/mavlink_msg_fence_status.hpp>
#include <common/mavlink_msg_ping.hpp>
#include <common/mavlink_msg_radio_status.hpp>
#include <common/mavlink_msg_statustext.hpp>
#include <common/mavlink_msg_sys_status.hpp>
#include <common/mavlink_msg_system_time.hpp>
#include <common/mavlink_msg_timesync.hpp>
#include <minimal/mavlink_msg_heartbeat.hpp>
#include <standard/mavlink_msg_autopilot_version.hpp>

namespace lapwing::mavlink::internal {

using namespace ::mavlink::minimal::msg;
using namespace ::mavlink::standard::msg;
using namespace ::mavlink::common::msg;
using ::mavlink::ardupilotmega::msg::EKF_STATUS_REPORT;

namespace {

auto constexpr unknown16 = std::numeric_limits<std::uint16_t>::max();
auto constexpr unknown8 = std::numeric_limits<std::uint8_t>::max();

Heartbeat read(HEARTBEAT const& w) {
  return {.type = MavType{w.type},
          .autopilot = MavAutopilot{w.autopilot},
          .base_mode = w.base_mode,
          .custom_mode = w.custom_mode,
          .system_status = MavState{w.system_status},
          .mavlink_version = w.mavlink_version};
}

SystemTime read(SYSTEM_TIME const& w, Intake& in) {
  return {.utc = in.utc("time_unix_usec", w.time_unix_usec), .since_boot = since_boot(w.time_boot_ms)};
}

Ping read(PING const& w) {
  return {.target = target(w), .time = microseconds(w.time_usec), .seq = w.seq};
}

Timesync read(TIMESYNC const& w) {
  return {.tc1 = Duration(w.tc1), .ts1 = Duration(w.ts1)};
}

AutopilotVersion read(AUTOPILOT_VERSION const& w) {
  return {.capabilities = w.capabilities,
          .flight_sw_version = w.flight_sw_version,
          .board_version = w.board_version,
          .vendor_id = w.vendor_id,
          .product_id = w.product_id,
          .uid = w.uid,
          .flight_custom_version = w.flight_custom_version,
          .uid2 = w.uid2};
}

SysStatus read(SYS_STATUS const& w, Intake& in) {
  return {
      .sensors_present = w.onboard_control_sensors_present,
      .sensors_enabled = w.onboard_control_sensors_enabled,
      .sensors_health = w.onboard_control_sensors_health,
      .load = in("load", limit::load, unless(unknown16, w.load, milli)),
      .battery_voltage_v = in("voltage_battery", limit::voltage_v, unless(unknown16, w.voltage_battery, milli)),
      .battery_current_a = in("current_battery", limit::current_a, unless<std::int16_t>(-1, w.current_battery, centi)),
      .battery_remaining =
          in("battery_remaining", limit::fraction, unless<std::int8_t>(-1, w.battery_remaining, centi)),
      .drop_rate_comm = in("drop_rate_comm", limit::fraction, unless(unknown16, w.drop_rate_comm, 1e-4)),
      .errors_comm = w.errors_comm};
}

/// Cells that are not there are UINT16_MAX, further ones (added to the protocol later) 0. A pack whose cells are not
/// measured comes as one cell, or as several when the voltage exceeds one field.
std::optional<double> pack_voltage_v(BATTERY_STATUS const& w) {
  if (w.voltages[0] == unknown16) return std::nullopt;
  double sum_mv = 0.0;
  for (auto const cell : w.voltages) sum_mv += cell == unknown16 ? 0 : cell;
  for (auto const cell : w.voltages_ext) sum_mv += cell == unknown16 ? 0 : cell;
  return sum_mv * milli;
}

void put_pack_voltage(std::optional<double> voltage_v, BATTERY_STATUS& w) {
  w.voltages.fill(unknown16);
  if (!voltage_v) return;
  auto rest = rounded<std::uint32_t>(*voltage_v / milli);
  for (auto& cell : w.voltages) {
    cell = static_cast<std::uint16_t>(std::min<std::uint32_t>(rest, unknown16 - 1U));
    rest -= cell;
    if (rest == 0) return;
  }
}

BatteryStatus read(BATTERY_STATUS const& w, Intake& in) {
  auto constexpr no_temperature = std::numeric_limits<std::int16_t>::max();
  BatteryStatus m{
      .id = w.id,
      .voltage_v = in("voltages", limit::voltage_v, pack_voltage_v(w)),
      .current_a = in("current_battery", limit::current_a, unless<std::int16_t>(-1, w.current_battery, centi)),
      .consumed_ah = in("current_consumed", limit::charge_ah, unless<std::int32_t>(-1, w.current_consumed, milli)),
      .energy_consumed_j = in("energy_consumed", limit::energy_j, unless<std::int32_t>(-1, w.energy_consumed, 100.0)),
      .remaining = in("battery_remaining", limit::fraction, unless<std::int8_t>(-1, w.battery_remaining, centi)),
      .temperature_c = in("temperature", limit::temperature_c, unless(no_temperature, w.temperature, centi)),
      .time_remaining = std::nullopt,
      .charge_state = w.charge_state};
  if (w.time_remaining != 0 && in("time_remaining", limit::remaining_s, w.time_remaining))
    m.time_remaining = std::chrono::seconds(w.time_remaining);
  return m;
}

EkfStatusReport read(EKF_STATUS_REPORT const& w, Intake& in) {
  return {.flags = w.flags,
          .velocity_variance = in("velocity_variance", limit::test_ratio, w.velocity_variance),
          .position_horizontal_variance = in("pos_horiz_variance", limit::test_ratio, w.pos_horiz_variance),
          .position_vertical_variance = in("pos_vert_variance", limit::test_ratio, w.pos_vert_variance),
          .compass_variance = in("compass_variance", limit::test_ratio, w.compass_variance),
          .terrain_alt_variance = in("terrain_alt_variance", limit::test_ratio, w.terrain_alt_variance)};
}

EstimatorStatus read(ESTIMATOR_STATUS const& w, Intake& in) {
  return {.flags = w.flags,
          .velocity_ratio = in("vel_ratio", limit::test_ratio, w.vel_ratio),
          .position_horizontal_ratio = in("pos_horiz_ratio", limit::test_ratio, w.pos_horiz_ratio),
          .position_vertical_ratio = in("pos_vert_ratio", limit::test_ratio, w.pos_vert_ratio),
          .position_horizontal_accuracy_m = in("pos_horiz_accuracy", limit::accuracy_m, w.pos_horiz_accuracy),
          .position_vertical_accuracy_m = in("pos_vert_accuracy", limit::accuracy_m, w.pos_vert_accuracy)};
}

ExtendedSysState read(EXTENDED_SYS_STATE const& w) {
  return {.vtol_state = MavVtolState{w.vtol_state}, .landed_state = MavLandedState{w.landed_state}};
}

StatusText read(STATUSTEXT const& w) {
  return {.severity = MavSeverity{w.severity}, .text = text(w.text), .id = w.id, .chunk_seq = w.chunk_seq};
}

FenceStatus read(FENCE_STATUS const& w) {
  return {.breached = w.breach_status != 0,
          .breach_count = w.breach_count,
          .breach_type = w.breach_type,
          .breach_time = since_boot(w.breach_time)};
}

std::optional<std::uint8_t> signal_strength(std::uint8_t wire) {
  if (wire == unknown8) return std::nullopt;
  return wire;
}

RadioStatus read(RADIO_STATUS const& w, Intake& in) {
  return {.rssi = signal_strength(w.rssi),
          .remote_rssi = signal_strength(w.remrssi),
          .transmit_buffer_free = in("txbuf", limit::fraction, unless(unknown8, w.txbuf, centi)),
          .noise = signal_strength(w.noise),
          .remote_noise = signal_strength(w.remnoise),
          .receive_errors = w.rxerrors,
          .corrected = w.fixed};
}

}  // namespace

std::optional<Message> read_state(Frame const& frame, Intake& in) {
  switch (frame.message_id) {
    case HEARTBEAT::MSG_ID: return read(unpack<HEARTBEAT>(frame));
    case SYSTEM_TIME::MSG_ID: return read(unpack<SYSTEM_TIME>(frame), in);
    case PING::MSG_ID: return read(unpack<PING>(frame));
    case TIMESYNC::MSG_ID: return read(unpack<TIMESYNC>(frame));
    case AUTOPILOT_VERSION::MSG_ID: return read(unpack<AUTOPILOT_VERSION>(frame));
    case SYS_STATUS::MSG_ID: return read(unpack<SYS_STATUS>(frame), in);
    case BATTERY_STATUS::MSG_ID: return read(unpack<BATTERY_STATUS>(frame), in);
    case EKF_STATUS_REPORT::MSG_ID: return read(unpack<EKF_STATUS_REPORT>(frame), in);
    case ESTIMATOR_STATUS::MSG_ID: return read(unpack<ESTIMATOR_STATUS>(frame), in);
    case EXTENDED_SYS_STATE::MSG_ID: return read(unpack<EXTENDED_SYS_STATE>(frame));
    case STATUSTEXT::MSG_ID: return read(unpack<STATUSTEXT>(frame));
    case FENCE_STATUS::MSG_ID: return read(unpack<FENCE_STATUS>(frame));
    case RADIO_STATUS::MSG_ID: return read(unpack<RADIO_STATUS>(frame), in);
    default: return std::nullopt;
  }
}

void write(Heartbeat const& m, Frame& frame) {
  HEARTBEAT w{};
  w.type = static_cast<std::uint8_t>(m.type);
  w.autopilot = static_cast<std::uint8_t>(m.autopilot);
  w.base_mode = m.base_mode;
  w.custom_mode = m.custom_mode;
  w.system_status = static_cast<std::uint8_t>(m.system_status);
  w.mavlink_version = m.mavlink_version;
  pack(w, frame);
}

void write(SystemTime const& m, Frame& frame) {
  SYSTEM_TIME w{};
  w.time_unix_usec = m.utc ? microsecond_count(*m.utc) : 0;
  w.time_boot_ms = boot_ms(m.since_boot);
  pack(w, frame);
}

void write(Ping const& m, Frame& frame) {
  PING w{};
  put_target(w, m.target);
  w.time_usec = microsecond_count(m.time);
  w.seq = m.seq;
  pack(w, frame);
}

void write(Timesync const& m, Frame& frame) {
  TIMESYNC w{};
  w.tc1 = m.tc1.count();
  w.ts1 = m.ts1.count();
  pack(w, frame);
}

void write(AutopilotVersion const& m, Frame& frame) {
  AUTOPILOT_VERSION w{};
  w.capabilities = m.capabilities;
  w.flight_sw_version = m.flight_sw_version;
  w.board_version = m.board_version;
  w.vendor_id = m.vendor_id;
  w.product_id = m.product_id;
  w.uid = m.uid;
  w.flight_custom_version = m.flight_custom_version;
  w.uid2 = m.uid2;
  pack(w, frame);
}

void write(SysStatus const& m, Frame& frame) {
  SYS_STATUS w{};
  w.onboard_control_sensors_present = m.sensors_present;
  w.onboard_control_sensors_enabled = m.sensors_enabled;
  w.onboard_control_sensors_health = m.sensors_health;
  w.load = rounded_or(unknown16, m.load, milli);
  w.voltage_battery = rounded_or(unknown16, m.battery_voltage_v, milli);
  w.current_battery = rounded_or<std::int16_t>(-1, m.battery_current_a, centi);
  w.battery_remaining = rounded_or<std::int8_t>(-1, m.battery_remaining, centi);
  w.drop_rate_comm = rounded_or(unknown16, m.drop_rate_comm, 1e-4);
  w.errors_comm = m.errors_comm;
  pack(w, frame);
}

void write(BatteryStatus const& m, Frame& frame) {
  auto constexpr no_temperature = std::numeric_limits<std::int16_t>::max();
  BATTERY_STATUS w{};
  w.id = m.id;
  put_pack_voltage(m.voltage_v, w);
  w.current_battery = rounded_or<std::int16_t>(-1, m.current_a, centi);
  w.current_consumed = rounded_or<std::int32_t>(-1, m.consumed_ah, milli);
  w.energy_consumed = rounded_or<std::int32_t>(-1, m.energy_consumed_j, 100.0);
  w.battery_remaining = rounded_or<std::int8_t>(-1, m.remaining, centi);
  w.temperature = rounded_or(no_temperature, m.temperature_c, centi);
  w.time_remaining = m.time_remaining ? static_cast<std::int32_t>(m.time_remaining->count()) : 0;
  w.charge_state = m.charge_state;
  pack(w, frame);
}

void write(EkfStatusReport const& m, Frame& frame) {
  EKF_STATUS_REPORT w{};
  w.flags = m.flags;
  w.velocity_variance = narrow(m.velocity_variance);
  w.pos_horiz_variance = narrow(m.position_horizontal_variance);
  w.pos_vert_variance = narrow(m.position_vertical_variance);
  w.compass_variance = narrow(m.compass_variance);
  w.terrain_alt_variance = narrow(m.terrain_alt_variance);
  pack(w, frame);
}

void write(EstimatorStatus const& m, Frame& frame) {
  ESTIMATOR_STATUS w{};
  w.flags = m.flags;
  w.vel_ratio = narrow(m.velocity_ratio);
  w.pos_horiz_ratio = narrow(m.position_horizontal_ratio);
  w.pos_vert_ratio = narrow(m.position_vertical_ratio);
  w.pos_horiz_accuracy = narrow(m.position_horizontal_accuracy_m);
  w.pos_vert_accuracy = narrow(m.position_vertical_accuracy_m);
  pack(w, frame);
}

void write(ExtendedSysState const& m, Frame& frame) {
  EXTENDED_SYS_STATE w{};
  w.vtol_state = static_cast<std::uint8_t>(m.vtol_state);
  w.landed_state = static_cast<std::uint8_t>(m.landed_state);
  pack(w, frame);
}

void write(StatusText const& m, Frame& frame) {
  STATUSTEXT w{};
  w.severity = static_cast<std::uint8_t>(m.severity);
  w.text = text_field<50>(m.text);
  w.id = m.id;
  w.chunk_seq = m.chunk_seq;
  pack(w, frame);
}

void write(FenceStatus const& m, Frame& frame) {
  FENCE_STATUS w{};
  w.breach_status = m.breached ? 1 : 0;
  w.breach_count = m.breach_count;
  w.breach_type = m.breach_type;
  w.breach_time = boot_ms(m.breach_time);
  pack(w, frame);
}

void write(RadioStatus const& m, Frame& frame) {
  RADIO_STATUS w{};
  w.rssi = m.rssi.value_or(unknown8);
  w.remrssi = m.remote_rssi.value_or(unknown8);
  w.txbuf = rounded_or(unknown8, m.transmit_buffer_free, centi);
  w.noise = m.noise.value_or(unknown8);
  w.remnoise = m.remote_noise.value_or(unknown8);
  w.rxerrors = m.receive_errors;
  w.fixed = m.corrected;
  pack(w, frame);
}

}  // namespace lapwing::mavlink::internal
