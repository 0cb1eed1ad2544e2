#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "firmware/board_time.hpp"
#include "firmware/frames/description.hpp"

namespace lapwing::firmware {

// What goes over the line, in SI units and radians. docs/reference/robot-serial.md has the bytes.
// Headings are relative to the way the robot faced when the board started, positive to the left.

/// A command's name, from one on; what is about none says zero.
using CommandNumber = std::uint16_t;

// ---- from the board ----

/// At the board's start and as the answer to `Hail`.
struct Hello {
  Time time{};
  Description description;
  friend bool operator==(Hello const&, Hello const&) = default;
};

struct Vector3 {
  float x = 0;
  float y = 0;
  float z = 0;
  friend bool operator==(Vector3 const&, Vector3 const&) = default;
};

/// Of unit length; turns what is said in the body's frame into the frame whose z is up. Its yaw drifts.
struct Quaternion {
  float w = 1;
  float x = 0;
  float y = 0;
  float z = 0;
  friend bool operator==(Quaternion const&, Quaternion const&) = default;
};

struct Imu {
  Quaternion orientation;
  Vector3 rate_rad_s;         ///< mean since the last readings
  Vector3 acceleration_m_s2;  ///< mean since the last readings; at rest +9.8 upwards
  friend bool operator==(Imu const&, Imu const&) = default;
};

/// What holds now. Each is a bit of `Readings::flags`.
enum class Flag : std::uint16_t {
  killed = 1U << 0U,           ///< stands until it is released
  too_near = 1U << 1U,         ///< the safe distance rules, not the command
  watchdog = 1U << 2U,         ///< nobody was heard for too long: the last command was dropped
  left_wheel_dead = 1U << 3U,  ///< driven, and no pulse came: the last command was dropped
  right_wheel_dead = 1U << 4U,
  imu_silent = 1U << 5U,  ///< no sample for too long: the last command was dropped if it was about a heading
  slipping = 1U << 6U,    ///< the wheels turn the body otherwise than it turns
};

[[nodiscard]] constexpr std::uint16_t bit(Flag flag) {
  return static_cast<std::uint16_t>(flag);
}

std::uint16_t constexpr no_echo_us = 0;

struct Readings {
  Time time{};
  std::int32_t left_pulses = 0;  ///< since the board's start, ahead is positive; wraps
  std::int32_t right_pulses = 0;
  std::optional<Imu> imu;
  std::uint8_t sonar_count = 0;
  std::array<std::uint16_t, most_sonars> echoes_us{};  ///< `no_echo_us`: none
  std::uint16_t battery_mv = 0;                        ///< zero: not known
  std::optional<std::uint8_t> battery_percent;
  std::uint16_t flags = 0;
  CommandNumber command = 0;              ///< the one that is carried out; zero: none, it stands
  CommandNumber completed = 0;            ///< the last one that was completed
  std::int16_t left_output_permille = 0;  ///< of the motors' full voltage
  std::int16_t right_output_permille = 0;

  [[nodiscard]] bool has(Flag flag) const { return (flags & bit(flag)) != 0; }
  [[nodiscard]] std::span<std::uint16_t const> echoes() const { return std::span(echoes_us).first(sonar_count); }
  friend bool operator==(Readings const&, Readings const&) = default;
};

std::size_t constexpr most_piece_ranges = 100;

/// A part of one scan. All pieces of a scan have its time, which is the first beam's.
struct LaserPiece {
  Time time{};
  float first_angle_rad = 0;  ///< of the whole scan
  float step_rad = 0;
  std::uint16_t beams = 0;  ///< of the whole scan
  std::uint16_t begin = 0;  ///< which beam is this piece's first
  std::uint8_t count = 0;
  std::array<std::uint16_t, most_piece_ranges> ranges_mm{};  ///< zero: nothing was seen

  [[nodiscard]] std::span<std::uint16_t const> ranges() const { return std::span(ranges_mm).first(count); }
  friend bool operator==(LaserPiece const&, LaserPiece const&) = default;
};

/// Heading and speed are as the command asked for. It goes on being carried out.
struct Completed {
  CommandNumber number = 0;
  friend bool operator==(Completed const&, Completed const&) = default;
};

/// What happened. The numbers are for good; docs/reference/robot-serial.md says what each means.
enum class LogCode : std::uint16_t {
  started = 1,
  killed = 10,
  released = 11,
  watchdog = 12,
  too_near = 13,
  far_enough = 14,
  no_way_back = 15,
  left_wheel_dead = 20,
  right_wheel_dead = 21,
  imu_silent = 22,
  slipping = 23,
  battery_low = 24,
  refused = 30,         ///< value: the command's number
  damaged_frames = 31,  ///< value: how many since the start
  other_version = 32,   ///< value: the version that was heard
  unknown_frame = 33,   ///< value: its type
};

struct Log {
  Time time{};
  LogCode code{};
  std::int32_t value = 0;
  friend bool operator==(Log const&, Log const&) = default;
};

// ---- from the host ----

/// Asks for `Hello`.
struct Hail {
  friend bool operator==(Hail const&, Hail const&) = default;
};

/// Drive at a speed, negative backwards, and keep a heading or turn at a rate meanwhile.
struct Drive {
  enum class By : std::uint8_t { heading, rate };
  CommandNumber number = 0;
  float speed_m_s = 0;
  By by = By::heading;
  float turn = 0;  ///< heading in rad, or rate in rad/s
  friend bool operator==(Drive const&, Drive const&) = default;
};

/// Turn on the spot to a heading, the shorter way.
struct Turn {
  CommandNumber number = 0;
  float heading_rad = 0;
  friend bool operator==(Turn const&, Turn const&) = default;
};

/// Brake and stand.
struct Stop {
  CommandNumber number = 0;
  friend bool operator==(Stop const&, Stop const&) = default;
};

/// Wheels to zero at once, and nothing moves until `Release`.
struct Kill {
  friend bool operator==(Kill const&, Kill const&) = default;
};

/// Ends a kill; it stands until the next command.
struct Release {
  friend bool operator==(Release const&, Release const&) = default;
};

/// Who commands is there and means what was said last.
struct Alive {
  friend bool operator==(Alive const&, Alive const&) = default;
};

using FromBoard = std::variant<Hello, Readings, LaserPiece, Completed, Log>;
using FromHost = std::variant<Hail, Drive, Turn, Stop, Kill, Release, Alive>;

}  // namespace lapwing::firmware
