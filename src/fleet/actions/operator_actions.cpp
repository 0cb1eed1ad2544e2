#include "fleet/actions/operator_actions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/modes.hpp"
#include "plan/performance.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using mavlink::MavCmd;
using mavlink::ModeRole;
using vehicle::Action;
using vehicle::Autopilot;
using vehicle::Family;
using vehicle::StopAction;

std::optional<std::uint32_t> take_off_mode(MavlinkVehicle const& craft) {
  auto const autopilot = craft.state.autopilot;
  auto const by_name = [&](std::string_view name) { return mavlink::mode_number(autopilot, craft.state.family, name); };
  if (autopilot == Autopilot::px4) return by_name("AUTO.TAKEOFF");
  return craft.state.family == Family::copter ? std::nullopt : by_name("TAKEOFF");
}

namespace {

constexpr base::Duration effect_wait = 3s;

using plan::flies;

std::unexpected<base::Error> unable(MavlinkVehicle const& craft, std::string_view what) {
  return fail(ErrorKind::invalid_input, fmt::format("{} {}", craft.state.name, what));
}

Task<Result<>> go_into(mavlink::Connection& connection, MavlinkVehicle& craft, std::optional<std::uint32_t> mode,
                       std::string_view without, ActionOptions how) {
  if (!mode) co_return unable(craft, without);
  ModeChange const change{.custom_mode = *mode, .even_if_shown = true, .how = how};
  co_return co_await change_mode(connection, craft, change);
}

Task<Result<>> go_into_role(mavlink::Connection& connection, MavlinkVehicle& craft, ModeRole role,
                            std::string_view without, ActionOptions how) {
  auto const mode = mavlink::mode_for(craft.state.autopilot, craft.state.family, role);
  co_return co_await go_into(connection, craft, mode, without, how);
}

/// In the vehicle's own words where it has any. It may have left the ground a moment ago, and be about to tell so.
Task<Result<>> take_off_refused(MavlinkVehicle& craft, base::Error error, base::TimePoint since) {
  constexpr base::Duration word_wait = 1500ms;
  std::function<bool()> is_explained = [&craft, since] {
    return !given_reason(craft, since).empty() || craft.state.motion.landed.value == false;
  };
  (void)co_await craft.changed.wait_for(std::move(is_explained), word_wait);
  if (auto const reason = given_reason(craft, since); !reason.empty())
    error.message += ": " + reason;
  else if (craft.state.motion.landed.value == false)
    co_return unable(craft, "is in the air already");
  co_return std::unexpected(std::move(error));
}

Task<Result<>> leave_the_ground(mavlink::Connection& connection, MavlinkVehicle& craft, double height_m,
                                ActionOptions how) {
  ActionOptions const before{.not_after = how.not_after};
  if (auto const mode = take_off_mode(craft)) {
    auto changed = co_await go_into(connection, craft, mode, "", before);
    if (!changed) co_return changed;
    co_return co_await arm(connection, craft, how);
  }
  auto guided = co_await go_into_role(connection, craft, ModeRole::guided, "cannot take off by itself", before);
  if (!guided) co_return guided;
  if (auto armed = co_await arm(connection, craft, before); !armed) co_return armed;
  auto const since = connection.loop().now();
  auto const command = mavlink::take_off(height_m);
  mavlink::CommandOptions const options{.not_after = how.not_after};
  auto const asked = co_await mavlink::run_command(connection, craft.address, command, options);
  if (!asked && asked.error().kind == ErrorKind::refused)
    co_return co_await take_off_refused(craft, asked.error(), since);
  if (asked && how.on_accepted) how.on_accepted();
  co_return asked;
}

Task<Result<>> take_off(mavlink::Connection& connection, MavlinkVehicle& craft, double height_m, ActionOptions how) {
  if (!flies(craft.state.family)) co_return unable(craft, "does not fly");
  if (craft.state.motion.landed.value == false) co_return unable(craft, "is in the air already");
  co_return co_await leave_the_ground(connection, craft, height_m, how);
}

/// Where to go and how high. PX4 takes the height for one above sea level, whatever the frame says.
Result<mavlink::CommandPlace> place_to_go(MavlinkVehicle const& craft, vehicle::VehicleCommand const& command) {
  auto const& state = craft.state;
  auto const height_m = command.height_m ? command.height_m : state.motion.relative_alt_m.value;
  if (flies(state.family) && !height_m) return unable(craft, "has not told its height: give one");
  mavlink::CommandPlace there{.frame = mavlink::MavFrame::global_relative_alt,
                              .lat_rad = command.place->lat_rad,
                              .lon_rad = command.place->lon_rad,
                              .z_m = height_m.value_or(0.0)};
  if (state.autopilot != Autopilot::px4) return there;
  bool const knows_home = state.motion.position.value && state.motion.relative_alt_m.value;
  if (!knows_home) return unable(craft, "has not told how high it is above the sea");
  double const home_alt_m = state.motion.position.value->alt_m - *state.motion.relative_alt_m.value;
  there.frame = mavlink::MavFrame::global;
  there.z_m = home_alt_m + *height_m;
  return there;
}

/// Autopilots go there in their guided mode.
Task<Result<>> go_to(mavlink::Connection& connection, MavlinkVehicle& craft, vehicle::VehicleCommand command,
                     ActionOptions how) {
  if (!command.place) co_return unable(craft, "was told no place to go to");
  if (flies(craft.state.family) && craft.state.motion.landed.value.value_or(false))
    co_return unable(craft, "is on the ground: take off first");
  if (!craft.heard->is_armed) co_return unable(craft, "is not armed");
  auto const place = place_to_go(craft, command);
  if (!place) co_return std::unexpected(place.error());
  auto const guided = mavlink::mode_for(craft.state.autopilot, craft.state.family, ModeRole::guided);
  auto const hold = mavlink::mode_for(craft.state.autopilot, craft.state.family, ModeRole::hold);
  note_asked_mode(craft, guided ? guided : hold, connection.loop().now());  // PX4 goes there in AUTO.LOITER
  mavlink::CommandOptions const options{.not_after = how.not_after, .takes_int = craft.takes_command_int()};
  auto const asked = co_await mavlink::run_command(connection, craft.address, mavlink::reposition(*place), options);
  if (asked && how.on_accepted) how.on_accepted();
  co_return asked;
}

Task<Result<>> resume(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  if (!craft.heard->is_armed) co_return unable(craft, "is not armed: start the mission instead");
  co_return co_await go_into_role(connection, craft, ModeRole::mission, "has no mission mode", how);
}

/// Also when it was armed already: that it still is must come from itself.
Task<Result<>> arm_anew(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how) {
  if (!craft.heard->is_armed) co_return co_await arm(connection, craft, how);
  mavlink::CommandOptions const options{.not_after = how.not_after};
  auto const asked = co_await mavlink::run_command(connection, craft.address, mavlink::arm(), options);
  if (asked && how.on_accepted) how.on_accepted();
  co_return asked;
}

}  // namespace

