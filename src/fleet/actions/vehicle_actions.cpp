#include "fleet/actions/vehicle_actions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <ranges>

#include <fmt/format.h>

#include "fleet/plausibility/situation.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Duration;
using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using base::TimePoint;
using mavlink::ModeRole;
using vehicle::Family;

/// Writes what is asked of a vehicle, for the functions of this file.
class Actions {
 public:
  static Asked& asked_of(MavlinkVehicle& craft) { return craft.asked.write(As<Actions>()); }
};

void note_asked_mode(MavlinkVehicle& craft, std::optional<std::uint32_t> custom_mode, TimePoint now) {
  auto& asked = Actions::asked_of(craft);
  asked.mode = custom_mode;
  asked.mode_asked = now;
}

namespace {

constexpr int warning = 4;  // severities up to here explain a refusal
constexpr Duration ack_wait = 1s;
constexpr Duration urgent_ack_wait = 400ms;  // a stop is sent again rather than waited for; it may be heard twice
constexpr Duration heartbeat_wait = 2s;      // two heartbeats, one may get lost
constexpr Duration armed_wait = 10s;         // language specification 5.4, phase 5
constexpr Duration reason_wait = 1s;         // the text may come after the acknowledgement
constexpr Duration prearm_repeats = 35s;     // ArduPilot repeats its objections every 30 s
constexpr Duration prearm_patience = 10s;
constexpr std::uint32_t copter_stabilize = 0;

std::optional<std::uint32_t> mode_for(MavlinkVehicle const& craft, ModeRole role) {
  return mavlink::mode_for(craft.state.autopilot, craft.state.family, role);
}

bool is_ardupilot_copter(MavlinkVehicle const& craft) {
  return craft.state.autopilot == vehicle::Autopilot::ardupilot && craft.state.family == Family::copter;
}

bool can_fly(MavlinkVehicle const& craft) {
  return craft.state.family == Family::copter || craft.state.family == Family::plane ||
         craft.state.family == Family::vtol;
}

/// Ends when the condition holds after some message from the vehicle, or its connection changed.
Task<bool> wait_for(MavlinkVehicle& craft, std::function<bool()> condition, Duration timeout) {
  return craft.changed.wait_for(std::move(condition), timeout);
}

/// A text of the autopilot itself that explains something that happened at or after `since`.
bool explains(vehicle::StatusText const& text, TimePoint since) {
  return text.heard >= since && text.severity <= warning && text.component == mavlink::autopilot_component;
}

Task<> wait_for_reason(MavlinkVehicle& craft, TimePoint since) {
  std::function<bool()> given = [&craft, since] {
    return std::ranges::any_of(craft.state.recent_texts, [since](auto const& text) { return explains(text, since); });
  };
  (void)co_await wait_for(craft, std::move(given), reason_wait);
}

std::string with_reason(std::string what, std::string const& reason) {
  return reason.empty() ? what : fmt::format("{}: {}", what, reason);
}

/// `error` in the vehicle's own words, where it gave any.
std::unexpected<base::Error> explained(std::string_view what, base::Error const& error, std::string const& reason) {
  return fail(error.kind, fmt::format("{}: {}", what, reason.empty() ? error.message : reason));
}

/// The mode in which to arm, when the present one does not allow it.
std::optional<std::uint32_t> mode_to_arm_in(MavlinkVehicle const& craft) {
  if (!is_ardupilot_copter(craft)) return std::nullopt;
  auto const guided = mode_for(craft, ModeRole::guided);
  bool const is_armable = craft.heard->custom_mode == copter_stabilize || craft.heard->custom_mode == guided;
  if (is_armable && !craft.asked->mission_mode_pending) return std::nullopt;
  return guided;
}

std::optional<std::uint32_t> stop_mode(MavlinkVehicle const& craft, OnStop on_stop) {
  auto const hold = mode_for(craft, ModeRole::hold);
  switch (on_stop) {
    case OnStop::loiter: return hold;
    case OnStop::rtl: return mode_for(craft, ModeRole::rtl).or_else([&] { return hold; });
    case OnStop::land: return mode_for(craft, ModeRole::land).or_else([&] { return hold; });
  }
  return hold;
}

Task<Result<>> send_arming(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  auto& notes = Actions::asked_of(craft);
  notes.may_arm_late_until.reset();  // from now on it is wanted
  notes.arming_begun = connection.loop().now();
  ++notes.armings;
  auto const since = connection.loop().now();
  // Short waits and many tries: it must come through within the seconds before it expires.
  mavlink::CommandOptions const options{.tries = 10, .ack_timeout = 700ms, .expiry = 8s, .not_after = how.not_after};
  auto const command = mavlink::arm();
  auto const asked = co_await mavlink::run_command(connection, craft.address, command, options);
  if (asked && how.on_accepted) how.on_accepted();
  if (!asked && asked.error().kind == ErrorKind::refused) {
    co_await wait_for_reason(craft, since);
    co_return explained("arming refused", asked.error(), given_reason(craft, since));
  }
  // An acknowledgement may be lost and the vehicle armed all the same.
  std::function<bool()> is_armed = [&craft] { return craft.heard->is_armed; };
  auto const patience = asked ? armed_wait : heartbeat_wait;
  if (co_await wait_for(craft, std::move(is_armed), patience)) {
    notes.arming_begun.reset();
    co_return Result<>{};
  }
  if (!asked) co_return fail(asked.error().kind, fmt::format("arming: {}", asked.error().message));
  co_return fail(ErrorKind::timed_out,
                 with_reason("accepted arming but did not report armed", given_reason(craft, since)));
}

/// One try to get the vehicle into its mission mode. MISSION_START makes a copter on the ground take off without a
/// pilot's throttle; the others start with the mode.
Task<Result<>> command_mission(mavlink::Connection& connection, MavlinkVehicle& craft, std::uint32_t mission_mode,
                               TimePoint not_after) {
  mavlink::CommandOptions const options{.tries = 1, .ack_timeout = ack_wait, .not_after = not_after};
  note_asked_mode(craft, mission_mode, connection.loop().now());
  auto const by_mode = mavlink::set_mode(craft.heard->mav_autopilot, mission_mode);
  if (!is_ardupilot_copter(craft)) co_return co_await mavlink::run_command(connection, craft.address, by_mode, options);
  auto const by_start = mavlink::start_mission();
  auto started = co_await mavlink::run_command(connection, craft.address, by_start, options);
  if (started || started.error().kind != ErrorKind::refused) co_return started;
  co_return co_await mavlink::run_command(connection, craft.address, by_mode, options);
}

Task<Result<>> enter_mission(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  constexpr int tries = 10;
  auto const mission_mode = mode_for(craft, ModeRole::mission);
  if (!mission_mode) co_return fail(ErrorKind::invalid_input, fmt::format("{} has no mission mode", craft.state.name));
  auto const since = connection.loop().now();
  Result<> commanded;
  for (int attempt = 0; attempt < tries; ++attempt) {
    Actions::asked_of(craft).mission_mode_pending = !in_mission_mode(craft);
    commanded = co_await command_mission(connection, craft, *mission_mode, how.not_after);
    if (commanded && how.on_accepted) how.on_accepted();
    if (!commanded && commanded.error().kind != ErrorKind::timed_out) break;
    std::function<bool()> decided = [&craft] { return in_mission_mode(craft) || !craft.heard->is_armed; };
    (void)co_await wait_for(craft, std::move(decided), heartbeat_wait);
    if (in_mission_mode(craft) && craft.heard->is_armed) co_return Result<>{};
    if (!craft.heard->is_armed) co_return fail(ErrorKind::timed_out, "disarmed again before the mission began");
  }
  if (!commanded && commanded.error().kind == ErrorKind::refused) co_await wait_for_reason(craft, since);
  auto const reason = given_reason(craft, since);
  auto const what = fmt::format("{} not entered", mode_name(craft, *mission_mode));
  if (!commanded) co_return explained(what, commanded.error(), reason);
  co_return fail(ErrorKind::timed_out, with_reason(what + " although accepted", reason));
}

}  // namespace

