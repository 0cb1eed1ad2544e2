#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "robot/watch/module.hpp"

namespace lapwing::robot {

enum class Severity : std::uint8_t {
  notice,    ///< somebody may like to know
  degraded,  ///< it goes on, less well
  critical,  ///< the robot must not move
};
[[nodiscard]] std::string_view to_string(Severity severity);

/// What an error code says, to whoever stands before the robot.
struct CodeEntry {
  std::uint16_t code;
  Module module;
  Severity severity;
  std::string_view meaning;
  std::string_view what_to_do;
};

namespace code {
std::uint16_t constexpr none = 0;
std::uint16_t constexpr imu_silent = 101;
std::uint16_t constexpr imu_faulty = 102;
std::uint16_t constexpr sonar_stuck = 103;
std::uint16_t constexpr sonar_jumping = 104;
std::uint16_t constexpr sonar_dropouts = 105;
std::uint16_t constexpr pulses_jump = 106;
std::uint16_t constexpr wheels_slip = 107;
std::uint16_t constexpr board_away = 201;
std::uint16_t constexpr board_version = 202;
std::uint16_t constexpr left_wheel_dead = 203;
std::uint16_t constexpr right_wheel_dead = 204;
std::uint16_t constexpr killed = 205;
std::uint16_t constexpr board_watchdog = 206;
std::uint16_t constexpr too_near = 207;
std::uint16_t constexpr battery_low = 208;
std::uint16_t constexpr line_damaged = 209;
std::uint16_t constexpr not_let_drive = 210;
std::uint16_t constexpr nobody_drives = 211;
std::uint16_t constexpr no_scans = 301;
std::uint16_t constexpr pose_lost = 302;
std::uint16_t constexpr mapping_slow = 303;
std::uint16_t constexpr map_not_saved = 304;
std::uint16_t constexpr no_way = 401;
std::uint16_t constexpr override_ended = 402;
std::uint16_t constexpr not_moving = 403;
std::uint16_t constexpr camera_silent = 501;
std::uint16_t constexpr pictures_blurred = 502;
std::uint16_t constexpr no_reader = 503;
std::uint16_t constexpr eyes_away = 504;
std::uint16_t constexpr operator_away = 601;
std::uint16_t constexpr store_away = 701;
std::uint16_t constexpr robot_unheard = 801;
}  // namespace code

/// All codes, in their order.
[[nodiscard]] std::span<CodeEntry const> code_table();
/// Null for a code that is none of the table: of a newer part, say.
[[nodiscard]] CodeEntry const* find_code(std::uint16_t code);
/// An unknown code is critical: what nobody knows may be anything.
[[nodiscard]] Severity severity_of(std::uint16_t code);
/// The table as the reference page has it (docs/reference/robot-errors.md), in Markdown.
[[nodiscard]] std::string code_page();

}  // namespace lapwing::robot
