#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/autopilot/autopilot.hpp"
#include "sim/guidance/guidance.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;
using mavlink::MavSeverity;
using vehicle::Family;

namespace {

constexpr base::Duration spool_up_time = 3s;
constexpr base::Duration prearm_repeat_time = 30s;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

}  // namespace

void Autopilot::step(base::Duration now, geo::Ned wind_m_s, double utc_day_s, double dt_s) {
  bool const had_home = home().has_value();
  now_ = now;
  navigation_ = start_up_.at(now_);
  if (!had_home && home()) outbox_.home_changed = true;
  read_parameters();
  watch_health();
  auto const flight = context(utc_day_s);
  if (has_nothing_to_fly()) end_mission(flight);
  goal_ = armed_ ? kept_in_the_fence(fly(flight)) : Goal{StandStill{}};
  leave_take_off();
  if (battery_.remaining() <= 0.0) goal_ = StandStill{};
  body_ = sim::step(body_, steer(goal_, body_, airframe_, pace_), airframe_, wind_m_s, dt_s);
  battery_.drain(current_drawn_a(body_, airframe_, armed_), dt_s);
  notice_landing();
  if (armed_ && !landed_) has_flown_ = true;
  follow_trail();
  notice_touch_down();
  disarm_when_idle();
  repeat_prearm_fault();
}

template <class Way>
Goal Autopilot::go_home(Way& way, FlightContext const& flight) {
  bool const had_finished = way.finished();
  Goal const goal = way.update(flight);
  if (!way.finished() || had_finished || kind_.is_px4()) return goal;
  if (airframe_.family == Family::copter) do_disarm(words_.disarmed_after_landing);
  if (airframe_.family == Family::rover) outbox_.say(MavSeverity::info, "Reached destination");
  return goal;
}

Goal Autopilot::fly(FlightContext const& flight) {
  if (mode_->behaviour == Behaviour::mission) return hold_on_the_ground(fly_mission(flight), flight);
  if (mode_->behaviour == Behaviour::sink) return body_.on_ground ? Goal{Idle{}} : Goal{Sink{}};
  if (mode_->behaviour == Behaviour::manual) {
    // With the throttle stick down a rotorcraft falls; wheels and wings come to rest or glide by themselves.
    return body_.on_ground || airframe_.family != Family::copter ? Goal{Idle{}} : Goal{StandStill{}};
  }
  Goal const goal =
      std::visit(Overloaded{
                     [&](Guided& logic) { return logic.update(flight); },
                     [&](Landing& logic) {
                       Goal const next = logic.update(flight);
                       if (logic.finished() && !kind_.is_px4()) do_disarm(words_.disarmed_after_landing);
                       return next;
                     },
                     [&](ReturnHome& logic) { return go_home(logic, flight); },
                     [&](Retrace& logic) { return go_home(logic, flight); },
                     [](Circle const& logic) { return Goal{logic}; },
                     [](HoldAt const& logic) { return Goal{logic}; },
                     [&](TakeOff const& logic) {
                       if (body_.height_m() < logic.height_m) return Goal{logic};
                       return Goal{HoldAt{{body_.position_m.north, body_.position_m.east, -logic.height_m}}};
                     },
                     [](std::monostate) { return Goal{Idle{}}; },
                 },
                 logic_);
  return armed_ ? hold_on_the_ground(goal, flight) : Goal{StandStill{}};
}

Goal Autopilot::fly_mission(FlightContext const& flight) {
  if (!landed_) take_off_allowed_ = true;
  bool const waits_for_throttle =
      airframe_.family == Family::copter && !take_off_allowed_ && !tuning_.take_off_without_throttle;
  if (waits_for_throttle) return Idle{};
  bool const was_complete = mission_.complete();
  Goal goal = mission_.update(flight, outbox_);
  if (auto const speed = mission_.take_speed()) change_speed(*speed);
  if (auto const home = mission_.take_home()) set_home(*home);
  if (auto const enabled = mission_.take_fence()) enable_fence(*enabled);
  if (auto const yaw = mission_.yaw_rad()) pace_.yaw_rad = yaw;
  if (mission_.complete() && !was_complete) end_mission(flight);
  if (mission_.take_return() && !kind_.is_px4()) change_mode(mode_for(kind_, Behaviour::return_home).number);
  // PX4 lifts off by itself where its mission begins with a waypoint.
  auto const* way = std::get_if<FlyTo>(&goal);
  if (kind_.is_px4() && airframe_.family == Family::copter && body_.on_ground && way)
    goal = TakeOff{body_.position_m, -way->point.down, body_.attitude.yaw_rad};
  return armed_ ? goal : Goal{StandStill{}};
}

/// PX4 holds once it is up.
void Autopilot::leave_take_off() {
  if (!kind_.is_px4() || !armed_ || mode_->behaviour != Behaviour::take_off) return;
  auto const* climb = std::get_if<TakeOff>(&logic_);
  if (!climb || body_.height_m() < climb->height_m - 0.2) return;
  take_off_height_m_.reset();
  change_mode(mode_for(kind_, Behaviour::hold).number);
}

/// What each family does after its last item: a copter holds, or disarms when it stands on the ground; a plane flies
/// home and circles; a rover stops, but stays in AUTO and armed; an underwater vehicle holds.
void Autopilot::end_mission(FlightContext const& flight) {
  if (kind_.is_px4()) {
    outbox_.say(MavSeverity::info, "Mission finished, loitering.");
    return;
  }
  if (flight.family() == Family::copter) {
    if (landed_) do_disarm(words_.disarmed_after_landing);
    return;
  }
  if (flight.family() == Family::sub) return;
  if (flight.family() == Family::plane) {
    outbox_.say(MavSeverity::info, "Mission complete, changing mode to RTL");
    change_mode(mode_for(kind_, Behaviour::return_home).number);
    return;
  }
  outbox_.say(MavSeverity::notice, "Mission Complete");
}