std::optional<OnStop> on_stop_from(std::string_view word) {
  if (word == "loiter") return OnStop::loiter;
  if (word == "rtl") return OnStop::rtl;
  if (word == "land") return OnStop::land;
  return std::nullopt;
}

bool in_mission_mode(MavlinkVehicle const& craft) {
  return craft.heard->custom_mode == mode_for(craft, ModeRole::mission);
}

std::string mode_name(MavlinkVehicle const& craft, std::uint32_t custom_mode) {
  return mavlink::mode_name(craft.state.autopilot, craft.state.family, custom_mode);
}

std::string given_reason(MavlinkVehicle const& craft, TimePoint since) {
  // The cause comes first ("Auto: Missing Takeoff Cmd"), what came of it last ("Mode change to AUTO failed: init
  // failed"). Where the link has lost the cause, the rest is better than nothing.
  auto const& texts = craft.state.recent_texts;
  auto const is_cause = [since](auto const& text) {
    return explains(text, since) && !text.text.starts_with("Mode change to");
  };
  if (auto const cause = std::ranges::find_if(texts, is_cause); cause != texts.end()) return cause->text;
  auto const explained = std::ranges::find_if(texts, [since](auto const& text) { return explains(text, since); });
  if (explained != texts.end()) return explained->text;
  for (auto const& text : std::views::reverse(texts))
    if (text.heard + prearm_repeats >= since && text.text.starts_with("PreArm")) return text.text;
  return {};
}

