#include "sim/autopilot/autopilot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mavlink/wire/modes.hpp"

namespace lapwing::sim {

using mavlink::MavResult;
using mavlink::MavSeverity;
using mavlink::MavState;
using vehicle::Family;

Autopilot::Autopilot(Setup const& setup, Site const& site, ParameterTable const& parameters, Plans const& plans)
    : kind_{airframe_of(setup.kind.family).family, setup.kind.firmware},
      words_(words_of(kind_)),
      airframe_(airframe_of(setup.kind.family)),
      site_(site),
      parameters_(parameters),
      plans_(plans),
      mission_(plans.mission),
      start_up_(setup.boot),
      battery_(setup.battery),
      mode_(&initial_mode(setup.kind)),
      home_(setup.start) {
  body_.position_m = setup.start;
  body_.attitude.yaw_rad = geo::wrap_pi(setup.heading_rad);
  read_parameters();
}

FlightContext Autopilot::context(double utc_day_s) const {
  return {body_, airframe_, site_, pace_, tuning_, plans_.rally, home_, now_, utc_day_s, !kind_.is_px4(), landed_};
}

void Autopilot::read_parameters() {
  if (parameters_read_ != parameters_.revision()) {
    parameters_read_ = parameters_.revision();
    pace_ = pace_from(kind_, parameters_);
    tuning_ = tuning_from(kind_, parameters_);
    safety_ = safety_from(kind_, parameters_);
    if (speed_override_) pace_.speed_m_s = *speed_override_;
  }
}

MavResult Autopilot::arm(bool force) {
  if (armed_) return MavResult::accepted;
  auto const why = objection();
  auto const refusal = arming_refusal({*mode_, navigation_, now_ >= start_up_.timeline().prearm_ok, tuning_.arm_in_auto,
                                       plans_.mission.size() > 1, why, arming_fault_});
  if (refusal && !force) {
    outbox_.say(MavSeverity::critical, fmt::format("{}{}", words_.arming_refused, *refusal));
    return MavResult::failed;
  }
  armed_ = true;
  has_flown_ = !landed_;
  idle_since_.reset();
  lift_at_.reset();
  if (!home_locked_ && navigation_.position_ok) {
    home_ = body_.position_m;
  }
  trail_.begin(body_.position_m);
  outbox_.home_changed = true;
  outbox_.say(MavSeverity::info, std::string(words_.armed));
  enter(*mode_);
  return MavResult::accepted;
}

MavResult Autopilot::disarm(bool force) {
  if (!armed_) return MavResult::accepted;
  if (!landed_ && !force) return MavResult::failed;
  do_disarm(words_.disarmed_by_command);
  return MavResult::accepted;
}

void Autopilot::do_disarm(std::string_view words) {
  armed_ = false;
  take_off_allowed_ = false;
  fence_took_over_ = false;
  lift_at_.reset();
  idle_since_.reset();
  goal_ = StandStill{};
  mission_.disarmed();
  outbox_.mission_current_changed = true;
  outbox_.say(MavSeverity::info, std::string(words));
}

bool Autopilot::may_enter(FlightMode const& mode) {
  auto const refuse = [&](std::string_view reason) {
    outbox_.say(MavSeverity::warning, is_copter_like() ? fmt::format("Mode change to {} failed: {}", mode.name, reason)
                                                       : "Flight mode change failed");
    return false;
  };
  if (kind_.is_px4()) {
    // Disarmed, a predicted position is enough: that comes with the origin.
    bool const position = armed_ ? navigation_.position_ok : now_ >= start_up_.timeline().origin_set;
    std::optional<std::string_view> objection = px4_objection(mode);
    if (mode.needs_position && !position) objection = "requires position";
    return objection ? refuse(*objection) : true;
  }
  // Disarmed, whether there is a position is left to the arming checks.
  bool const flies_blind = armed_ && mode.needs_position && !navigation_.position_ok;
  if (flies_blind && airframe_.family != Family::plane) return refuse("requires position");
  if (mode.entry == Entry::closed || (mode.entry == Entry::disarmed && armed_)) {
    bool const is_plane = airframe_.family == Family::plane;
    if (!mode.lacks.empty()) outbox_.say(is_plane ? MavSeverity::info : MavSeverity::warning, std::string(mode.lacks));
    // To a plane that is the whole of the refusal.
    return mode.lacks.empty() || !is_plane ? refuse("init failed") : false;
  }
  bool const has_trail = trail_.usable() && tuning_.trail.most_points > 0;
  if (mode.behaviour == Behaviour::retrace && !has_trail) return refuse("init failed");
  return mode.behaviour != Behaviour::mission || may_enter_auto() || refuse("init failed");
}

/// A copter only asks for a mission when it is armed: disarmed, it leaves that to the arming checks, too.
bool Autopilot::may_enter_auto() {
  bool const has_mission = plans_.mission.size() > 1;
  if (airframe_.family == Family::rover && !has_mission) {
    outbox_.say(MavSeverity::notice, "No Mission. Can't set AUTO.");
    return false;
  }
  if (!is_copter_like() || !armed_) return true;
  if (!has_mission) return false;
  bool const would_tip_over = airframe_.family == Family::copter && landed_;
  if (!would_tip_over || mission_.starts_with_take_off()) return true;
  outbox_.say(MavSeverity::critical, "Auto: Missing Takeoff Cmd");
  return false;
}

/// Copters and underwater vehicles run programs of one descent.
bool Autopilot::is_copter_like() const {
  return airframe_.family == Family::copter || airframe_.family == Family::sub;
}

/// PX4 goes into no mode of which it knows that it could not stay there (its mode requirements).
std::optional<std::string_view> Autopilot::px4_objection(FlightMode const& mode) const {
  if (mode.behaviour == Behaviour::manual) return "no manual control";
  if (mode.behaviour == Behaviour::mission && plans_.mission.size() <= 1) return "no valid mission";
  bool const guided_from_outside = setpoint_heard_ && now_ - *setpoint_heard_ <= tuning_.guided_timeout;
  if (mode.number == mavlink::px4_offboard && !guided_from_outside) return "no offboard signal";
  return std::nullopt;
}

MavResult Autopilot::set_mode(std::uint32_t number) {
  bool const recovers = fence_took_over_ && safety_.fence.holds_mode && fence_.breached() != 0 && armed_;
  if (recovers && !landed_ && number != mode_->number) {
    auto const* wanted = find_mode(kind_, number);
    bool const is_plane = airframe_.family == Family::plane;
    outbox_.say(is_plane ? MavSeverity::notice : MavSeverity::warning,
                fmt::format("Mode change to {} {} in fence recovery", wanted ? wanted->name : "?",
                            is_plane ? "denied," : "failed:"));
    return MavResult::failed;
  }
  auto const result = change_mode(number);
  if (result == MavResult::accepted) fence_took_over_ = false;
  return result;
}

MavResult Autopilot::change_mode(std::uint32_t number) {
  auto const* mode = find_mode(kind_, number);
  if (!mode) {
    outbox_.say(MavSeverity::warning, fmt::format("No such mode {}", number));
    return MavResult::failed;
  }
  if (mode == mode_) return MavResult::accepted;
  if (!may_enter(*mode)) return MavResult::failed;
  if (mode_->behaviour == Behaviour::mission) mission_.suspend();
  if (auto const* back = std::get_if<Retrace>(&logic_)) trail_.keep(back->left());
  if (mode->behaviour == Behaviour::mission && tuning_.restart_mission) mission_.restart();
  speed_override_.reset();
  parameters_read_ = 0;
  read_parameters();
  enter(*mode);
  outbox_.mode_changed = true;
  if (fence_.breached() != 0 && armed_ && !kind_.is_px4()) {
    outbox_.say(MavSeverity::info, "Manual recovery started");
    fence_.begin_recovery(now_);
  }
  return MavResult::accepted;
}

void Autopilot::enter(FlightMode const& mode) {
  mode_ = &mode;
  pace_.yaw_rad.reset();
  logic_ = logic_for(mode);
  if (mode.behaviour == Behaviour::mission) mission_.resume();
  outbox_.mission_current_changed = true;
}

Autopilot::Logic Autopilot::logic_for(FlightMode const& mode) const {
  auto const& here = body_.position_m;
  auto const rest = stopping_point(body_, airframe_, pace_);
  switch (mode.behaviour) {
    case Behaviour::guided: return Guided(rest);
    case Behaviour::land:
      if (airframe_.family == Family::sub) return HoldAt{{rest.north, rest.east, 0.0}};
      return Landing(rest);
    case Behaviour::return_home: return ReturnHome();
    case Behaviour::retrace: return Retrace(trail_.tidied(tuning_.trail));
    case Behaviour::circle: return Circle{rest, airframe_.family == Family::plane ? pace_.loiter_radius_m : 10.0};
    case Behaviour::hold: return HoldAt{rest};
    case Behaviour::take_off: {
      double const above_home_m = take_off_height_m_.value_or(tuning_.take_off_height_m);
      return TakeOff{here, kind_.is_px4() ? above_home_m - home_.down : above_home_m, body_.attitude.yaw_rad};
    }
    default: return std::monostate{};
  }
}

Guided& Autopilot::guided() {
  if (!std::holds_alternative<Guided>(logic_)) logic_ = Guided(body_.position_m);
  return std::get<Guided>(logic_);
}

MavResult Autopilot::take_off(double height_m) {
  if (kind_.is_px4()) {
    take_off_height_m_ = std::isfinite(height_m) ? std::optional(height_m) : std::nullopt;
    return change_mode(mode_for(kind_, Behaviour::take_off).number);
  }
  bool const may = airframe_.family == Family::copter && mode_->behaviour == Behaviour::guided && armed_ && landed_ &&
                   height_m > 0.0;
  if (!may) return MavResult::failed;
  guided().take_off(body_.position_m, height_m - home_.down, body_.attitude.yaw_rad);
  return MavResult::accepted;
}

/// ArduPilot's copter begins anew where a mission is over, a rover and a plane that are in AUTO already do nothing.
MavResult Autopilot::start_mission() {
  auto const& mission_mode = mode_for(kind_, Behaviour::mission);
  bool const begins_anew = kind_.is_px4() || is_copter_like();
  if (mode_ != &mission_mode) {
    auto const result = set_mode(mission_mode.number);
    if (result != MavResult::accepted) return result;
  } else if (begins_anew && (!mission_.running() || mission_.complete())) {
    mission_.resume();
  }
  take_off_allowed_ = armed_;
  return kind_.is_px4() ? arm(false) : MavResult::accepted;
}

MavResult Autopilot::reposition(geo::Ned point, bool change_mode, double radius_m) {
  if (mode_->behaviour != Behaviour::guided) {
    if (!change_mode) return MavResult::denied;
    auto const result = set_mode(mode_for(kind_, Behaviour::guided).number);
    if (result != MavResult::accepted) return MavResult::denied;
  }
  bool const reachable = airframe_.family != Family::copter || fence_.allows(point, home_, safety_.fence);
  if (!reachable) return MavResult::failed;
  if (radius_m != 0.0 && airframe_.family == Family::plane) {
    guided().circle(point, radius_m);
  } else {
    guided().go_to(body_.position_m, point);
  }
  return MavResult::accepted;
}

MavResult Autopilot::guide_velocity(geo::Ned velocity_m_s) {
  if (mode_->behaviour != Behaviour::guided) return MavResult::failed;
  guided().set_velocity(velocity_m_s, now_);
  return MavResult::accepted;
}

MavResult Autopilot::guide_wheels(Steer const& wanted) {
  if (mode_->behaviour != Behaviour::guided || airframe_.family != Family::rover) return MavResult::failed;
  guided().steer(wanted, now_);
  return MavResult::accepted;
}

MavResult Autopilot::change_speed(double speed_m_s) {
  if (!(speed_m_s > 0.0)) return MavResult::denied;
  speed_override_ = speed_m_s;
  pace_.speed_m_s = speed_m_s;
  return MavResult::accepted;
}

MavResult Autopilot::turn_to(double yaw_rad) {
  if (mode_->behaviour != Behaviour::guided && mode_->behaviour != Behaviour::mission) return MavResult::failed;
  pace_.yaw_rad = geo::wrap_pi(yaw_rad);
  return MavResult::accepted;
}

MavResult Autopilot::pause(bool paused) {
  if (mode_->behaviour != Behaviour::guided) return MavResult::failed;
  if (paused) {
    guided().pause(stopping_point(body_, airframe_, pace_));
  } else {
    guided().resume();
  }
  return MavResult::accepted;
}

bool Autopilot::set_current_item(int seq) {
  if (!mission_.set_current(seq)) return false;
  outbox_.mission_current_changed = true;
  return true;
}

MavResult Autopilot::start_landing() {
  auto const& items = plans_.mission;
  auto const begin = std::ranges::find(items, mavlink::MavCmd::do_land_start, &mavlink::MissionItem::command);
  if (begin == items.end() || !set_current_item(static_cast<int>(begin - items.begin()))) {
    outbox_.say(MavSeverity::warning, "Unable to start landing sequence");
    return MavResult::failed;
  }
  return set_mode(mode_for(kind_, Behaviour::mission).number);
}

void Autopilot::set_home(geo::Ned place) {
  home_ = place;
  home_locked_ = true;
  outbox_.home_changed = true;
}

std::optional<geo::Ned> Autopilot::home() const {
  if (now_ < start_up_.timeline().origin_set) return std::nullopt;
  return home_;
}

std::uint8_t Autopilot::base_mode() const {
  return static_cast<std::uint8_t>(mode_->base_mode | (armed_ ? mavlink::mode_flag::safety_armed : 0U));
}

/// ArduRover does not call a low battery critical.
bool Autopilot::failsafe_active() const {
  bool const shows_battery = kind_.is_px4() ? !safety_.on_critical_battery.empty() : airframe_.family != Family::rover;
  bool const link = kind_.is_px4() ? ground_station_.active() : link_failsafe_;
  return link || (shows_battery && battery_watch_.active()) || estimate_failed_;
}

MavState Autopilot::system_status() const {
  bool const booting = now_ < start_up_.timeline().standby;
  if (kind_.is_px4()) {
    if (booting) return MavState::uninit;
    if (!armed_) return MavState::standby;
    return failsafe_active() || fence_took_over_ ? MavState::critical : MavState::active;
  }
  if (airframe_.family == Family::rover) {
    if (booting) return MavState::calibrating;
    if (failsafe_active()) return MavState::critical;
    return mode_->name == "HOLD" ? MavState::standby : MavState::active;
  }
  if (booting) return MavState::active;
  if (failsafe_active()) return MavState::critical;
  return landed_ ? MavState::standby : MavState::active;
}

bool Autopilot::prearm_ok() const {
  auto const why = objection();
  ArmingView const view{*mode_, navigation_, now_ >= start_up_.timeline().prearm_ok, true, true, why, arming_fault_};
  // The periodic check does not ask whether this mode may arm, only whether the vehicle is fit for it. Before the
  // position is there the bit depends on the mode: healthy in STABILIZE, not in GUIDED.
  return view.checks_passed && view.fault.empty() && why.empty() && (!mode_->needs_position || navigation_.position_ok);
}

mavlink::MavLandedState Autopilot::landed_state() const {
  using enum mavlink::MavLandedState;
  if (landed_) return on_ground;
  if (std::holds_alternative<TakeOff>(goal_)) return takeoff;
  if (std::holds_alternative<Descend>(goal_)) return landing;
  return in_air;
}

}  // namespace lapwing::sim
