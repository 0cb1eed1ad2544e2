// Remote control, cameras, gimbals, and a vehicle's own list of its modes.
#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/intake.hpp"
#include "mavlink/wire/wire.hpp"

#include <ardupilotmega/mavlink_msg_mount_status.hpp>
#include <common/mavlink_msg_camera_image_captured.hpp>
#include <common/mavlink_msg_camera_information.hpp>
#include <common/mavlink_msg_camera_trigger.hpp>
#include <common/mavlink_msg_gimbal_device_attitude_status.hpp>
#include <common/mavlink_msg_gimbal_manager_information.hpp>
#include <common/mavlink_msg_rc_channels.hpp>
#include <common/mavlink_msg_wind_cov.hpp>
#include <development/mavlink_msg_available_modes.hpp>
#include <development/mavlink_msg_available_modes_monitor.hpp>
#include <development/mavlink_msg_current_mode.hpp>

namespace lapwing::mavlink::internal {

using namespace ::mavlink::common::msg;
using ::mavlink::ardupilotmega::msg::MOUNT_STATUS;
using ::mavlink::development::msg::AVAILABLE_MODES;
using ::mavlink::development::msg::AVAILABLE_MODES_MONITOR;
using ::mavlink::development::msg::CURRENT_MODE;

namespace {

auto constexpr unknown8 = std::numeric_limits<std::uint8_t>::max();
auto constexpr centidegree = degree * centi;
auto constexpr rssi_step = 1.0 / 254.0;
auto constexpr no_rotation = std::array{not_a_number, not_a_number, not_a_number, not_a_number};
auto constexpr no_pulse = std::numeric_limits<std::uint16_t>::max();

/// The standard keeps the names of cameras in bytes.
std::string name_in(std::array<std::uint8_t, 32> const& field) {
  auto const end = std::ranges::find(field, 0);
  return base::printable({field.begin(), end});
}
std::array<std::uint8_t, 32> name_field(std::string_view name) {
  std::array<std::uint8_t, 32> field{};
  std::copy_n(name.data(), std::min(field.size(), name.size()), field.data());
  return field;
}

WindCov read(WIND_COV const& w, Intake& in) {
  return {.time = microseconds(w.time_usec),
          .north_m_s = in("wind_x", limit::wind_m_s, w.wind_x),
          .east_m_s = in("wind_y", limit::wind_m_s, w.wind_y),
          .down_m_s = in("wind_z", limit::wind_m_s, w.wind_z)};
}

RcChannels read(RC_CHANNELS const& w) {
  std::uint16_t const fields[] = {w.chan1_raw,  w.chan2_raw,  w.chan3_raw,  w.chan4_raw,  w.chan5_raw,  w.chan6_raw,
                                  w.chan7_raw,  w.chan8_raw,  w.chan9_raw,  w.chan10_raw, w.chan11_raw, w.chan12_raw,
                                  w.chan13_raw, w.chan14_raw, w.chan15_raw, w.chan16_raw, w.chan17_raw, w.chan18_raw};
  RcChannels m{.since_boot = since_boot(w.time_boot_ms),
               .count = w.chancount,
               .pulses_us = {},
               .rssi = unless(unknown8, w.rssi, rssi_step)};
  for (std::size_t i = 0; i < m.pulses_us.size(); ++i)
    if (fields[i] != no_pulse) m.pulses_us[i] = fields[i];
  return m;
}

CameraTrigger read(CAMERA_TRIGGER const& w) {
  return {.time = microseconds(w.time_usec), .seq = w.seq};
}

CameraImageCaptured read(CAMERA_IMAGE_CAPTURED const& w, Intake& in) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .utc = in.utc("time_utc", w.time_utc),
          .camera = w.camera_id,
          .position = in.place({"lat", "lon", "alt"}, w.lat, w.lon, w.alt),
          .relative_alt_m = in("relative_alt", limit::altitude_m, unless(unknown32, w.relative_alt, milli)),
          .orientation = in.rotation("q", w.q),
          .image = w.image_index,
          .captured = w.capture_result == 1,
          .file_url = text(w.file_url)};
}

CameraInformation read(CAMERA_INFORMATION const& w) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .vendor = name_in(w.vendor_name),
          .model = name_in(w.model_name),
          .firmware_version = w.firmware_version,
          .width_px = w.resolution_h,
          .height_px = w.resolution_v,
          .flags = w.flags,
          .gimbal_device = w.gimbal_device_id,
          .camera = w.camera_device_id};
}

