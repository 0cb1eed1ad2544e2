#pragma once

#include <array>
#include <optional>

#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink {

/// Where a command with a place points.
struct CommandPlace {
  MavFrame frame = MavFrame::global;
  double lat_rad = 0.0;
  double lon_rad = 0.0;
  double z_m = 0.0;  ///< in the frame's datum; NaN where the command allows "as it is"
  friend bool operator==(CommandPlace const&, CommandPlace const&) = default;
};

/// A command by its seven parameters, in the units that the standard gives for it. With a place, only 1 to 4 count.
struct Command {
  MavCmd id{};
  std::array<float, 7> params{};
  std::optional<CommandPlace> place = std::nullopt;
};

/// Whether the command makes a vehicle move, or able to: carried out late it surprises people.
[[nodiscard]] bool is_hazardous(Command const& command);

struct CommandOptions {
  /// Waits for `tries` times `ack_timeout` altogether. Sends that often while nothing is known of the link, and more
  /// often, with shorter waits, when its round trip is.
  int tries = 5;
  base::Duration ack_timeout = std::chrono::milliseconds(1500);
  /// After an IN_PROGRESS, how long until the next word about it.
  base::Duration progress_timeout = std::chrono::seconds(10);
  /// No try starts later than this after the call: a late ARM must never arm.
  base::Duration expiry = std::chrono::seconds(10);
  /// The same as a time, for a command that somebody asked for earlier.
  base::TimePoint not_after = base::TimePoint::max();
  /// A stop: overtakes other commands of its kind, and is sent to a vehicle that is silent too.
  bool is_urgent = false;
  /// False: the vehicle has said that it knows no COMMAND_INT, so that places go with a metre's precision.
  bool takes_int = true;
};

/// Sends the command until the vehicle acknowledges it. Succeeds when accepted; that it took effect shows in the
/// vehicle's state only. A command with a place goes as COMMAND_INT, which holds it to a centimetre, and as
/// COMMAND_LONG (counting `confirmation` up) to a vehicle that knows no other.
///
/// COMMAND_ACK names the command and nothing else. So one vehicle gets one command of a kind at a time, others wait for
/// their turn; and what may answer an earlier, different command of the kind is not believed: the try is repeated. A
/// hazardous command is not sent into silence, where a link might keep it and deliver it late: it waits for a sign of
/// life, until it expires.
///
/// Errors: refused (names command and result), timed_out (also when it expired unsent), cancelled (the vehicle, or a
/// later urgent command), and those of Connection::send.
base::Task<base::Result<>> run_command(Connection& connection, Address target, Command command,
                                       CommandOptions options = {});

// ---- commands by name

[[nodiscard]] Command arm();
[[nodiscard]] Command disarm();
/// Stops the motors at once, in the air too: what flies falls.
[[nodiscard]] Command force_disarm();
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
[[nodiscard]] Command set_home(geo::Wgs84 home);
/// Go there and stay, at `place.z_m`, in the mode that can do it; speed and heading as they are.
[[nodiscard]] Command reposition(CommandPlace place);

}  // namespace lapwing::mavlink