/// An aeroplane in AUTO without a mission is at its end at once, disarmed, too.
bool Autopilot::has_nothing_to_fly() const {
  return airframe_.family == Family::plane && !kind_.is_px4() && mode_->behaviour == Behaviour::mission &&
         plans_.mission.size() <= 1;
}

/// A landed copter only leaves it by a take-off, and only when its motors have spooled up.
Goal Autopilot::hold_on_the_ground(Goal goal, FlightContext const& flight) {
  if (flight.family() != Family::copter || !landed_) {
    lift_at_.reset();
    return goal;
  }
  if (!std::holds_alternative<TakeOff>(goal)) {
    lift_at_.reset();
    return Idle{};
  }
  if (!lift_at_) lift_at_ = now_ + spool_up_time;
  return now_ < *lift_at_ ? Goal{Idle{}} : goal;
}

/// Where ArduPilot's avoidance is on, a velocity setpoint takes no vehicle nearer to its fence than the margin.
Goal Autopilot::kept_in_the_fence(Goal goal) const {
  auto const* const cruise = std::get_if<Cruise>(&goal);
  auto const* const steered = std::get_if<Steer>(&goal);
  auto const family = airframe_.family;
  bool const avoids = tuning_.avoids_fence && (family == Family::copter || family == Family::rover);
  if ((!cruise && !steered) || !avoids || !fence_enabled() || fence_.breached() != 0) return goal;
  double const yaw = body_.attitude.yaw_rad;
  auto const v = cruise ? cruise->velocity_m_s
                        : geo::Ned{steered->speed_m_s * std::cos(yaw), steered->speed_m_s * std::sin(yaw), 0.0};
  auto const slowed = [&](double share) -> Goal {
    if (steered) return Steer{steered->speed_m_s * share, steered->turn_rate_rad_s};
    return Cruise{{v.north * share, v.east * share, v.down}};
  };
  double const speed = std::hypot(v.north, v.east);
  double const reach_s = 1.0 + speed / (2.0 * std::max(0.5, pace_.accel_m_s2));
  for (double const share : {1.0, 0.5, 0.25, 0.1}) {
    geo::Ned point = body_.position_m;
    double const margin_s = speed > 0.0 ? safety_.fence.margin_m / speed : 0.0;
    point.north += v.north * (reach_s * share * share + margin_s);
    point.east += v.east * (reach_s * share * share + margin_s);
    if (fence_.allows(point, home_, safety_.fence)) return slowed(share);
  }
  return slowed(0.0);
}

void Autopilot::follow_trail() {
  bool const can_retrace = mode_for(kind_, Behaviour::retrace).behaviour == Behaviour::retrace;
  if (!can_retrace || tuning_.trail.most_points == 0) return;
  if (!armed_ || !navigation_.position_ok || mode_->behaviour == Behaviour::retrace) return;
  if (!trail_.note(body_.position_m, tuning_.trail))
    outbox_.say(MavSeverity::warning, "SmartRTL deactivated: buffer full");
}

/// ArduPilot's copter lands by descending to rest where it was to descend. One that meets the ground on its way to a
/// place below it goes on: to itself it flies.
void Autopilot::notice_landing() {
  bool const knows_better = kind_.is_px4() || airframe_.family != Family::copter;
  bool const flies_on = std::visit(Overloaded{
                                       [](HoldAt const&) { return true; },
                                       [](FlyTo const&) { return true; },
                                       [](Circle const&) { return true; },
                                       [](TakeOff const&) { return true; },
                                       [](Cruise const&) { return true; },
                                       [](auto const&) { return false; },
                                   },
                                   goal_);
  if (knows_better || !body_.on_ground || !flies_on) landed_ = body_.on_ground;
}

void Autopilot::notice_touch_down() {
  if (!body_.touch_down_m_s || airframe_.family == Family::rover || kind_.is_px4()) return;
  outbox_.say(MavSeverity::info, fmt::format("SIM Hit ground at {:.2f} m/s", *body_.touch_down_m_s));
}

void Autopilot::disarm_when_idle() {
  auto const delay = has_flown_ ? tuning_.disarm_delay_landed : tuning_.disarm_delay;
  bool const idle = armed_ && landed_ && body_.ground_speed_m_s() < 0.1 && !lift_at_ &&
                    delay > base::Duration::zero() &&
                    (airframe_.family == Family::copter || std::holds_alternative<Idle>(goal_));
  // An aeroplane that has not flown waits for its take-off; only a landed one is disarmed.
  if (!idle || (airframe_.family == Family::plane && mode_->behaviour != Behaviour::mission)) {
    idle_since_.reset();
    return;
  }
  if (!idle_since_) idle_since_ = now_;
  if (now_ - *idle_since_ >= delay) do_disarm(words_.disarmed_after_landing);
}

void Autopilot::repeat_prearm_fault() {
  auto const why = arming_fault_.empty() ? objection() : arming_fault_;
  if (armed_ || why.empty() || now_ < start_up_.timeline().prearm_ok || now_ < next_prearm_text_) return;
  outbox_.say(MavSeverity::critical, fmt::format("{}{}", words_.unfit, why));
  next_prearm_text_ = now_ + prearm_repeat_time;
}

}  // namespace lapwing::sim
