#pragma once

#include "mavlink/codec/internal/fields.hpp"

/// Identity, time and health.
namespace lapwing::mavlink::internal {

template <class M = Heartbeat, class W = dialect::HEARTBEAT>
inline constexpr auto heartbeat = layout<M, W>(std::tuple{
    field<&M::type, &W::type>(),
    field<&M::autopilot, &W::autopilot>(),
    field<&M::base_mode, &W::base_mode>(),
    field<&M::custom_mode, &W::custom_mode>(),
    field<&M::system_status, &W::system_status>(),
    field<&M::mavlink_version, &W::mavlink_version>(),
});

template <class M = SystemTime, class W = dialect::SYSTEM_TIME>
inline constexpr auto system_time = layout<M, W>(std::tuple{
    field<&M::utc, &W::time_unix_usec>(utc),
    field<&M::since_boot, &W::time_boot_ms>(),
});

template <class M = Ping, class W = dialect::PING>
inline constexpr auto ping = layout<M, W>(std::tuple{field<&M::time, &W::time_usec>(), field<&M::seq, &W::seq>()});

template <class M = Timesync, class W = dialect::TIMESYNC>
inline constexpr auto timesync = layout<M, W>(std::tuple{field<&M::tc1, &W::tc1>(), field<&M::ts1, &W::ts1>()});

template <class M = AutopilotVersion, class W = dialect::AUTOPILOT_VERSION>
inline constexpr auto autopilot_version = layout<M, W>(std::tuple{
    field<&M::capabilities, &W::capabilities>(),
    field<&M::flight_sw_version, &W::flight_sw_version>(),
    field<&M::board_version, &W::board_version>(),
    field<&M::vendor_id, &W::vendor_id>(),
    field<&M::product_id, &W::product_id>(),
    field<&M::uid, &W::uid>(),
    field<&M::flight_custom_version, &W::flight_custom_version>(),
    field<&M::uid2, &W::uid2>(),
});

template <class M = SysStatus, class W = dialect::SYS_STATUS>
inline constexpr auto sys_status = layout<M, W>(std::tuple{
    field<&M::sensors_present, &W::onboard_control_sensors_present>(),
    field<&M::sensors_enabled, &W::onboard_control_sensors_enabled>(),
    field<&M::sensors_health, &W::onboard_control_sensors_health>(),
    field<&M::load, &W::load>(limit::load, milli),
    field<&M::battery_voltage_v, &W::voltage_battery>(limit::voltage_v, milli),
    field<&M::battery_current_a, &W::current_battery>(limit::current_a, centi, -1),
    field<&M::battery_remaining, &W::battery_remaining>(limit::fraction, centi, -1),
    field<&M::drop_rate_comm, &W::drop_rate_comm>(limit::fraction, 1e-4),
    field<&M::errors_comm, &W::errors_comm>(),
});

/// Cells that are not there are UINT16_MAX, further ones (added to the protocol later) 0. A pack whose cells are not
/// measured comes as one cell, or as several when the voltage exceeds one field.
inline constexpr auto pack_voltage =
    Both{[](BatteryStatus& m, dialect::BATTERY_STATUS const& w, Intake& in) {
           if (w.voltages[0] == unknown16) return;
           double sum_mv = 0.0;
           for (auto const cell : w.voltages) sum_mv += cell == unknown16 ? 0 : cell;
           for (auto const cell : w.voltages_ext) sum_mv += cell == unknown16 ? 0 : cell;
           m.voltage_v = in("voltages", limit::voltage_v, sum_mv * milli);
         },
         [](BatteryStatus const& m, dialect::BATTERY_STATUS& w) {
           w.voltages.fill(unknown16);
           if (!m.voltage_v) return;
           auto rest = rounded<std::uint32_t>(*m.voltage_v / milli);
           for (auto& cell : w.voltages) {
             cell = static_cast<std::uint16_t>(std::min<std::uint32_t>(rest, unknown16 - 1U));
             rest -= cell;
             if (rest == 0) return;
           }
         }};

/// 0: the battery does not say.
struct SecondsLeft {
  using Seconds = std::optional<std::chrono::seconds>;
  static void read(Seconds& si, std::int32_t wire, std::string_view name, Intake& in) {
    if (wire != 0 && in(name, limit::remaining_s, wire)) si = std::chrono::seconds(wire);
  }
  static void write(std::int32_t& wire, Seconds si) { wire = si ? static_cast<std::int32_t>(si->count()) : 0; }
};

template <class M = BatteryStatus, class W = dialect::BATTERY_STATUS>
inline constexpr auto battery_status = layout<M, W>(std::tuple{
    field<&M::id, &W::id>(),
    pack_voltage,
    field<&M::current_a, &W::current_battery>(limit::current_a, centi, -1),
    field<&M::consumed_ah, &W::current_consumed>(limit::charge_ah, milli, -1),
    field<&M::energy_consumed_j, &W::energy_consumed>(limit::energy_j, 100.0, -1),
    field<&M::remaining, &W::battery_remaining>(limit::fraction, centi, -1),
    field<&M::temperature_c, &W::temperature>(limit::temperature_c, centi),
    field<&M::time_remaining, &W::time_remaining>(SecondsLeft{}),
    field<&M::charge_state, &W::charge_state>(),
});

template <class M = EkfStatusReport, class W = dialect::EKF_STATUS_REPORT>
inline constexpr auto ekf_status_report = layout<M, W>(std::tuple{
    field<&M::flags, &W::flags>(),
    field<&M::velocity_variance, &W::velocity_variance>(limit::test_ratio),
    field<&M::position_horizontal_variance, &W::pos_horiz_variance>(limit::test_ratio),
    field<&M::position_vertical_variance, &W::pos_vert_variance>(limit::test_ratio),
    field<&M::compass_variance, &W::compass_variance>(limit::test_ratio),
    field<&M::terrain_alt_variance, &W::terrain_alt_variance>(limit::test_ratio),
});

template <class M = EstimatorStatus, class W = dialect::ESTIMATOR_STATUS>
inline constexpr auto estimator_status = layout<M, W>(std::tuple{
    field<&M::flags, &W::flags>(),
    field<&M::velocity_ratio, &W::vel_ratio>(limit::test_ratio),
    field<&M::position_horizontal_ratio, &W::pos_horiz_ratio>(limit::test_ratio),
    field<&M::position_vertical_ratio, &W::pos_vert_ratio>(limit::test_ratio),
    field<&M::position_horizontal_accuracy_m, &W::pos_horiz_accuracy>(limit::accuracy_m),
    field<&M::position_vertical_accuracy_m, &W::pos_vert_accuracy>(limit::accuracy_m),
});

template <class M = ExtendedSysState, class W = dialect::EXTENDED_SYS_STATE>
inline constexpr auto extended_sys_state = layout<M, W>(std::tuple{
    field<&M::vtol_state, &W::vtol_state>(),
    field<&M::landed_state, &W::landed_state>(),
});

template <class M = StatusText, class W = dialect::STATUSTEXT>
inline constexpr auto status_text = layout<M, W>(std::tuple{
    field<&M::severity, &W::severity>(),
    field<&M::text, &W::text>(),
    field<&M::id, &W::id>(),
    field<&M::chunk_seq, &W::chunk_seq>(),
});

template <class M = FenceStatus, class W = dialect::FENCE_STATUS>
inline constexpr auto fence_status = layout<M, W>(std::tuple{
    field<&M::breached, &W::breach_status>(),
    field<&M::breach_count, &W::breach_count>(),
    field<&M::breach_type, &W::breach_type>(),
    field<&M::breach_time, &W::breach_time>(),
});

template <class M = RadioStatus, class W = dialect::RADIO_STATUS>
inline constexpr auto radio_status = layout<M, W>(std::tuple{
    field<&M::rssi, &W::rssi>(),
    field<&M::remote_rssi, &W::remrssi>(),
    field<&M::transmit_buffer_free, &W::txbuf>(limit::fraction, centi),
    field<&M::noise, &W::noise>(),
    field<&M::remote_noise, &W::remnoise>(),
    field<&M::receive_errors, &W::rxerrors>(),
    field<&M::corrected, &W::fixed>(),
});

using StateLayouts = Layouts<heartbeat<>, system_time<>, ping<>, timesync<>, autopilot_version<>, sys_status<>,
                             battery_status<>, ekf_status_report<>, estimator_status<>, extended_sys_state<>,
                             status_text<>, fence_status<>, radio_status<>>;

}  // namespace lapwing::mavlink::internal
