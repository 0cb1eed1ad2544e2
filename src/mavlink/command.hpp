#pragma once

#include <array>
#include <functional>
#include <string>

#include "mavlink/connection.hpp"

namespace lapwing::mavlink {

/// A command by its seven parameters, in the units that the standard gives for it.
struct Command {
  MavCmd id{};
  std::array<float, 7> params{};
};

struct CommandOptions {
  int tries = 5;
  base::Duration ack_timeout = std::chrono::milliseconds(1500);
  /// After an IN_PROGRESS, how long until the next word about it.
  base::Duration progress_timeout = std::chrono::seconds(10);
  /// No try starts later than this: a late ARM must never arm.
  base::Duration expiry = std::chrono::seconds(10);
};

/// Sends the command until the vehicle acknowledges it, counting `confirmation` up. Succeeds when accepted. Errors:
/// refused (names command and result), timed_out, cancelled, and those of Connection::send. That it took effect shows
/// in the vehicle's state only.
base::Task<base::Result<>> run_command(Connection& connection, Address target, Command command,
                                       CommandOptions options = {});
/// The same as COMMAND_INT, for commands with a place.
base::Task<base::Result<>> run_command_int(Connection& connection, Address target, CommandInt command,
                                           CommandOptions options = {});

// ---- commands by name
// ----------------------------------------------------------------------------------------------------

[[nodiscard]] Command arm();
[[nodiscard]] Command disarm();
/// `custom_mode` by modes.hpp; PX4's main and sub mode are unpacked into parameters 2 and 3.
[[nodiscard]] Command set_mode(MavAutopilot autopilot, std::uint32_t custom_mode);
/// ArduPilot: to `height_m` above home, when in GUIDED, armed and on the ground.
[[nodiscard]] Command take_off(double height_m);
[[nodiscard]] Command start_mission();
[[nodiscard]] Command set_current_item(std::uint16_t seq);
[[nodiscard]] Command request_message(MessageId message);
[[nodiscard]] Command reboot_autopilot();
/// Ground speed in m/s.
[[nodiscard]] Command change_speed(double speed_m_s);
/// In frame global (AMSL).
[[nodiscard]] CommandInt set_home(geo::Wgs84 home);
[[nodiscard]] CommandInt reposition(geo::Wgs84 place);

}  // namespace lapwing::mavlink