Task<Result<>> change_mode(mavlink::Connection& connection, MavlinkVehicle& craft, ModeChange change) {
  auto const mode = change.custom_mode;
  if (craft.heard->custom_mode == mode && !change.even_if_shown) co_return Result<>{};
  auto const since = connection.loop().now();
  auto const& how = change.how;
  mavlink::CommandOptions const options{.tries = 1,
                                        .ack_timeout = how.is_urgent ? urgent_ack_wait : ack_wait,
                                        .not_after = how.not_after,
                                        .is_urgent = how.is_urgent};
  auto const command = mavlink::set_mode(craft.heard->mav_autopilot, mode);
  Result<> asked;
  for (int attempt = 0; attempt < change.tries; ++attempt) {
    note_asked_mode(craft, mode, connection.loop().now());
    asked = co_await mavlink::run_command(connection, craft.address, command, options);
    if (asked && how.on_accepted) how.on_accepted();
    if (!asked && asked.error().kind != ErrorKind::timed_out) break;
    auto const answered = connection.loop().now();
    std::function<bool()> shown = [&craft, &change, mode, answered] {
      return craft.heard->custom_mode == mode &&
             (!change.even_if_shown || craft.state.links.heartbeat_heard >= answered);
    };
    auto const patience = how.is_urgent && !asked ? Duration{} : heartbeat_wait;
    if (co_await wait_for(craft, std::move(shown), patience)) {
      Actions::asked_of(craft).mission_mode_pending = false;
      co_return Result<>{};
    }
  }
  auto const what = fmt::format("{} not entered", mode_name(craft, mode));
  if (asked) co_return fail(ErrorKind::timed_out, what + " although accepted");
  if (asked.error().kind == ErrorKind::refused) co_await wait_for_reason(craft, since);
  co_return explained(what, asked.error(), given_reason(craft, since));
}

namespace {

std::string_view missing_for_place(MavlinkVehicle const& craft) {
  return !craft.heard->fix || *craft.heard->fix < mavlink::GpsFix::fix_3d ? "no GPS fix" : "no position estimate";
}

}  // namespace

std::string why_not_ready(MavlinkVehicle const& craft) {
  std::string what;
  if (!knows_its_place(craft)) what = missing_for_place(craft);
  for (auto const& objection : craft.state.arming.reasons) what += (what.empty() ? "" : "; ") + objection.text;
  return what;
}