GimbalManagerInformation read(GIMBAL_MANAGER_INFORMATION const& w, Intake& in) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .capabilities = w.cap_flags,
          .gimbal_device = w.gimbal_device_id,
          .roll_min_rad = in("roll_min", limit::angle_rad, w.roll_min),
          .roll_max_rad = in("roll_max", limit::angle_rad, w.roll_max),
          .pitch_min_rad = in("pitch_min", limit::angle_rad, w.pitch_min),
          .pitch_max_rad = in("pitch_max", limit::angle_rad, w.pitch_max),
          .yaw_min_rad = in("yaw_min", limit::angle_rad, w.yaw_min),
          .yaw_max_rad = in("yaw_max", limit::angle_rad, w.yaw_max)};
}

GimbalDeviceAttitudeStatus read(GIMBAL_DEVICE_ATTITUDE_STATUS const& w, Intake& in) {
  return {.target = target(w),
          .since_boot = since_boot(w.time_boot_ms),
          .flags = w.flags,
          .orientation = in.rotation("q", w.q),
          .failures = w.failure_flags,
          .delta_yaw_rad = in("delta_yaw", limit::angle_rad, w.delta_yaw),
          .gimbal_device = w.gimbal_device_id};
}

MountStatus read(MOUNT_STATUS const& w, Intake& in) {
  return {.target = target(w),
          .pitch_rad = in("pointing_a", limit::angle_rad, unless(unknown32, w.pointing_a, centidegree)),
          .roll_rad = in("pointing_b", limit::angle_rad, unless(unknown32, w.pointing_b, centidegree)),
          .yaw_rad = in("pointing_c", limit::angle_rad, unless(unknown32, w.pointing_c, centidegree)),
          .mode = w.mount_mode};
}

AvailableModes read(AVAILABLE_MODES const& w) {
  return {.count = w.number_modes,
          .index = w.mode_index,
          .standard_mode = w.standard_mode,
          .custom_mode = w.custom_mode,
          .properties = w.properties,
          .name = text(w.mode_name)};
}

CurrentMode read(CURRENT_MODE const& w) {
  return {
      .standard_mode = w.standard_mode, .custom_mode = w.custom_mode, .intended_custom_mode = w.intended_custom_mode};
}

AvailableModesMonitor read(AVAILABLE_MODES_MONITOR const& w) {
  return {.seq = w.seq};
}

}  // namespace

std::optional<Message> read_payload(Frame const& frame, Intake& in) {
  switch (frame.message_id) {
    case WIND_COV::MSG_ID: return read(unpack<WIND_COV>(frame), in);
    case RC_CHANNELS::MSG_ID: return read(unpack<RC_CHANNELS>(frame));
    case CAMERA_TRIGGER::MSG_ID: return read(unpack<CAMERA_TRIGGER>(frame));
    case CAMERA_IMAGE_CAPTURED::MSG_ID: return read(unpack<CAMERA_IMAGE_CAPTURED>(frame), in);
    case CAMERA_INFORMATION::MSG_ID: return read(unpack<CAMERA_INFORMATION>(frame));
    case GIMBAL_MANAGER_INFORMATION::MSG_ID: return read(unpack<GIMBAL_MANAGER_INFORMATION>(frame), in);
    case GIMBAL_DEVICE_ATTITUDE_STATUS::MSG_ID: return read(unpack<GIMBAL_DEVICE_ATTITUDE_STATUS>(frame), in);
    case MOUNT_STATUS::MSG_ID: return read(unpack<MOUNT_STATUS>(frame), in);
    case AVAILABLE_MODES::MSG_ID: return read(unpack<AVAILABLE_MODES>(frame));
    case CURRENT_MODE::MSG_ID: return read(unpack<CURRENT_MODE>(frame));
    case AVAILABLE_MODES_MONITOR::MSG_ID: return read(unpack<AVAILABLE_MODES_MONITOR>(frame));
    default: return std::nullopt;
  }
}

void write(WindCov const& m, Frame& frame) {
  WIND_COV w{};
  w.time_usec = microsecond_count(m.time);
  w.wind_x = narrow(m.north_m_s);
  w.wind_y = narrow(m.east_m_s);
  w.wind_z = narrow(m.down_m_s);
  w.var_horiz = w.var_vert = w.wind_alt = not_a_number;
  pack(w, frame);
}

