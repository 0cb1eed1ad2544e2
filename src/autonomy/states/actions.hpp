#pragma once

#include "autonomy/states/transitions.hpp"

// What is done on the way from one state to the next.

namespace lapwing::autonomy::actions {

extern Action const motors_off;
extern Action const disarm;
extern Action const begin_arming;
extern Action const note_failure;
extern Action const note_failure_and_disarm;
extern Action const say_link_lost;
extern Action const say_link_lost_and_disarm;
extern Action const say_link_back;
extern Action const say_battery_low;
extern Action const say_not_armed_in_time;
extern Action const note_climb;
extern Action const say_disarmed;
extern Action const say_returns;
extern Action const leave_to_the_hand;
extern Action const take_over;
extern Action const say_no_verdict;

}  // namespace lapwing::autonomy::actions