Task<Result<>> wait_until_ready(MavlinkVehicle& craft, base::Loop& loop, Duration patience) {
  auto const since = loop.now();
  std::function<bool()> is_placed = [&craft] { return knows_its_place(craft); };
  if (!co_await wait_for(craft, std::move(is_placed), patience)) {
    auto const missing = missing_for_place(craft);
    auto const what = fmt::format("not ready after {:.0f} s, {}", base::to_seconds(patience), missing);
    co_return fail(ErrorKind::timed_out, with_reason(what, given_reason(craft, since)));
  }
  std::function<bool()> no_objection = [&craft] {
    return craft.heard->is_armed || craft.state.arming.health.value.value_or(vehicle::Health{}).prearm_ok;
  };
  if (craft.state.arming.health.known()) (void)co_await wait_for(craft, std::move(no_objection), prearm_patience);
  co_return Result<>{};
}

Task<Result<>> leave_mission(mavlink::Connection& connection, MavlinkVehicle& craft, OnStop on_stop) {
  if (!in_mission_mode(craft) && !craft.asked->mission_mode_pending) co_return Result<>{};
  auto mode = stop_mode(craft, on_stop);
  if (!craft.heard->is_armed && mode_to_arm_in(craft)) mode = mode_to_arm_in(craft);
  if (!mode) co_return fail(ErrorKind::invalid_input, fmt::format("{} has no mode to stop in", craft.state.name));
  ModeChange const change{.custom_mode = *mode, .even_if_shown = craft.asked->mission_mode_pending};
  co_return co_await change_mode(connection, craft, change);
}

Task<Result<>> arm(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  if (craft.heard->is_armed) co_return Result<>{};
  if (auto const mode = mode_to_arm_in(craft)) {
    ModeChange const change{
        .custom_mode = *mode, .even_if_shown = craft.asked->mission_mode_pending, .how = {.not_after = how.not_after}};
    if (auto changed = co_await change_mode(connection, craft, change); !changed) co_return changed;
  }
  co_return co_await send_arming(connection, craft, how);
}

Task<Result<>> arm_and_start(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  constexpr int attempts = 3;  // a lossy link can eat up the seconds between arming and the start
  ActionOptions const first{.not_after = how.not_after};
  bool const was_armed = craft.heard->is_armed;
  Result<> entered;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (auto armed = co_await arm(connection, craft, first); !armed) co_return armed;
    entered = co_await enter_mission(connection, craft, how);
    if (entered || craft.heard->is_armed) break;
  }
  // Motors that run for nothing. In the air, where it may be all the same, the autopilot refuses.
  if (!entered && !was_armed && craft.heard->is_armed) {
    ActionOptions const at_once{.is_urgent = true};
    auto const disarmed = co_await disarm(connection, craft, at_once);
    if (!disarmed) entered.error().message += fmt::format("; it is still armed: {}", disarmed.error().message);
  }
  co_return entered;
}

Task<Result<>> disarm(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  auto const since = connection.loop().now();
  auto const command = mavlink::disarm();
  mavlink::CommandOptions const options{.not_after = how.not_after, .is_urgent = how.is_urgent};
  auto const asked = co_await mavlink::run_command(connection, craft.address, command, options);
  if (asked && how.on_accepted) how.on_accepted();
  if (!asked && asked.error().kind == ErrorKind::refused) {
    co_await wait_for_reason(craft, since);
    co_return explained("disarming refused", asked.error(), given_reason(craft, since));
  }
  auto const answered = connection.loop().now();
  std::function<bool()> shown = [&craft, answered] {
    return !craft.heard->is_armed && craft.state.links.heartbeat_heard >= answered;
  };
  if (co_await wait_for(craft, std::move(shown), heartbeat_wait)) co_return Result<>{};
  if (!asked) co_return asked;
  co_return fail(ErrorKind::timed_out, "accepted disarming but still reports armed");
}

