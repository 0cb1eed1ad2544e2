#include "autonomy/states/asking.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::autonomy {

namespace {

using namespace std::chrono_literals;

/// Nobody waits a second for motors to stop.
base::Duration constexpr kill_period = 250ms;

/// Blindly, too, as long as nothing is heard: what is not heard may yet hear.
void ask(Situation& s, std::string_view mode) {
  auto& wanted = s.memory.mode;
  if (heard_flight(s) != nullptr && !wanted.first_asked) wanted.first_asked = s.now;
  if (s.now < wanted.next_ask) return;
  wanted.next_ask = s.now + s.options.repeat;
  s.said.requests.emplace_back(request::Mode{mode});
}

}  // namespace

void want_mode(Situation& s) {
  s.memory.mode = {.next_ask = s.now};
}

void ask_for_mode(Situation& s, std::string_view mode) {
  auto& wanted = s.memory.mode;
  wanted.is_seen = wanted.is_seen || is_in_mode(s, mode);
  if (!wanted.is_seen) ask(s, mode);
}

void ask_to_return(Situation& s) {
  auto& wanted = s.memory.mode;
  wanted.is_seen = wanted.is_seen || is_coming_down(s);
  if (wanted.is_seen) return;
  bool const is_refused = wanted.first_asked && s.now - *wanted.first_asked > s.options.mode_patience;
  ask(s, is_refused ? land_here : return_home);
}

void insist_on_disarming(Situation& s) {
  auto& memory = s.memory;
  if (!memory.disarms_until) return;
  if (s.now >= *memory.disarms_until) {
    if (is_armed(s)) tell(s, "the flight controller does not disarm: see its messages, or use Kill");
    memory.disarms_until.reset();
  } else if (is_armed(s) && s.now >= memory.next_arm_request) {
    memory.next_arm_request = s.now + s.options.repeat;
    s.said.requests.emplace_back(request::Arm{.is_to_arm = false});
  }
}

void insist_on_kill(Situation& s) {
  auto& memory = s.memory;
  bool const is_done = is_heard_disarmed(s) && s.now - memory.killed >= s.options.kill_holds;
  memory.is_killed = memory.is_killed && !is_done;
  if (!memory.is_killed || s.now < memory.next_arm_request) return;
  memory.next_arm_request = s.now + kill_period;
  s.said.requests.emplace_back(request::Arm{.is_to_arm = false, .by_force = true});
}

std::optional<geo::Point3<ArmingFrame>> place_to_hold(Situation const& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || !flight->local) return std::nullopt;
  auto const& heights = s.memory.heights;
  double const height_m = std::clamp(flight->relative_alt_m.value_or(heights.desired_m), heights.min_m, heights.max_m);
  return geo::Point3<ArmingFrame>(flight->local->x(), flight->local->y(), height_m);
}

bool is_setpoint_due(Situation& s) {
  if (s.now < s.memory.next_setpoint) return false;
  s.memory.next_setpoint = s.now + s.options.setpoint_period;
  return true;
}

}  // namespace lapwing::autonomy
