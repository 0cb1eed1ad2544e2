#include <cmath>

#include "autonomy/states/transitions.hpp"

// What the machine finds out by itself.

namespace lapwing::autonomy {

namespace {

/// In Arm nothing moves yet, and the flight controller may still be starting.
bool has_failed(Situation const& s) {
  if (s.memory.state == State::arm && !s.memory.was_armed) return process_failure(s).has_value();
  return failure_of(s).has_value();
}

bool is_battery_low(Situation const& s) {
  auto const& flight = s.told.flight;
  return flight && flight->battery && *flight->battery < reserve_here(s);
}

/// Somebody else has the word: the mode that was wanted was seen and is gone, or does not come.
bool is_out_of_hand(Situation const& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || flight->mode == guided) return false;
  auto const& mode = s.memory.mode;
  return mode.is_seen || (mode.first_asked && s.now - *mode.first_asked > s.options.mode_patience);
}

bool was_found_flying(Situation const& s) {
  return !s.memory.has_met_flight_controller && !s.memory.is_killed && heard_flight(s) != nullptr && is_in_the_air(s) &&
         is_in_mode(s, guided);
}

bool arming_gave_up(Situation const& s) {
  auto const& memory = s.memory;
  if (is_armed(s)) return false;
  bool const has_asked_enough = memory.arm_requests >= s.options.most_arm_requests && s.now >= memory.next_arm_request;
  return has_asked_enough || s.now - memory.unarmed_since > s.options.arm_patience;
}

bool climb_gave_up(Situation const& s) {
  auto const longest = base::from_seconds(s.memory.heights.desired_m / s.options.slowest_climb_m_s);
  return s.now - s.memory.entered > longest + s.options.spool_up;
}

bool has_height(Situation const& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || !flight->is_armed || !flight->relative_alt_m) return false;
  double const height_m = *flight->relative_alt_m;
  // Who is up already is not taken up: nothing was asked for, and nothing is waited for.
  bool const was_up = s.memory.next_takeoff == base::TimePoint::max();
  return was_up || std::abs(height_m - s.memory.heights.desired_m) <= s.options.height_reached_m;
}

std::optional<double> distance_to_target_m(Situation const& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || !s.memory.target) return std::nullopt;
  if (auto const* const place = std::get_if<geo::Point<ArmingFrame>>(&s.memory.target->place)) {
    if (!flight->local) return std::nullopt;
    return std::hypot(place->x() - flight->local->x(), place->y() - flight->local->y());
  }
  if (!flight->position) return std::nullopt;
  return geo::surface_distance_m(*flight->position, std::get<geo::Wgs84>(s.memory.target->place));
}

bool is_there(Situation const& s) {
  auto const far_m = distance_to_target_m(s);
  if (!far_m || *far_m > s.options.place_reached_m) return false;
  auto const height_m = heard_flight(s)->relative_alt_m;
  return height_m && std::abs(*height_m - s.memory.heights.desired_m) <= s.options.place_reached_m &&
         (s.memory.state != State::autonomous_move || s.memory.is_agreed);
}

bool is_outside(Situation const& s) {
  auto const& verdict = s.told.place;
  return verdict && !verdict->is_in_lot && verdict->at - s.memory.entered >= s.options.verdict_settles;
}

}  // namespace

bool happens(Event event, Situation const& s) {
  using enum Event;
  switch (event) {
    case failure: return has_failed(s);
    case link_lost: return is_link_lost(s);
    case battery_low: return is_battery_low(s);
    case disarmed: return is_heard_disarmed(s);
    case returns_by_itself: return is_out_of_hand(s) && is_coming_down(s);
    case flown_by_hand: return is_out_of_hand(s) && !is_coming_down(s) && !s.memory.is_flown_by_hand;
    case found_flying: return was_found_flying(s);
    case configured: return true;
    case gave_up: return s.memory.state == State::arm ? arming_gave_up(s) : climb_gave_up(s);
    case height_reached: return has_height(s);
    case place_reached: return is_there(s);
    case place_outside: return is_outside(s);
    case no_verdict: return !s.memory.is_agreed && s.now - s.memory.entered > s.options.verdict_patience;
    case lot_lost: return s.told.sees_lot == false;
    case link_back: return s.told.link.is_up && !is_link_lost(s);
    default: return false;
  }
}

}  // namespace lapwing::autonomy
