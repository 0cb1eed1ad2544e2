#pragma once

#include <string_view>

#include "autonomy/states/situation.hpp"

// Asking the flight controller for what may take a while: each is called frame by frame, asks when it is time, and
// waits for nothing.

namespace lapwing::autonomy {

/// Begins to want another mode.
void want_mode(Situation& s);
/// Until it is seen once.
void ask_for_mode(Situation& s, std::string_view mode);
/// To come home; and where that mode does not come, for it needs a place, to land here.
void ask_to_return(Situation& s);

/// Without force, which a drone in the air refuses; for a while also of one that is disarmed, which an earlier request
/// may still arm.
void insist_on_disarming(Situation& s);
/// With force, as long as it is not seen disarmed.
void insist_on_kill(Situation& s);

/// Where it is now, at the height that it has, within those allowed; nothing while it does not know its place.
[[nodiscard]] std::optional<geo::Point3<ArmingFrame>> place_to_hold(Situation const& s);
/// Whether the next setpoint is due, which the caller then sends.
[[nodiscard]] bool is_setpoint_due(Situation& s);

}  // namespace lapwing::autonomy
