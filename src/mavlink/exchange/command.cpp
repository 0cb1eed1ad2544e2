#include "mavlink/exchange/command.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/command_ledger.hpp"
#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/internal/repeats.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

std::unexpected<base::Error> refusal(Address target, CommandAck const& ack) {
  auto const kind = ack.result == MavResult::cancelled ? ErrorKind::cancelled : ErrorKind::refused;
  return fail(kind,
              fmt::format("vehicle {} answered {}: {}", target.system, to_string(ack.command), to_string(ack.result)));
}

/// A heartbeat comes every second; a vehicle silent for longer may be behind a link that keeps what it is given.
constexpr base::Duration sign_of_life = std::chrono::seconds(3);

CommandInt as_int(Command const& command) {
  auto const& p = command.params;
  CommandInt message{.command = command.id, .params = {p[0], p[1], p[2], p[3]}, .place = {}};
  if (auto const& place = command.place) {
    message.frame = place->frame;
    message.place = {.lat_rad = place->lat_rad, .lon_rad = place->lon_rad, .z_m = place->z_m};
  } else {
    message.place = {.x = p[4], .y = p[5], .z_m = p[6]};
  }
  return message;
}

CommandLong as_long(Command const& command, int attempt) {
  constexpr double degree = std::numbers::pi / 180.0;
  CommandLong message{
      .command = command.id, .confirmation = static_cast<std::uint8_t>(attempt), .params = command.params};
  if (auto const& place = command.place) {
    message.params[4] = static_cast<float>(place->lat_rad / degree);
    message.params[5] = static_cast<float>(place->lon_rad / degree);
    message.params[6] = static_cast<float>(place->z_m);
  }
  return message;
}

/// One command on its way to one vehicle.
struct Exchange {
  Connection& connection;
  Address target;
  Command const& command;
  CommandOptions const& options;
  base::TimePoint expires;
  CommandTurn turn;
  bool goes_as_int;

  [[nodiscard]] base::TimePoint now() const { return connection.loop().now(); }
  [[nodiscard]] bool is_careful() const { return is_hazardous(command) && !options.is_urgent; }
  [[nodiscard]] Message message(int attempt) const {
    if (goes_as_int) return as_int(command);
    return as_long(command, attempt);
  }
  /// The vehicle knows the command in the other form only.
  [[nodiscard]] bool changes_form(MavResult result) {
    bool const other = goes_as_int ? result == MavResult::unsupported || result == MavResult::command_long_only
                                   : result == MavResult::command_int_only;
    bool const is_new = other && !has_changed_form;
    if (is_new) goes_as_int = !goes_as_int;
    has_changed_form = has_changed_form || is_new;
    return is_new;
  }
  bool has_changed_form = false;
};

/// Commands that ask for messages go out in long rows; whether they took effect shows in what arrives.
bool shows_by_itself(MavCmd id) {
  return id == MavCmd::set_message_interval || id == MavCmd::get_message_interval || id == MavCmd::request_message;
}

std::unexpected<base::Error> expired(Address target, MavCmd id) {
  return fail(ErrorKind::timed_out,
              fmt::format("{} for vehicle {} expired before it could be sent", to_string(id), target.system),
              "ask again when the vehicle is heard");
}

std::unexpected<base::Error> overtaken(Address target, MavCmd id) {
  return fail(ErrorKind::cancelled,
              fmt::format("{} for vehicle {} was overtaken by a later one", to_string(id), target.system));
}

/// Waits until the vehicle is heard, if it has not just been.
base::Task<bool> is_alive(Exchange const& exchange) {
  auto const heard = exchange.connection.last_heard(exchange.target);
  if (!exchange.is_careful() || !heard || exchange.now() - *heard <= sign_of_life) co_return true;
  std::function<bool(Heartbeat const&)> any = [](Heartbeat const&) { return true; };
  auto const left = exchange.expires - exchange.now();
  auto const got = co_await await_message<Heartbeat>(exchange.connection, exchange.target, any, left);
  co_return got&& exchange.now() < exchange.expires;
}

/// What became of one try.
struct Answer {
  std::optional<base::Result<>> result;  ///< nothing: it is to be repeated
  bool is_busy = false;                  ///< the vehicle wants to be asked again later
};

base::Task<Answer> await_answer(Exchange& exchange, Inbox& acks, base::Duration wait) {
  auto const target = exchange.target;
  auto const id = exchange.command.id;
  auto deadline = exchange.now() + wait;
  bool in_progress = false;
  for (;;) {
    auto const got = co_await acks.next(deadline);
    if (!exchange.turn.is_ours()) co_return Answer{overtaken(target, id)};
    if (!got) break;
    auto const& ack = std::get<CommandAck>(*got);
    if (ack.result == MavResult::in_progress) {
      in_progress = true;
      deadline = exchange.now() + exchange.options.progress_timeout;
      continue;
    }
    bool const is_ours = exchange.turn.note_answer(exchange.command, exchange.now());
    if (!is_ours && !shows_by_itself(id)) continue;
    if (exchange.changes_form(ack.result)) co_return Answer{};
    if (ack.result == MavResult::accepted) co_return Answer{base::Result<>{}};
    co_return Answer{refusal(target, ack), ack.result == MavResult::temporarily_rejected && !shows_by_itself(id)};
  }
  if (!in_progress) co_return Answer{};
  co_return Answer{fail(ErrorKind::timed_out,
                        fmt::format("vehicle {} began {} and did not say how it ended", target.system, to_string(id)))};
}

