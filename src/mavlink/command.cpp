#include "mavlink/command.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "mavlink/inbox.hpp"
#include "mavlink/modes.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

std::unexpected<base::Error> refusal(Address target, CommandAck const& ack) {
  auto const kind = ack.result == MavResult::cancelled ? ErrorKind::cancelled : ErrorKind::refused;
  return fail(kind,
              fmt::format("vehicle {} answered {}: {}", target.system, to_string(ack.command), to_string(ack.result)));
}

/// `again(attempt)` is the message of each try.
base::Task<base::Result<>> exchange(Connection& connection, Address target, MavCmd id,
                                    std::function<Message(int attempt)> again, CommandOptions options) {
  auto& loop = connection.loop();
  auto const self = connection.self();
  Inbox acks(connection, target.system, wanting<CommandAck>([id, self](CommandAck const& ack) {
               return ack.command == id && addresses(ack.target, self);
             }));
  auto const expires = loop.now() + options.expiry;
  for (int attempt = 0; attempt < options.tries && loop.now() < expires; ++attempt) {
    if (auto sent = connection.send(target, again(attempt)); !sent) co_return std::unexpected(sent.error());
    auto deadline = loop.now() + options.ack_timeout;
    bool in_progress = false;
    for (;;) {
      auto const got = co_await acks.next(deadline);
      if (!got) break;
      auto const& ack = std::get<CommandAck>(*got);
      if (ack.result == MavResult::accepted) co_return base::Result<>{};
      if (ack.result != MavResult::in_progress) co_return refusal(target, ack);
      in_progress = true;
      deadline = loop.now() + options.progress_timeout;
    }
    if (in_progress)
      co_return fail(ErrorKind::timed_out,
                     fmt::format("vehicle {} began {} and did not say how it ended", target.system, to_string(id)));
  }
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} did not acknowledge {}", target.system, to_string(id)),
                 "check the link; the command may have taken effect all the same");
}

}  // namespace

base::Task<base::Result<>> run_command(Connection& connection, Address target, Command command,
                                       CommandOptions options) {
  auto again = [command](int attempt) -> Message {
    return CommandLong{
        .command = command.id, .confirmation = static_cast<std::uint8_t>(attempt), .params = command.params};
  };
  std::function<Message(int)> const messages(again);
  co_return co_await exchange(connection, target, command.id, messages, options);
}

base::Task<base::Result<>> run_command_int(Connection& connection, Address target, CommandInt command,
                                           CommandOptions options) {
  std::function<Message(int)> const messages([command](int) -> Message { return command; });
  co_return co_await exchange(connection, target, command.command, messages, options);
}

Command arm() {
  return {MavCmd::component_arm_disarm, {1.0F}};
}
Command disarm() {
  return {MavCmd::component_arm_disarm, {0.0F}};
}

Command set_mode(MavAutopilot autopilot, std::uint32_t custom_mode) {
  auto const flag = static_cast<float>(mode_flag::custom_mode_enabled);
  if (autopilot_of(autopilot) == Autopilot::px4) {
    auto const main_mode = static_cast<float>(custom_mode >> 16U & 0xFFU);
    auto const sub_mode = static_cast<float>(custom_mode >> 24U);
    return {MavCmd::do_set_mode, {flag, main_mode, sub_mode}};
  }
  return {MavCmd::do_set_mode, {flag, static_cast<float>(custom_mode)}};
}

Command take_off(double height_m) {
  return {MavCmd::nav_takeoff, {0, 0, 0, 0, 0, 0, static_cast<float>(height_m)}};
}

Command start_mission() {
  return {MavCmd::mission_start, {}};
}
Command set_current_item(std::uint16_t seq) {
  return {MavCmd::do_set_mission_current, {static_cast<float>(seq)}};
}
Command request_message(MessageId message) {
  return {MavCmd::request_message, {static_cast<float>(static_cast<std::uint32_t>(message))}};
}
Command reboot_autopilot() {
  return {MavCmd::preflight_reboot_shutdown, {1.0F}};
}

Command change_speed(double speed_m_s) {
  // Ground speed; the throttle stays as it is.
  return {MavCmd::do_change_speed, {1.0F, static_cast<float>(speed_m_s), -1.0F}};
}

CommandInt set_home(geo::Wgs84 home) {
  return {.frame = MavFrame::global,
          .command = MavCmd::do_set_home,
          .place = {.lat_rad = home.lat_rad, .lon_rad = home.lon_rad, .z_m = home.alt_m}};
}

CommandInt reposition(geo::Wgs84 place) {
  // Speed and yaw as they are; switches to the mode that can do it.
  return {.frame = MavFrame::global,
          .command = MavCmd::do_reposition,
          .params = {-1.0F, 1.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()},
          .place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m}};
}

}  // namespace lapwing::mavlink