std::array<mavlink::Command, 4> stops_without_mode(OnStop on_stop) {
  using mavlink::MavCmd;
  constexpr auto as_it_is = std::numeric_limits<float>::quiet_NaN();
  mavlink::Command const pause{MavCmd::do_pause_continue, {0.0F}};
  mavlink::Command const stay{MavCmd::nav_loiter_unlim, {0, 0, 0, as_it_is, as_it_is, as_it_is, as_it_is}};
  mavlink::Command const land{MavCmd::nav_land, {0, 0, 0, as_it_is, as_it_is, as_it_is, as_it_is}};
  mavlink::Command const home{MavCmd::nav_return_to_launch, {}};
  switch (on_stop) {
    case OnStop::loiter: break;
    case OnStop::land: return {land, pause, stay, home};
    case OnStop::rtl: return {home, pause, stay, land};
  }
  return {pause, stay, land, home};
}

namespace {

/// For an autopilot whose modes are not known: by the first command that it accepts, until something shows that it
/// obeys: another mode, no speed, the ground, or motors that are off.
Task<Result<>> stop_without_mode(mavlink::Connection& connection, MavlinkVehicle& craft, OnStop on_stop,
                                 std::function<void()> on_accepted) {
  constexpr double standing_m_s = 0.5;
  mavlink::CommandOptions const options{.tries = 2, .ack_timeout = 500ms, .is_urgent = true};
  auto const mode_before = craft.heard->custom_mode;
  auto const commands = stops_without_mode(on_stop);
  Result<> asked;
  for (auto const& command : commands) {
    asked = co_await mavlink::run_command(connection, craft.address, command, options);
    if (!asked) continue;
    if (on_accepted) on_accepted();
    auto const answered = connection.loop().now();
    std::function<bool()> shown = [&craft, mode_before, answered] {
      auto const& velocity = craft.state.motion.velocity_m_s;
      bool const stands = velocity.known() && velocity.heard >= answered &&
                          std::hypot(velocity.value->north, velocity.value->east, velocity.value->down) < standing_m_s;
      return stands || !craft.heard->is_armed || craft.state.motion.landed.value.value_or(false) ||
             craft.heard->custom_mode != mode_before;
    };
    if (co_await wait_for(craft, std::move(shown), heartbeat_wait)) co_return Result<>{};
    co_return fail(ErrorKind::timed_out,
                   fmt::format("accepted {}, but neither a mode nor its speed shows that it stops",
                               mavlink::to_string(command.id)));
  }
  co_return fail(asked.error().kind, fmt::format("no mode to stop in is known; {}", asked.error().message));
}

}  // namespace

Task<Result<>> bring_to_rest(mavlink::Connection& connection, MavlinkVehicle& craft, OnStop on_stop,
                             std::function<void()> on_accepted) {
  auto const mode = stop_mode(craft, on_stop);
  if (!mode) co_return co_await stop_without_mode(connection, craft, on_stop, on_accepted);
  ActionOptions const how{.is_urgent = true, .on_accepted = on_accepted};
  ModeChange const change{.custom_mode = *mode, .even_if_shown = true, .tries = 25, .how = how};
  auto changed = co_await change_mode(connection, craft, change);
  if (!changed && changed.error().kind == ErrorKind::refused) {
    // Without a position a copter cannot stay in place, but it can always come down.
    if (auto const land = mode_for(craft, ModeRole::land); land && land != mode) {
      ModeChange const down{.custom_mode = *land, .even_if_shown = true, .tries = 25, .how = how};
      changed = co_await change_mode(connection, craft, down);
    }
  }
  if (!changed) co_return changed;
  // Refused when it is in the air after all: then it holds, which is what was asked for.
  bool const stands = craft.state.motion.landed.value.value_or(false);
  ActionOptions const at_once{.is_urgent = true};
  if (can_fly(craft) && craft.heard->is_armed && stands) (void)co_await disarm(connection, craft, at_once);
  co_return Result<>{};
}

}  // namespace lapwing::fleet
