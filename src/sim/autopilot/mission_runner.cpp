#include "sim/autopilot/mission_runner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim {

using mavlink::MavCmd;
using mavlink::MavSeverity;
using mavlink::MissionState;
using enum mavlink::MavCmd;

namespace {

/// The radius of a plane's or rover's own circle; the parameter's sign is the sense of turning.
double radius_or(double wanted_m, double otherwise_m) {
  return wanted_m == 0.0 ? otherwise_m : wanted_m;
}

constexpr double copter_circle_radius_m = 10.0;

/// Seconds that a NAV_DELAY waits: a time to wait, or until a time of the UTC day (-1: any).
double delay_s(mavlink::MissionItem const& item, double utc_day_s) {
  if (item.params[0] > 0.0F) return item.params[0];
  double const hour = item.params[1];
  double const minute = item.params[2];
  double const second = item.params[3];
  if (hour < 0.0 && minute < 0.0 && second < 0.0) return 0.0;
  double const cycle = hour >= 0.0 ? 86400.0 : minute >= 0.0 ? 3600.0 : 60.0;
  double const wanted = std::max(hour, 0.0) * 3600.0 + std::max(minute, 0.0) * 60.0 + std::max(second, 0.0);
  return std::fmod(wanted - std::fmod(utc_day_s, cycle) + cycle, cycle);
}

}  // namespace

void MissionRunner::restart() {
  current_ = plan_.size() > 1 ? 1 : 0;
  next_ = 1;
  complete_ = false;
  landed_ = false;
  run_.reset();
  jumps_done_.clear();
  end_.reset();
}

void MissionRunner::resume() {
  running_ = true;
  if (complete_ || current_ == 0) restart();
  // The current item starts anew from where the vehicle is now.
  next_ = current_ > 0 ? current_ : 1;
  run_.reset();
}

void MissionRunner::suspend() {
  running_ = false;
  run_.reset();
}

bool MissionRunner::set_current(int seq) {
  if (seq < 0 || seq >= static_cast<int>(plan_.size())) return false;
  current_ = std::max(seq, plan_.size() > 1 ? 1 : 0);
  next_ = current_;
  complete_ = false;
  landed_ = false;
  run_.reset();
  end_.reset();
  return true;
}

void MissionRunner::plan_changed(Outbox& out) {
  if (!running_ || complete_) {
    if (!running_ && current_ >= static_cast<int>(plan_.size())) restart();
    return;
  }
  if (current_ < static_cast<int>(plan_.size())) {
    next_ = std::max(current_, 1);
    run_.reset();
    out.say(MavSeverity::critical, "Auto mission changed, restarted command");
  } else {
    out.say(MavSeverity::critical, "Auto mission changed but failed to restart command");
  }
}

void MissionRunner::disarmed() {
  run_.reset();
  current_ = 0;
  next_ = 1;
  jumps_done_.clear();
}

void MissionRunner::plan_cleared() {
  run_.reset();
  current_ = 0;
  next_ = 1;
  complete_ = false;
  jumps_done_.clear();
}

MissionState MissionRunner::state() const {
  if (plan_.size() <= 1) return MissionState::no_mission;
  if (complete_) return MissionState::complete;
  return running_ ? MissionState::active : MissionState::not_started;
}

bool MissionRunner::starts_with_take_off() const {
  for (std::size_t i = 1; i < plan_.size(); ++i) {
    if (is_navigation(plan_[i].command)) return plan_[i].command == nav_takeoff;
  }
  return false;
}

Goal MissionRunner::update(FlightContext const& context, Outbox& out) {
  // A bounded number of items can be passed in one step; a circle of jumps and "do" commands cannot stop the world.
  for (int i = 0; i < 100; ++i) {
    if (!run_ && !advance(context, out)) return after_the_end(context);
    bool done = false;
    Goal const goal = fly(context, out, done);
    if (!done) return goal;
    finish(context, out);
  }
  return HoldAt{context.body.position_m};
}

Goal MissionRunner::after_the_end(FlightContext const& context) const {
  if (context.landed && context.family() != vehicle::Family::rover) return Idle{};
  return HoldAt{end_.value_or(context.body.position_m)};
}

/// Goes to the next navigation command, performing the "do" commands on the way. False at the end of the mission.
bool MissionRunner::advance(FlightContext const& context, Outbox& out) {
  if (complete_ || plan_.size() <= 1) {
    if (!end_) end_ = stopping_point(context.body, context.airframe, context.pace);
    return false;
  }
  int hops = 0;
  for (int index = next_; index < static_cast<int>(plan_.size()) && hops < 200; ++hops) {
    auto const command = plan_[static_cast<std::size_t>(index)].command;
    if (command == do_jump) {
      if (!jump(index, context, out)) ++index;
      continue;
    }
    if (can_fly(context.family(), command)) {
      begin(index, context, out);
      return true;
    }
    if (!is_navigation(command)) perform(index, context, out);
    ++index;
  }
  complete_ = true;
  end_ = stopping_point(context.body, context.airframe, context.pace);
  out.mission_current_changed = true;
  return false;
}

