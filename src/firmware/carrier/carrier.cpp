#include "firmware/carrier/carrier.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::firmware {

Carrier::Carrier(Description const& description, Tuning const& tuning)
    : body_(description),
      tuning_(tuning),
      left_(tuning, description.pulses_per_m),
      right_(tuning, description.pulses_per_m),
      heading_(tuning),
      surroundings_(description, tuning),
      safe_distance_(tuning, description.braking_m_s2) {}

// ---- commands ----

void Carrier::take(Time now, FromHost const& record, Outbox& out) {
  if (std::holds_alternative<Hail>(record)) return begin_anew();
  heard_ = now;
  if (std::holds_alternative<Kill>(record)) return kill(now, out);
  if (std::holds_alternative<Release>(record)) return release(now, out);
  if (auto const* const drive = std::get_if<Drive>(&record)) return accept(now, *drive, out);
  if (auto const* const turn = std::get_if<Turn>(&record)) return accept(now, *turn, out);
  if (auto const* const stop = std::get_if<Stop>(&record)) return accept(now, *stop, out);
}

/// Another host, or the same one after it was away, counts its commands from one again.
void Carrier::begin_anew() {
  drop();
  last_number_ = 0;
  completed_ = 0;
}

void Carrier::kill(Time now, Outbox& out) {
  if (!is_killed_) out.log(now, LogCode::killed);
  is_killed_ = true;
  drop();
  ramped_ = {};
  left_.rest();
  right_.rest();
}

void Carrier::release(Time now, Outbox& out) {
  if (is_killed_) out.log(now, LogCode::released);
  is_killed_ = false;
}

bool Carrier::needs_heading(Command const& command) const {
  auto const* const drive = std::get_if<Drive>(&command);
  return std::holds_alternative<Turn>(command) || (drive != nullptr && drive->by == Drive::By::heading);
}

template <class Order>
void Carrier::accept(Time now, Order const& order, Outbox& out) {
  if (order.number == last_number_) {
    // Said again because the answer was lost, or has not come yet.
    if (order.number == completed_) out.completed.push({.number = completed_});
    return;
  }
  if (is_killed_ || (needs_heading(order) && heading_.is_silent(now)))
    return out.log(now, LogCode::refused, order.number);
  command_ = order;
  heading_integral_rad_s_ = 0;
  last_number_ = order.number;
  reached_since_.reset();
  has_watchdog_bitten_ = false;
  // Who steers gives a command ten times a second: a wheel that is being watched must not be watched anew each time.
  if (left_.is_dead()) left_.forgive();
  if (right_.is_dead()) right_.forgive();
}

void Carrier::drop() {
  command_ = std::monostate{};
  reached_since_.reset();
}

// ---- control ----

void Carrier::control(Time now, Pulses const& pulses, Outbox& out) {
  Time const period = now - last_control_;
  last_control_ = now;
  left_.feel(now, pulses.left);
  right_.feel(now, pulses.right);
  look_for_slip(period, now, out);
  if (is_killed_) return;
  look_for_faults(now, out);
  // A longer pause than this is a board that stood still, not one that ramps.
  float const period_s = std::min(to_seconds(period), 3 * to_seconds(tuning_.control_period));
  Motion const safe_motion = safe(now, wanted(period_s), out);
  ramped_ = ramp(ramped_, safe_motion, period_s, tuning_, body_.braking_m_s2);
  // What keeps the distance counts the braking already, so that it need not be made gentler.
  if (is_too_near_) ramped_ = safe_motion;
  auto const speeds = wheel_speeds(ramped_, body_);
  (void)left_.drive(now, speeds.left_m_s);
  (void)right_.drive(now, speeds.right_m_s);
  look_for_completion(now, out);
}

void Carrier::look_for_faults(Time now, Outbox& out) {
  if (std::holds_alternative<std::monostate>(command_)) return;
  if (now - heard_ > tuning_.watchdog) {
    has_watchdog_bitten_ = true;
    out.log(now, LogCode::watchdog);
    drop();
  }
  if (left_.is_dead() || right_.is_dead()) {
    out.log(now, left_.is_dead() ? LogCode::left_wheel_dead : LogCode::right_wheel_dead);
    drop();
    left_.rest();
    right_.rest();
    ramped_ = {};
  }
  if (heading_.is_silent(now) && needs_heading(command_)) {
    out.log(now, LogCode::imu_silent);
    drop();
  }
}

void Carrier::look_for_slip(Time period, Time now, Outbox& out) {
  float const difference = std::abs(motion().turn_rad_s - heading_.rate_rad_s());
  bool const differs = !heading_.is_silent(now) && difference > tuning_.slip_rad_s;
  slipping_for_ = differs ? slipping_for_ + period : Time{0};
  bool const is_slipping = slipping_for_ >= tuning_.slip_after;
  if (is_slipping && !is_slipping_) out.log(now, LogCode::slipping);
  is_slipping_ = is_slipping;
}

Motion Carrier::wanted(float period_s) {
  if (auto const* const turn = std::get_if<Turn>(&command_)) {
    float const error = wrapped(turn->heading_rad - heading_.heading_rad());
    // Good enough to stand: friction would have the wheels jerk about the last tenths of a degree for ever.
    bool const is_there = std::abs(error) < tuning_.angle_error_rad / 2;
    return {.speed_m_s = 0, .turn_rad_s = is_there ? 0.0F : turn_for(error, tuning_)};
  }
  auto const* const drive = std::get_if<Drive>(&command_);
  return drive == nullptr ? Motion{} : wanted_by(*drive, period_s);
}