/// A vehicle that is busy for longer than this will not have time soon.
base::Duration busy_patience(CommandOptions const& options) {
  return options.is_urgent ? std::chrono::seconds(2) : std::chrono::seconds(8);
}
base::Duration busy_pause(CommandOptions const& options) {
  return options.is_urgent ? std::chrono::milliseconds(250) : std::chrono::seconds(1);
}

}  // namespace

base::Task<base::Result<>> run_command(Connection& connection, Address target, Command command,
                                       CommandOptions options) {
  auto const self = connection.self();
  auto const id = command.id;
  auto const expires = std::min(connection.loop().now() + options.expiry, options.not_after);
  auto& line = connection.commands().line(target.system, id);
  while (!options.is_urgent && line.is_taken()) {
    if (connection.loop().now() >= expires) co_return expired(target, id);
    co_await line.freed.wait_until(expires);
  }
  Exchange exchange{
      connection, target, command, options, expires, CommandTurn(line), command.place && options.takes_int};
  Inbox acks(connection, target, wanting<CommandAck>([id, self](CommandAck const& ack) {
               return ack.command == id && addresses(ack.target, self);
             }));
  std::optional<internal::Repeats> repeats(std::in_place, connection, target, options.tries, options.ack_timeout);
  std::optional<base::TimePoint> busy_since;
  int sent = 0;
  while (!repeats->are_over()) {
    bool const alive = co_await is_alive(exchange);
    if (!exchange.turn.is_ours()) co_return overtaken(target, id);
    if (!alive || exchange.now() >= expires) break;
    if (auto gone = connection.send(target, exchange.message(sent)); !gone) co_return std::unexpected(gone.error());
    exchange.turn.note_sent(command, exchange.now());
    ++sent;
    auto const answer = co_await await_answer(exchange, acks, repeats->next());
    if (!answer.result) continue;
    if (!answer.is_busy) co_return *answer.result;
    if (!busy_since) busy_since = exchange.now();
    auto const again = exchange.now() + busy_pause(options);
    if (again >= expires || again - *busy_since > busy_patience(options)) co_return *answer.result;
    co_await connection.loop().sleep_until(again);
    repeats.emplace(connection, target, options.tries, options.ack_timeout);
  }
  if (sent == 0) co_return expired(target, id);
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} did not acknowledge {}", target.system, to_string(id)),
                 "check the link; the command may have taken effect all the same");
}

namespace {

/// Commands of that kind which have no name here: DO_FOLLOW, DO_FOLLOW_REPOSITION, DO_ORBIT, DO_FIGURE_EIGHT,
/// GUIDED_CHANGE_SPEED, _ALTITUDE and _HEADING.
constexpr std::array<std::uint16_t, 7> nameless_moves{32, 33, 34, 35, 43000, 43001, 43002};

}  // namespace

bool is_hazardous(Command const& command) {
  switch (command.id) {
    case MavCmd::component_arm_disarm: return command.params[0] != 0.0F;
    case MavCmd::do_set_mode:
    case MavCmd::nav_takeoff:
    case MavCmd::nav_vtol_takeoff:
    case MavCmd::nav_return_to_launch:
    case MavCmd::nav_land:
    case MavCmd::nav_loiter_unlim:
    case MavCmd::mission_start:
    case MavCmd::do_reposition:
    case MavCmd::do_change_altitude:
    case MavCmd::do_pause_continue:
    case MavCmd::do_set_reverse:
    case MavCmd::do_motor_test:
    case MavCmd::do_flight_termination:
    case MavCmd::nav_set_yaw_speed:
    case MavCmd::nav_takeoff_local:
    case MavCmd::nav_land_local:
    case MavCmd::nav_vtol_land:
    case MavCmd::nav_follow:
    case MavCmd::nav_guided_enable:
    case MavCmd::do_land_start:
    case MavCmd::do_rally_land:
    case MavCmd::do_go_around:
    case MavCmd::do_parachute:
    case MavCmd::do_inverted_flight:
    case MavCmd::do_autotune_enable:
    case MavCmd::do_aux_function:
    case MavCmd::do_engine_control:
    case MavCmd::do_set_mission_current:
    case MavCmd::do_vtol_transition:
    case MavCmd::preflight_reboot_shutdown:
    case MavCmd::condition_yaw: return true;
    default: return std::ranges::find(nameless_moves, std::to_underlying(command.id)) != nameless_moves.end();
  }
}

Command arm() {
  return {MavCmd::component_arm_disarm, {1.0F}};
}
Command disarm() {
  return {MavCmd::component_arm_disarm, {0.0F}};
}
Command force_disarm() {
  constexpr float force = 21196.0F;  // the standard's magic number of MAV_CMD_COMPONENT_ARM_DISARM
  return {MavCmd::component_arm_disarm, {0.0F, force}};
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

Command set_home(geo::Wgs84 home) {
  return {MavCmd::do_set_home, {}, CommandPlace{MavFrame::global, home.lat_rad, home.lon_rad, home.alt_m}};
}

Command reposition(CommandPlace place) {
  // Speed and yaw as they are; switches to the mode that can do it.
  return {MavCmd::do_reposition, {-1.0F, 1.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()}, place};
}

}  // namespace lapwing::mavlink