bool MissionRunner::jump(int& index, FlightContext const& context, Outbox& out) {
  auto const& item = plan_[static_cast<std::size_t>(index)];
  int const target = static_cast<int>(item.params[0]);
  int const times = static_cast<int>(item.params[1]);
  int& done = jumps_done_[index];
  if (target < 1 || target >= static_cast<int>(plan_.size())) return false;
  if (times >= 0 && done >= times) return false;
  ++done;
  if (context.tells_items) {
    auto const of = times < 0 ? std::string("unlimited") : std::to_string(times);
    out.say(MavSeverity::info, fmt::format("Mission: {} Jump {}/{}", index, done, of));
  }
  index = target;
  return true;
}

void MissionRunner::begin(int index, FlightContext const& context, Outbox& out) {
  auto const& item = plan_[static_cast<std::size_t>(index)];
  if (context.tells_items) out.say(MavSeverity::info, fmt::format("Mission: {} {}", index, short_name(item.command)));
  out.mission_current_changed = out.mission_current_changed || current_ != index;
  current_ = index;
  next_ = index + 1;
  landed_ = false;
  auto const here = context.body.position_m;
  run_.emplace(Run{
      .item = item, .from = here, .point = point_of(item, context.site, context.home, here), .started = context.now});
  run_->passing = item.params[0] <= 0.0F && goes_on_after(index);
  bool const dives = context.family() == vehicle::Family::sub;
  if (dives) run_->point.down = std::max(run_->point.down, 0.0);
  if (item.command == nav_land && dives) {
    run_->point.down = 0.0;  // it surfaces
  } else if (item.command == nav_land) {
    run_->descent = Landing({run_->point.north, run_->point.east, 0.0});
    run_->point.down = here.down;  // travels at its height, then sinks
  } else if (item.command == nav_return_to_launch) {
    run_->descent = ReturnHome();
    wants_return_ = context.family() == vehicle::Family::plane;
  }
}

bool MissionRunner::goes_on_after(int index) const {
  for (auto i = static_cast<std::size_t>(index) + 1; i < plan_.size(); ++i) {
    if (plan_[i].command == nav_waypoint || plan_[i].command == nav_spline_waypoint) return true;
    if (is_navigation(plan_[i].command) || plan_[i].command == do_jump) return false;
  }
  return false;
}

/// Ends the current command. ArduPilot reports the "do" commands behind it as reached too, and its one-message queue
/// keeps only the last: that is why a waypoint followed by DO_CHANGE_SPEED is reported under the speed command's
/// number.
void MissionRunner::finish(FlightContext const& context, Outbox& out) {
  out.reached = current_;
  landed_ = context.body.on_ground && !std::holds_alternative<std::monostate>(run_->descent);
  run_.reset();
}

void MissionRunner::perform(int index, FlightContext const& context, Outbox& out) {
  auto const& item = plan_[static_cast<std::size_t>(index)];
  auto const& p = item.params;
  if (context.tells_items) out.say(MavSeverity::info, fmt::format("Mission: {} {}", index, short_name(item.command)));
  out.reached = index;
  switch (item.command) {
    case do_change_speed:
      if (p[1] > 0.0F) speed_m_s_ = p[1];
      break;
    case do_set_home:
      home_ =
          p[0] == 1.0F ? context.body.position_m : point_of(item, context.site, context.home, context.body.position_m);
      break;
    case condition_yaw: yaw_rad_ = geo::wrap_pi(p[0] * std::numbers::pi / 180.0); break;
    case image_start_capture:
    case image_stop_capture:
    case do_digicam_control:
    case do_set_servo:
    case do_set_relay:
    case do_set_cam_trigg_dist:
    case do_mount_control:
    case do_gimbal_manager_pitchyaw:
    case do_set_roi:
    case do_set_roi_location:
    case do_set_roi_none: out.payload.push_back(item); break;
    case do_fence_enable: fence_ = p[0] == 1.0F; break;
    default: break;
  }
}

Goal MissionRunner::fly(FlightContext const& context, Outbox& out, bool& done) {
  auto& run = *run_;
  if (auto* home = std::get_if<ReturnHome>(&run.descent)) {
    Goal const goal = home->update(context);
    done = home->finished();
    return goal;
  }
  switch (run.item.command) {
    case nav_takeoff: return take_off(context, done);
    case nav_loiter_unlim:
    case nav_loiter_turns:
    case nav_loiter_time:
    case nav_loiter_to_alt: return loiter(context, done);
    case nav_delay:
      done = base::to_seconds(context.now - run.started) >=
             delay_s(run.item, context.utc_day_s - base::to_seconds(context.now - run.started));
      return context.landed ? Goal{Idle{}} : Goal{HoldAt{run.from}};
    case nav_guided_enable: done = true; return HoldAt{run.from};
    case nav_continue_and_change_alt: {
      double const up = context.body.position_m.down - run.point.down;
      done = std::abs(up) < 5.0 || (run.item.params[0] == 1.0F && up < 0.0) || (run.item.params[0] == 2.0F && up > 0.0);
      auto const& v = context.body.velocity_m_s;
      return Cruise{{v.north, v.east, up > 0.0 ? -context.pace.climb_m_s : context.pace.sink_m_s}};
    }
    default: return fly_to_point(context, out, done);
  }
}