bool flies_the_plan(MavlinkVehicle const& craft, vehicle::VehicleCommand const& command) {
  if (command.action == Action::start_mission || command.action == Action::resume_mission) return true;
  if (command.action == Action::arm) return in_mission_mode(craft);
  if (command.action != Action::set_mode) return false;
  auto const mode = mavlink::mode_number(craft.state.autopilot, craft.state.family, command.mode);
  return mode && mode == mavlink::mode_for(craft.state.autopilot, craft.state.family, ModeRole::mission);
}

Task<Result<>> carry_out(mavlink::Connection& connection, MavlinkVehicle& craft, vehicle::VehicleCommand command,
                         ActionOptions how) {
  if (craft.holds_parts() && flies_the_plan(craft, command))
    co_return fail(
        ErrorKind::refused,
        fmt::format("{} may hold a part of one plan and a part of another: upload a plan first", craft.state.name));
  switch (command.action) {
    case Action::arm: co_return co_await arm_anew(connection, craft, how);
    case Action::disarm: co_return co_await disarm(connection, craft, how);
    case Action::take_off:
      co_return co_await take_off(connection, craft, command.height_m.value_or(usual_take_off_height_m), how);
    case Action::land: co_return co_await go_into_role(connection, craft, ModeRole::land, "cannot land by itself", how);
    case Action::return_home:
      co_return co_await go_into_role(connection, craft, ModeRole::rtl, "has no mode to return in", how);
    case Action::hold:
    case Action::pause_mission:
      co_return co_await go_into_role(connection, craft, ModeRole::hold, "has no mode to hold in", how);
    case Action::go_to: co_return co_await go_to(connection, craft, command, how);
    case Action::set_mode: {
      auto const mode = mavlink::mode_number(craft.state.autopilot, craft.state.family, command.mode);
      auto const without = fmt::format("has no mode {}", command.mode);
      co_return co_await go_into(connection, craft, mode, without, how);
    }
    case Action::start_mission: co_return co_await arm_and_start(connection, craft, how);
    case Action::resume_mission: co_return co_await resume(connection, craft, how);
  }
  co_return unable(craft, "was told nothing that it knows");
}

