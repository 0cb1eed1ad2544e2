#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/board_time.hpp"
#include "firmware/frames/records.hpp"

namespace lapwing::firmware {

/// Turns of the wheels since the board started, in pulses; ahead is positive, wraps.
struct Pulses {
  std::int32_t left = 0;
  std::int32_t right = 0;
};

/// What the inertial unit says at one moment.
struct ImuSample {
  Quaternion orientation;
  Vector3 rate_rad_s;
  Vector3 acceleration_m_s2;  ///< specific force: at rest +9.8 upwards
};

struct Battery {
  std::uint16_t mv = 0;  ///< zero: not known
  std::optional<std::uint8_t> percent;
};

struct LaserScan {
  Time time{};                               ///< of the first beam
  std::span<std::uint16_t const> ranges_mm;  ///< as many as the description's beams; zero: nothing was seen
};

/// The hardware as the program needs it: a microcontroller's pins, or a simulated body.
///
/// Nothing here waits. What is borrowed stays until the next call of the same function that has something newer.
class Board {
 public:
  [[nodiscard]] virtual Pulses pulses() = 0;
  /// The newest sample; none when there was no new one since the last call.
  [[nodiscard]] virtual std::optional<ImuSample> imu() = 0;
  /// The newest echo of each sonar in the description's order, in microseconds of pulse width; `no_echo_us` for none.
  [[nodiscard]] virtual std::span<std::uint16_t const> echoes_us() = 0;
  /// A scan that was not given yet.
  [[nodiscard]] virtual std::optional<LaserScan> laser() = 0;
  [[nodiscard]] virtual Battery battery() = 0;

  /// The motors' voltages as fractions of the full one, -1 to 1; ahead is positive. Zero brakes.
  virtual void drive_wheels(float left, float right) = 0;

  /// Moves what arrived from the host into `into`; how many bytes.
  [[nodiscard]] virtual std::size_t receive(std::span<std::uint8_t> into) = 0;
  /// One frame to the host, whole; false when there is no room for it now, and then nothing was taken.
  virtual bool send(std::span<std::uint8_t const> frame) = 0;

 protected:
  // Not virtual: nobody owns a board by this interface, and a virtual one would call for `operator delete`.
  ~Board() = default;
};

}  // namespace lapwing::firmware