void write(RcChannels const& m, Frame& frame) {
  RC_CHANNELS w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  w.chancount = m.count;
  std::uint16_t* const fields[] = {&w.chan1_raw,  &w.chan2_raw,  &w.chan3_raw,  &w.chan4_raw,  &w.chan5_raw,
                                   &w.chan6_raw,  &w.chan7_raw,  &w.chan8_raw,  &w.chan9_raw,  &w.chan10_raw,
                                   &w.chan11_raw, &w.chan12_raw, &w.chan13_raw, &w.chan14_raw, &w.chan15_raw,
                                   &w.chan16_raw, &w.chan17_raw, &w.chan18_raw};
  for (std::size_t i = 0; i < m.pulses_us.size(); ++i) *fields[i] = m.pulses_us[i].value_or(no_pulse);
  w.rssi = rounded_or(unknown8, m.rssi, rssi_step);
  pack(w, frame);
}

void write(CameraTrigger const& m, Frame& frame) {
  CAMERA_TRIGGER w{};
  w.time_usec = microsecond_count(m.time);
  w.seq = m.seq;
  pack(w, frame);
}

void write(CameraImageCaptured const& m, Frame& frame) {
  CAMERA_IMAGE_CAPTURED w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  w.time_utc = m.utc ? microsecond_count(*m.utc) : 0;
  w.camera_id = m.camera;
  put_place(m.position, w.lat, w.lon, w.alt);
  w.relative_alt = rounded_or(unknown32, m.relative_alt_m, milli);
  w.q = m.orientation.value_or(no_rotation);
  w.image_index = m.image;
  w.capture_result = m.captured ? 1 : 0;
  w.file_url = text_field<205>(m.file_url);
  pack(w, frame);
}

void write(CameraInformation const& m, Frame& frame) {
  CAMERA_INFORMATION w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  w.vendor_name = name_field(m.vendor);
  w.model_name = name_field(m.model);
  w.firmware_version = m.firmware_version;
  w.resolution_h = m.width_px;
  w.resolution_v = m.height_px;
  w.flags = m.flags;
  w.gimbal_device_id = m.gimbal_device;
  w.camera_device_id = m.camera;
  pack(w, frame);
}

void write(GimbalManagerInformation const& m, Frame& frame) {
  GIMBAL_MANAGER_INFORMATION w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  w.cap_flags = m.capabilities;
  w.gimbal_device_id = m.gimbal_device;
  w.roll_min = narrow(m.roll_min_rad);
  w.roll_max = narrow(m.roll_max_rad);
  w.pitch_min = narrow(m.pitch_min_rad);
  w.pitch_max = narrow(m.pitch_max_rad);
  w.yaw_min = narrow(m.yaw_min_rad);
  w.yaw_max = narrow(m.yaw_max_rad);
  pack(w, frame);
}

void write(GimbalDeviceAttitudeStatus const& m, Frame& frame) {
  GIMBAL_DEVICE_ATTITUDE_STATUS w{};
  put_target(w, m.target);
  w.time_boot_ms = boot_ms(m.since_boot);
  w.flags = m.flags;
  w.q = m.orientation.value_or(no_rotation);
  w.angular_velocity_x = w.angular_velocity_y = w.angular_velocity_z = not_a_number;
  w.failure_flags = m.failures;
  w.delta_yaw = narrow(m.delta_yaw_rad);
  w.delta_yaw_velocity = not_a_number;
  w.gimbal_device_id = m.gimbal_device;
  pack(w, frame);
}

void write(MountStatus const& m, Frame& frame) {
  MOUNT_STATUS w{};
  put_target(w, m.target);
  w.pointing_a = rounded_or(unknown32, m.pitch_rad, centidegree);
  w.pointing_b = rounded_or(unknown32, m.roll_rad, centidegree);
  w.pointing_c = rounded_or(unknown32, m.yaw_rad, centidegree);
  w.mount_mode = m.mode;
  pack(w, frame);
}

void write(AvailableModes const& m, Frame& frame) {
  AVAILABLE_MODES w{};
  w.number_modes = m.count;
  w.mode_index = m.index;
  w.standard_mode = m.standard_mode;
  w.custom_mode = m.custom_mode;
  w.properties = m.properties;
  w.mode_name = text_field<std::tuple_size_v<decltype(w.mode_name)>>(m.name);
  pack(w, frame);
}

void write(CurrentMode const& m, Frame& frame) {
  CURRENT_MODE w{};
  w.standard_mode = m.standard_mode;
  w.custom_mode = m.custom_mode;
  w.intended_custom_mode = m.intended_custom_mode;
  pack(w, frame);
}

void write(AvailableModesMonitor const& m, Frame& frame) {
  AVAILABLE_MODES_MONITOR w{};
  w.seq = m.seq;
  pack(w, frame);
}

}  // namespace lapwing::mavlink::internal
