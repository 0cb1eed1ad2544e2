#pragma once

#include "autonomy/states/transitions.hpp"

// What must hold before a row of the table is taken.

namespace lapwing::autonomy::guards {

extern Guard const ready_to_arm;
extern Guard const ready_to_take_off;
extern Guard const armed;
extern Guard const in_the_air;
extern Guard const in_our_hands;
extern Guard const place_by_map;
extern Guard const place_on_globe;

}  // namespace lapwing::autonomy::guards
