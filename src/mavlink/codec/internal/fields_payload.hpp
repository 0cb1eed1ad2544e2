#pragma once

#include "mavlink/codec/internal/fields.hpp"

/// Remote control, cameras, gimbals, and a vehicle's own list of its modes.
namespace lapwing::mavlink::internal {

template <class M = RcChannels, class W = dialect::RC_CHANNELS>
inline constexpr auto rc_channels = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::count, &W::chancount>(),
    list<&M::pulses_us, &W::chan1_raw, &W::chan2_raw, &W::chan3_raw, &W::chan4_raw, &W::chan5_raw, &W::chan6_raw,
         &W::chan7_raw, &W::chan8_raw, &W::chan9_raw, &W::chan10_raw, &W::chan11_raw, &W::chan12_raw, &W::chan13_raw,
         &W::chan14_raw, &W::chan15_raw, &W::chan16_raw, &W::chan17_raw, &W::chan18_raw>,
    field<&M::rssi, &W::rssi>(limit::fraction, 1.0 / 254.0),
});

template <class M = CameraTrigger, class W = dialect::CAMERA_TRIGGER>
inline constexpr auto camera_trigger = layout<M, W>(std::tuple{
    field<&M::time, &W::time_usec>(),
    field<&M::seq, &W::seq>(),
});

/// 1, 0 for a failure, -1 for a picture that was left out.
struct CaptureResult {
  static void read(bool& si, std::int8_t wire, std::string_view, Intake&) { si = wire == 1; }
  static void write(std::int8_t& wire, bool si) { wire = si ? 1 : 0; }
};

template <class M = CameraImageCaptured, class W = dialect::CAMERA_IMAGE_CAPTURED>
inline constexpr auto camera_image_captured = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::utc, &W::time_utc>(utc),
    field<&M::camera, &W::camera_id>(),
    place<&M::position, &W::lat, &W::lon, &W::alt>,
    field<&M::relative_alt_m, &W::relative_alt>(limit::altitude_m, milli),
    field<&M::orientation, &W::q>(rotation),
    field<&M::image, &W::image_index>(),
    field<&M::captured, &W::capture_result>(CaptureResult{}),
    field<&M::file_url, &W::file_url>(),
});

template <class M = CameraInformation, class W = dialect::CAMERA_INFORMATION>
inline constexpr auto camera_information = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::vendor, &W::vendor_name>(),
    field<&M::model, &W::model_name>(),
    field<&M::firmware_version, &W::firmware_version>(),
    field<&M::width_px, &W::resolution_h>(),
    field<&M::height_px, &W::resolution_v>(),
    field<&M::flags, &W::flags>(),
    field<&M::gimbal_device, &W::gimbal_device_id>(),
    field<&M::camera, &W::camera_device_id>(),
});

template <class M = GimbalManagerInformation, class W = dialect::GIMBAL_MANAGER_INFORMATION>
inline constexpr auto gimbal_manager_information = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::capabilities, &W::cap_flags>(),
    field<&M::gimbal_device, &W::gimbal_device_id>(),
    field<&M::roll_min_rad, &W::roll_min>(limit::angle_rad),
    field<&M::roll_max_rad, &W::roll_max>(limit::angle_rad),
    field<&M::pitch_min_rad, &W::pitch_min>(limit::angle_rad),
    field<&M::pitch_max_rad, &W::pitch_max>(limit::angle_rad),
    field<&M::yaw_min_rad, &W::yaw_min>(limit::angle_rad),
    field<&M::yaw_max_rad, &W::yaw_max>(limit::angle_rad),
});

template <class M = GimbalDeviceAttitudeStatus, class W = dialect::GIMBAL_DEVICE_ATTITUDE_STATUS>
inline constexpr auto gimbal_device_attitude_status = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::flags, &W::flags>(),
    field<&M::orientation, &W::q>(rotation),
    field<&M::failures, &W::failure_flags>(),
    field<&M::delta_yaw_rad, &W::delta_yaw>(limit::angle_rad),
    field<&M::gimbal_device, &W::gimbal_device_id>(),
    not_told<&W::angular_velocity_x, &W::angular_velocity_y, &W::angular_velocity_z, &W::delta_yaw_velocity>,
});

template <class M = MountStatus, class W = dialect::MOUNT_STATUS>
inline constexpr auto mount_status = layout<M, W>(std::tuple{
    field<&M::pitch_rad, &W::pointing_a>(limit::angle_rad, centidegree),
    field<&M::roll_rad, &W::pointing_b>(limit::angle_rad, centidegree),
    field<&M::yaw_rad, &W::pointing_c>(limit::angle_rad, centidegree),
    field<&M::mode, &W::mount_mode>(),
});

template <class M = AvailableModes, class W = dialect::AVAILABLE_MODES>
inline constexpr auto available_modes = layout<M, W>(std::tuple{
    field<&M::count, &W::number_modes>(),
    field<&M::index, &W::mode_index>(),
    field<&M::standard_mode, &W::standard_mode>(),
    field<&M::custom_mode, &W::custom_mode>(),
    field<&M::properties, &W::properties>(),
    field<&M::name, &W::mode_name>(),
});

template <class M = CurrentMode, class W = dialect::CURRENT_MODE>
inline constexpr auto current_mode = layout<M, W>(std::tuple{
    field<&M::standard_mode, &W::standard_mode>(),
    field<&M::custom_mode, &W::custom_mode>(),
    field<&M::intended_custom_mode, &W::intended_custom_mode>(),
});

template <class M = AvailableModesMonitor, class W = dialect::AVAILABLE_MODES_MONITOR>
inline constexpr auto available_modes_monitor = layout<M, W>(std::tuple{field<&M::seq, &W::seq>()});

using PayloadLayouts = Layouts<rc_channels<>, camera_trigger<>, camera_image_captured<>, camera_information<>,
                               gimbal_manager_information<>, gimbal_device_attitude_status<>, mount_status<>,
                               available_modes<>, current_mode<>, available_modes_monitor<>>;

}  // namespace lapwing::mavlink::internal
