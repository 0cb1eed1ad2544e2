#include <fmt/core.h>

#include <cmath>

#include "sim/autopilot.hpp"
#include "sim/guidance.hpp"
#include "sim/px4_modes.hpp"

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
  goal_ = armed_ ? fly(flight) : Goal{StandStill{}};
  leave_take_off();
  if (battery_.remaining() <= 0.0) goal_ = StandStill{};
  body_ = sim::step(body_, steer(goal_, body_, airframe_, pace_), airframe_, wind_m_s, dt_s);
  battery_.drain(current_drawn_a(body_, airframe_, armed_), dt_s);
  if (armed_ && !body_.on_ground) has_flown_ = true;
  notice_touch_down();
  disarm_when_idle();
  repeat_prearm_fault();
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
                     [&](ReturnHome& logic) {
                       Goal const next = logic.update(flight);
                       bool const at_once = airframe_.family == Family::copter && !kind_.is_px4();
                       if (logic.finished() && at_once) do_disarm(words_.disarmed_after_landing);
                       return next;
                     },
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
  if (!body_.on_ground) take_off_allowed_ = true;
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
/// home and circles; a rover stops; an underwater vehicle holds.
void Autopilot::end_mission(FlightContext const& flight) {
  if (kind_.is_px4()) {
    outbox_.say(MavSeverity::info, "Mission finished, loitering.");
    return;
  }
  if (flight.family() == Family::copter) {
    if (body_.on_ground) do_disarm(words_.disarmed_after_landing);
    return;
  }
  if (flight.family() == Family::sub) return;
  if (flight.family() == Family::plane) {
    outbox_.say(MavSeverity::notice, "Mission complete, changing mode to RTL");
    change_mode(mode_for(kind_, Behaviour::return_home).number);
    return;
  }
  outbox_.say(MavSeverity::notice, "Mission Complete");
  change_mode(mode_for(kind_, Behaviour::hold).number);
}

/// A copter on the ground only leaves it by a take-off, and only when its motors have spooled up.
Goal Autopilot::hold_on_the_ground(Goal goal, FlightContext const& flight) {
  if (flight.family() != Family::copter || !body_.on_ground) {
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

void Autopilot::act(Behaviour behaviour) {
  if (!armed_ || mode_->behaviour == behaviour || mode_->behaviour == Behaviour::land) return;
  auto const& mode = mode_for(kind_, behaviour);
  bool const can_land = airframe_.family == Family::copter || airframe_.family == Family::sub;
  if (mode.needs_position && !navigation_.position_ok) {
    if (can_land && behaviour != Behaviour::land) act(Behaviour::land);
    return;
  }
  change_mode(mode.number);
}

void Autopilot::watch_health() {
  watch_ground_station();
  watch_gps();
  watch_estimate();
  watch_battery();
  watch_fence();
  watch_setpoints();
}

/// PX4 leaves OFFBOARD when nobody guides it any more.
void Autopilot::watch_setpoints() {
  if (mode_->number != px4_offboard || !kind_.is_px4() || !setpoint_heard_) return;
  if (now_ - *setpoint_heard_ <= tuning_.guided_timeout) return;
  outbox_.say(MavSeverity::warning, "Failsafe activated: no offboard signal");
  change_mode(mode_for(kind_, Behaviour::hold).number);
}

void Autopilot::watch_ground_station() {
  auto const event = ground_station_.update(now_, safety_.watches_ground_station, safety_.ground_station_patience);
  if (event == GroundStationWatch::Event::returned)
    outbox_.say(MavSeverity::warning, std::string(words_.ground_station_back));
  if (event != GroundStationWatch::Event::lost) return;
  outbox_.say(MavSeverity::warning, std::string(words_.ground_station_lost));
  bool const goes_on = safety_.keeps_mission && mode_->behaviour == Behaviour::mission;
  if (safety_.on_ground_station_lost && !goes_on) act(*safety_.on_ground_station_lost);
}

void Autopilot::watch_gps() {
  if (safety_.gps_is_cut_off == gps_is_cut_off_) return;
  gps_is_cut_off_ = safety_.gps_is_cut_off;
  if (gps_is_cut_off_) {
    lose_gps();
  } else {
    restore_gps();
  }
}

void Autopilot::watch_estimate() {
  bool const failed = start_up_.estimate_lost(now_);
  if (failed && !estimate_failed_ && armed_) {
    outbox_.say(MavSeverity::critical, "EKF variance");
    bool const matters = mode_->needs_position || safety_.in_every_mode;
    if (safety_.on_estimate_lost && matters) {
      act(*safety_.on_estimate_lost);
      outbox_.say(MavSeverity::critical, fmt::format("EKF Failsafe: changed to {} Mode", mode_->name));
    }
  }
  estimate_failed_ = failed && (estimate_failed_ || armed_);
}

void Autopilot::watch_battery() {
  auto const reached = battery_watch_.update(now_, battery_, safety_.battery);
  if (!reached) return;
  bool const critical = *reached == BatteryWatch::Level::critical;
  outbox_.say(MavSeverity::warning,
              fmt::format("Battery 1 is {} {:.2f}V used {:.0f} mAh", critical ? "critical" : "low",
                          battery_.voltage_v(), battery_.used_mah()));
  auto const action = critical ? safety_.on_critical_battery : safety_.on_low_battery;
  if (!action) return;
  outbox_.say(MavSeverity::warning, std::string(words_.battery_acted));
  act(*action);
}

void Autopilot::watch_fence() {
  auto const fresh = fence_.update({.body = body_,
                                    .site = site_,
                                    .home = home_,
                                    .plan = plans_.fence,
                                    .settings = safety_.fence,
                                    .position_ok = navigation_.position_ok,
                                    .now = now_});
  if (fence_.breached() == 0) fence_took_over_ = false;
  if (fresh == 0 || !armed_) return;
  outbox_.say(MavSeverity::notice, std::string(words_.fence_breached));
  if (!safety_.fence.action) return;
  act(*safety_.fence.action);
  fence_took_over_ = true;
}

void Autopilot::notice_touch_down() {
  if (!body_.touch_down_m_s || airframe_.family == Family::rover || kind_.is_px4()) return;
  outbox_.say(MavSeverity::info, fmt::format("SIM Hit ground at {:.2f} m/s", *body_.touch_down_m_s));
}

void Autopilot::disarm_when_idle() {
  auto const delay = has_flown_ ? tuning_.disarm_delay_landed : tuning_.disarm_delay;
  bool const idle = armed_ && body_.on_ground && body_.ground_speed_m_s() < 0.1 && !lift_at_ &&
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
  auto const objection = arming_fault_.empty() ? fence_.objection() : arming_fault_;
  if (armed_ || objection.empty() || now_ < start_up_.timeline().prearm_ok || now_ < next_prearm_text_) return;
  outbox_.say(MavSeverity::critical, fmt::format("{}{}", words_.unfit, objection));
  next_prearm_text_ = now_ + prearm_repeat_time;
}

}  // namespace lapwing::sim
