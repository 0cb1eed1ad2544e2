#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/enums.hpp"

/// The messages of remote controls, cameras, gimbals and mode lists: the part of messages.hpp (units, frames and
/// unknowns are told there) that is about what a vehicle carries.
namespace lapwing::mavlink {

using base::Duration;

// ---- people and payload

struct RcChannels {
  Duration since_boot{};
  std::uint8_t count = 0;  ///< 0: no receiver, or nothing is received; may be more than are told
  std::array<std::optional<std::uint16_t>, 18> pulses_us{};
  std::optional<double> rssi{};  ///< 0..1 of the receiver's own scale
};

/// A camera was told to take a picture.
struct CameraTrigger {
  std::chrono::microseconds time{};
  std::uint32_t seq = 0;
};

struct CameraImageCaptured {
  Duration since_boot{};
  std::optional<std::chrono::microseconds> utc{};
  std::uint8_t camera = 0;
  std::optional<geo::Wgs84> position{};
  std::optional<double> relative_alt_m{};
  std::optional<std::array<float, 4>> orientation{};  ///< quaternion w, x, y, z
  std::int32_t image = 0;                             ///< counts from 0
  bool captured = false;
  std::string file_url{};
};

struct CameraInformation {
  Duration since_boot{};
  std::string vendor{};
  std::string model{};
  std::uint32_t firmware_version = 0;
  std::uint16_t width_px = 0;  ///< 0 when not known
  std::uint16_t height_px = 0;
  std::uint32_t flags = 0;  ///< CAMERA_CAP_FLAGS
  std::uint8_t gimbal_device = 0;
  std::uint8_t camera = 0;  ///< 1..6 when an autopilot speaks for it
};

struct GimbalManagerInformation {
  Duration since_boot{};
  std::uint32_t capabilities = 0;  ///< GIMBAL_MANAGER_CAP_FLAGS
  std::uint8_t gimbal_device = 0;  ///< component, or 1..6 when the manager is the device
  std::optional<double> roll_min_rad{};
  std::optional<double> roll_max_rad{};
  std::optional<double> pitch_min_rad{};  ///< negative is down
  std::optional<double> pitch_max_rad{};
  std::optional<double> yaw_min_rad{};
  std::optional<double> yaw_max_rad{};
};

struct GimbalDeviceAttitudeStatus {
  Address target{};
  Duration since_boot{};
  std::uint16_t flags = 0;  ///< bits of gimbal_flag
  /// Quaternion w, x, y, z; yaw from north or from the vehicle's nose by `flags`.
  std::optional<std::array<float, 4>> orientation{};
  std::uint32_t failures = 0;
  std::optional<double> delta_yaw_rad{};  ///< from the vehicle's frame to the earth's
  std::uint8_t gimbal_device = 0;
};

/// What ArduPilot sent before there were gimbal managers. Angles relative to the vehicle.
struct MountStatus {
  Address target{};
  std::optional<double> pitch_rad{};
  std::optional<double> roll_rad{};
  std::optional<double> yaw_rad{};
  std::uint8_t mode = 0;
};

// ---- the vehicle's own list of its modes (development dialect)

struct AvailableModes {
  std::uint8_t count = 0;
  std::uint8_t index = 0;  ///< from 1
  std::uint8_t standard_mode = 0;
  std::uint32_t custom_mode = 0;
  std::uint32_t properties = 0;
  std::string name{};
};

struct CurrentMode {
  std::uint8_t standard_mode = 0;
  std::uint32_t custom_mode = 0;
  std::uint32_t intended_custom_mode = 0;
};

/// Its number changes when the list does.
struct AvailableModesMonitor {
  std::uint8_t seq = 0;
};

}  // namespace lapwing::mavlink