Motion Carrier::wanted_by(Drive const& drive, float period_s) {
  float const speed = std::clamp(drive.speed_m_s, -body_.top_speed_m_s, body_.top_speed_m_s);
  if (drive.by == Drive::By::rate) return {.speed_m_s = speed, .turn_rad_s = drive.turn};
  float const error = wrapped(drive.turn - heading_.heading_rad());
  float const part = std::max(0.0F, 1 - std::abs(error) / tuning_.drive_error_rad);
  float const most = tuning_.most_heading_integral_rad_s;
  // Not while it turns towards a new heading: that error is none of the wheels'.
  if (part > 0.5F)
    heading_integral_rad_s_ =
        std::clamp(heading_integral_rad_s_ + tuning_.heading_integral_per_s2 * error * period_s, -most, most);
  return {.speed_m_s = speed * part, .turn_rad_s = turn_for(error, tuning_) + heading_integral_rad_s_};
}

Motion Carrier::safe(Time now, Motion wanted, Outbox& out) {
  bool const was_near = is_too_near_;
  if (std::holds_alternative<std::monostate>(command_)) safe_distance_.rest();
  auto const answer = safe_distance_.limit(now, wanted.speed_m_s, surroundings_.clearance(way_m()), way_m());
  is_too_near_ = answer.rules;
  if (is_too_near_ != was_near) out.log(now, is_too_near_ ? LogCode::too_near : LogCode::far_enough);
  if (answer.has_gone_back_too_far && !has_gone_back_too_far_) out.log(now, LogCode::no_way_back);
  has_gone_back_too_far_ = answer.has_gone_back_too_far;
  bool const goes_back = answer.speed_m_s * wanted.speed_m_s < 0;
  if (answer.speed_m_s != wanted.speed_m_s) {
    // Never faster than the rule leaves, even while a ramp comes down.
    float const most = std::abs(answer.speed_m_s);
    ramped_.speed_m_s = std::clamp(ramped_.speed_m_s, -most, most);
  }
  return {.speed_m_s = answer.speed_m_s, .turn_rad_s = goes_back ? 0.0F : wanted.turn_rad_s};
}

// ---- completion ----

bool Carrier::is_reached() const {
  auto const now_moving = motion();
  bool const is_standing =
      std::abs(left_.speed_m_s()) < tuning_.speed_error_m_s && std::abs(right_.speed_m_s()) < tuning_.speed_error_m_s;
  if (std::holds_alternative<Stop>(command_)) return is_standing;
  if (is_too_near_) return false;
  auto const is_at = [&](float heading_rad) {
    return std::abs(wrapped(heading_rad - heading_.heading_rad())) < tuning_.angle_error_rad;
  };
  if (auto const* const turn = std::get_if<Turn>(&command_)) return is_standing && is_at(turn->heading_rad);
  auto const* const drive = std::get_if<Drive>(&command_);
  if (drive == nullptr) return false;
  float const speed = std::clamp(drive->speed_m_s, -body_.top_speed_m_s, body_.top_speed_m_s);
  bool const is_fast = std::abs(now_moving.speed_m_s - speed) < tuning_.speed_error_m_s;
  bool const is_turned = drive->by == Drive::By::heading
                             ? is_at(drive->turn)
                             : std::abs(heading_.rate_rad_s() - drive->turn) < tuning_.turn_rate_error_rad_s;
  return is_fast && is_turned;
}

void Carrier::look_for_completion(Time now, Outbox& out) {
  auto const number = command();
  if (number == 0 || number == completed_) return;
  if (!is_reached()) return reached_since_.reset();
  if (!reached_since_) reached_since_ = now;
  if (now - *reached_since_ < tuning_.settle) return;
  completed_ = number;
  out.completed.push({.number = number});
  if (std::holds_alternative<Stop>(command_)) drop();
}

// ---- what it says of itself ----

CommandNumber Carrier::command() const {
  CommandNumber number = 0;
  if (auto const* const drive = std::get_if<Drive>(&command_)) number = drive->number;
  if (auto const* const turn = std::get_if<Turn>(&command_)) number = turn->number;
  if (auto const* const stop = std::get_if<Stop>(&command_)) number = stop->number;
  return number;
}

Motion Carrier::motion() const {
  return motion_of({.left_m_s = left_.speed_m_s(), .right_m_s = right_.speed_m_s()}, body_);
}

std::uint16_t Carrier::flags(Time now) const {
  std::uint32_t flags = 0;
  auto const set = [&](Flag flag, bool holds) { flags |= holds ? bit(flag) : 0U; };
  set(Flag::killed, is_killed_);
  set(Flag::too_near, is_too_near_);
  set(Flag::watchdog, has_watchdog_bitten_);
  set(Flag::left_wheel_dead, left_.is_dead());
  set(Flag::right_wheel_dead, right_.is_dead());
  set(Flag::imu_silent, heading_.is_silent(now));
  set(Flag::slipping, is_slipping_);
  return static_cast<std::uint16_t>(flags);
}

}  // namespace lapwing::firmware