bool MissionRunner::at_point(FlightContext const& context, double radius_m) const {
  return has_reached(context.body, run_->from, run_->point, radius_m);
}

Goal MissionRunner::fly_to_point(FlightContext const& context, Outbox& out, bool& done) {
  auto& run = *run_;
  if (auto* landing = std::get_if<Landing>(&run.descent)) {
    bool const wing = context.family() == vehicle::Family::plane;
    if (!run.arrived && (wing || context.body.on_ground || at_point(context, 1.0))) run.arrived = context.now;
    if (!run.arrived) return FlyTo{run.point, run.from, false};
    Goal const goal = landing->update(context);
    // A plane's landing never counts as done; it disarms after a while on the ground.
    done = landing->finished() && !wing;
    return goal;
  }
  bool const climbs = context.family() == vehicle::Family::copter || context.family() == vehicle::Family::sub;
  bool const level =
      !climbs || std::abs(context.body.position_m.down - run.point.down) < context.tuning.waypoint_radius_m;
  if (!run.arrived && level && at_point(context, context.tuning.waypoint_radius_m)) {
    run.arrived = context.now;
  }
  // A plane does not wait at waypoints.
  double const hold_s = context.family() == vehicle::Family::plane ? 0.0 : static_cast<double>(run.item.params[0]);
  done = run.arrived && base::to_seconds(context.now - *run.arrived) >= hold_s;
  if (done && context.tells_items) {
    bool const copter = context.family() == vehicle::Family::copter;
    double const off =
        std::hypot(run.point.north - context.body.position_m.north, run.point.east - context.body.position_m.east);
    out.say(MavSeverity::info, copter ? fmt::format("Reached command #{}", current_)
                                      : fmt::format("Reached waypoint #{} dist {:.0f}m", current_, off));
  }
  if (run.arrived && hold_s > 0.0) return HoldAt{run.point};
  return FlyTo{run.point, run.from, run.passing};
}

Goal MissionRunner::take_off(FlightContext const& context, bool& done) {
  auto const& run = *run_;
  double const heading = context.body.attitude.yaw_rad;
  double const missing = context.body.position_m.down - run.point.down;
  done = missing < 0.3;
  return TakeOff{{run.from.north, run.from.east, 0.0}, -run.point.down, heading};
}

void MissionRunner::count_turns(FlightContext const& context) {
  auto& run = *run_;
  double const bearing =
      std::atan2(context.body.position_m.east - run.point.east, context.body.position_m.north - run.point.north);
  if (run.arrived) run.turned_rad += std::abs(geo::wrap_pi(bearing - run.last_bearing_rad));
  run.last_bearing_rad = bearing;
}

Goal MissionRunner::loiter(FlightContext const& context, bool& done) {
  auto& run = *run_;
  auto const& p = run.item.params;
  bool const wing = context.family() == vehicle::Family::plane;
  bool const turns = run.item.command == nav_loiter_turns;
  bool const circles = wing || turns;
  double const own = wing ? context.pace.loiter_radius_m : copter_circle_radius_m;
  // LOITER_TIME keeps only the sense of its radius (read back as 1); the others keep the radius.
  double const radius = run.item.command == nav_loiter_time ? own : radius_or(p[2], own);
  count_turns(context);
  double const near = circles ? 1.2 * std::abs(radius) + 2.0 : context.tuning.waypoint_radius_m;
  bool const level = std::abs(context.body.position_m.down - run.point.down) < 10.0;
  if (!run.arrived && level && has_reached(context.body, run.point, run.point, near)) run.arrived = context.now;
  if (run.arrived) {
    double const waited = base::to_seconds(context.now - *run.arrived);
    if (turns) done = run.turned_rad >= 2.0 * std::numbers::pi * std::max(1.0, static_cast<double>(p[0]));
    if (run.item.command == nav_loiter_time) done = waited >= p[0];
    if (run.item.command == nav_loiter_to_alt) done = std::abs(context.body.position_m.down - run.point.down) < 5.0;
  }
  if (circles && (run.arrived || wing)) return Circle{run.point, radius};
  if (run.arrived) return HoldAt{run.point};
  return FlyTo{run.point, run.from, false};
}

}  // namespace lapwing::sim
