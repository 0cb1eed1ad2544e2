#include "autonomy/states/actions.hpp"

#include <fmt/format.h>

#include "autonomy/states/asking.hpp"

namespace lapwing::autonomy::actions {

namespace {

void stop_motors(Situation& s) {
  s.memory.is_killed = true;
  s.memory.killed = s.now;
  s.memory.disarms_until.reset();
  s.memory.next_arm_request = s.now;
  insist_on_kill(s);
  tell(s, "Kill: the motors are stopped");
}

void begin_disarming(Situation& s) {
  s.memory.disarms_until = s.now + s.options.disarm_patience;
  s.memory.next_arm_request = s.now;
  insist_on_disarming(s);
}

void reset_for_arming(Situation& s) {
  s.memory.arm_requests = 0;
  s.memory.home.reset();
  s.memory.user_error = UserError::none;
}

void remember_failure(Situation& s) {
  s.memory.reason = failure_of(s).value_or("unknown");
}

void remember_failure_on_ground(Situation& s) {
  s.memory.reason = process_failure(s).value_or(failure_of(s).value_or("unknown"));
  begin_disarming(s);
}

void tell_link_lost(Situation& s) {
  tell(s, fmt::format("nothing was heard of the operator for {:.1f} s: the drone returns",
                      base::to_seconds(s.told.link.silence)));
}

void tell_link_lost_on_ground(Situation& s) {
  tell(s, fmt::format("nothing was heard of the operator for {:.1f} s: the drone is disarmed",
                      base::to_seconds(s.told.link.silence)));
  begin_disarming(s);
}

void tell_link_back(Situation& s) {
  tell(s, "the operator is heard again: the drone waits here for a command");
}

void tell_battery_low(Situation& s) {
  tell(s, fmt::format("the battery has {:.0f} %, and the way home and the landing need {:.0f} %: the drone returns",
                      *s.told.flight->battery * 100, reserve_here(s) * 100));
}

std::string_view missing_for_arming(Situation const& s) {
  if (heard_flight(s) == nullptr) return "the flight controller was not heard";
  if (!s.memory.home) return "home is not known";
  if (!is_in_mode(s, guided)) return "the flight controller did not take mode GUIDED";
  return "the flight controller did not arm: see its messages";
}

void give_up_arming(Situation& s) {
  tell(s, fmt::format("{}: {}", arming_given_up, missing_for_arming(s)));
  begin_disarming(s);
}

void remember_climb(Situation& s) {
  s.memory.reason = fmt::format("the climb to {:.1f} m did not end in time", s.memory.heights.desired_m);
}

void tell_disarmed(Situation& s) {
  tell(s, fmt::format("the flight controller has disarmed in {}", to_string(s.memory.state)));
}

void tell_returns(Situation& s) {
  tell(s, fmt::format("the flight controller has gone to mode {} by itself: see its messages", s.told.flight->mode));
}

void give_to_hand(Situation& s) {
  s.memory.is_flown_by_hand = true;
  tell(s, fmt::format("somebody else flies it in mode {}: the drone waits until it is given back in mode {}",
                      s.told.flight->mode, guided));
}

void take_up(Situation& s) {
  s.memory.home = s.told.flight->home;
  tell(s, "the drone was flying when this program started: it waits here for a command");
}

void tell_no_verdict(Situation& s) {
  tell(s, "the planner does not say whether the wanted place is in the parking lot: try again, or use Compulsive Move");
}

}  // namespace

Action const motors_off{"motors off by force, until disarmed", stop_motors};
Action const disarm{"disarm", begin_disarming};
Action const begin_arming{"forget home and user error", reset_for_arming};
Action const note_failure{"note the reason", remember_failure};
Action const note_failure_and_disarm{"note the reason, disarm", remember_failure_on_ground};
Action const say_link_lost{"say so", tell_link_lost};
Action const say_link_lost_and_disarm{"say so, disarm", tell_link_lost_on_ground};
Action const say_link_back{"say so", tell_link_back};
Action const say_battery_low{"say so", tell_battery_low};
Action const say_not_armed_in_time{"say what is missing, disarm", give_up_arming};
Action const note_climb{"note the reason", remember_climb};
Action const say_disarmed{"say so", tell_disarmed};
Action const say_returns{"say so", tell_returns};
Action const leave_to_the_hand{"say so, ask for nothing", give_to_hand};
Action const take_over{"say so, take home over", take_up};
Action const say_no_verdict{"say so", tell_no_verdict};

}  // namespace lapwing::autonomy::actions