namespace {

Task<Result<>> stop_motors(mavlink::Connection& connection, MavlinkVehicle& craft, std::function<void()> on_accepted) {
  auto const command = mavlink::force_disarm();
  mavlink::CommandOptions const options{.tries = 2, .ack_timeout = 500ms, .is_urgent = true};
  auto const asked = co_await mavlink::run_command(connection, craft.address, command, options);
  if (asked && on_accepted) on_accepted();
  std::function<bool()> shown = [&craft] { return !craft.heard->is_armed; };
  if (co_await craft.changed.wait_for(std::move(shown), effect_wait)) co_return Result<>{};
  if (!asked) co_return asked;
  co_return fail(ErrorKind::timed_out, "accepted, but it still reports armed");
}

OnStop on_stop_of(StopAction action) {
  if (action == StopAction::land) return OnStop::land;
  return action == StopAction::return_home ? OnStop::rtl : OnStop::loiter;
}

/// Modes in which a vehicle comes to rest or home.
bool is_stop_mode(MavlinkVehicle const& craft, std::uint32_t custom_mode) {
  constexpr std::array roles{ModeRole::hold, ModeRole::land, ModeRole::rtl};
  return std::ranges::any_of(roles, [&](ModeRole role) {
    return mavlink::mode_for(craft.state.autopilot, craft.state.family, role) == custom_mode;
  });
}

/// A parameter that holds a whole number; what is none, is that of no mode.
std::uint32_t whole(float value) {
  constexpr float limit = 4294967296.0F;
  return value >= 0.0F && value < limit ? static_cast<std::uint32_t>(value) : std::numeric_limits<std::uint32_t>::max();
}

bool is_moving(MavlinkVehicle const& craft, mavlink::Command const& command) {
  auto const& p = command.params;
  switch (command.id) {
    case MavCmd::do_set_mode: {
      bool const is_px4 = craft.state.autopilot == Autopilot::px4;
      return !is_stop_mode(craft, is_px4 ? whole(p[1]) << 16U | whole(p[2]) << 24U : whole(p[1]));
    }
    case MavCmd::nav_return_to_launch:
    case MavCmd::nav_land:
    case MavCmd::nav_vtol_land:
    case MavCmd::nav_loiter_unlim:
    case MavCmd::do_parachute:
    case MavCmd::do_flight_termination: return false;
    case MavCmd::do_pause_continue: return p[0] != 0.0F;
    default: return mavlink::is_hazardous(command);
  }
}

/// What a stopped vehicle may be told, as far as `is_moving` has nothing against it. By numbers of the standard: nobody
/// knows what the others do.
constexpr std::array<std::uint16_t, 44> harmless_when_stopped{
    17,   20,   21,   85,   176,  185,  // stops: LOITER_UNLIM, RTL, LAND, VTOL_LAND, SET_MODE, TERMINATION
    193,  208,  400,                    // PAUSE_CONTINUE, PARACHUTE, COMPONENT_ARM_DISARM
    202,  203,  204,  205,  206,  530,  531,  532,  533,  // cameras and mounts
    534,  1000, 1001, 2000, 2001, 2002, 2003, 2004, 2500, 2501, 2502,
    2503, 401,  410,  510,  511,  512,  519,  520,  521,  522,  // questions, and what is told regularly
    525,  527,  528,  2504, 2505};

std::optional<MavCmd> command_of(mavlink::Message const& message) {
  if (auto const* as_long = std::get_if<mavlink::CommandLong>(&message)) return as_long->command;
  if (auto const* as_int = std::get_if<mavlink::CommandInt>(&message)) return as_int->command;
  return std::nullopt;
}

}  // namespace

Task<Result<>> stop_at_once(mavlink::Connection& connection, MavlinkVehicle& craft, StopAction action,
                            std::function<void()> on_accepted) {
  if (action == StopAction::terminate) co_return co_await stop_motors(connection, craft, on_accepted);
  ActionOptions const how{.is_urgent = true, .on_accepted = on_accepted};
  if (!craft.heard->is_armed) co_return co_await disarm(connection, craft, how);
  auto stopped = co_await bring_to_rest(connection, craft, on_stop_of(action), on_accepted);
  if (!stopped) co_return stopped;
  // Wheels stand without a motor; boats and subs would drift.
  if (craft.state.family == Family::rover && action == StopAction::hold)
    co_return co_await disarm(connection, craft, how);
  co_return Result<>{};
}

bool is_moving(MavlinkVehicle const& craft, mavlink::Message const& message) {
  if (auto const* as_long = std::get_if<mavlink::CommandLong>(&message))
    return is_moving(craft, mavlink::Command{as_long->command, as_long->params});
  if (auto const* as_int = std::get_if<mavlink::CommandInt>(&message)) {
    auto const& p = as_int->params;
    return is_moving(craft, mavlink::Command{as_int->command, {p[0], p[1], p[2], p[3]}});
  }
  if (auto const* mode = std::get_if<mavlink::SetMode>(&message)) return !is_stop_mode(craft, mode->custom_mode);
  if (auto const* item = std::get_if<mavlink::MissionItem>(&message)) {
    constexpr std::uint8_t go_there = 2;  // ArduPilot's older ways of guiding: not an item of a mission
    constexpr std::uint8_t climb_there = 3;
    return item->current == go_there || item->current == climb_there;
  }
  return std::holds_alternative<mavlink::SetPositionTargetGlobalInt>(message) ||
         std::holds_alternative<mavlink::SetPositionTargetLocalNed>(message);
}

bool passes_stop(MavlinkVehicle const& craft, mavlink::Message const& message) {
  if (is_moving(craft, message)) return false;
  auto const command = command_of(message);
  return !command ||
         std::ranges::find(harmless_when_stopped, std::to_underlying(*command)) != harmless_when_stopped.end();
}

}  // namespace lapwing::fleet
