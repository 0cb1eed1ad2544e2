#pragma once

#include <vector>

#include "base/time.hpp"
#include "vehicle/status_text.hpp"

namespace lapwing::fleet {

/// Why a vehicle will not arm: what it said, in its own words, as long as that may still be true. Texts that begin with
/// "PreArm: " or "Arm: " (ArduPilot), "Preflight Fail: " or "Arming denied" (PX4).
///
/// Takes a text; true when it was such a reason. The same reason again only becomes younger.
bool note_arming_reason(std::vector<vehicle::StatusText>& reasons, vehicle::StatusText const& text);

/// Removes what was not said again in time: ArduPilot repeats its reasons every 30 s. True when something went.
bool forget_old_arming_reasons(std::vector<vehicle::StatusText>& reasons, base::TimePoint now);

}  // namespace lapwing::fleet
