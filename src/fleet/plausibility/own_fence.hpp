#pragma once

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "fleet/state/mavlink_vehicle.hpp"

namespace lapwing::fleet {

/// For an operator who waits, and for a flight that is being prepared.
inline constexpr base::Duration hasty = std::chrono::seconds(3);
inline constexpr base::Duration thorough = std::chrono::seconds(10);

/// Asks the vehicle for its own fence: the parameters, and the stored areas if they are watched. Asks for nothing that
/// it told within the last minute (areas: ten), so that one command after the other does not wait; what changes
/// meanwhile is noticed by what the vehicle says of it. A vehicle that did not answer is left alone as long.
/// Error: timed_out, with what it has not told within `patience`; it is judged by what is known.
base::Task<base::Result<>> learn_fence(MavlinkVehicle& craft, base::Duration patience);
/// The same; what is not told is said.
base::Task<> learn_fence(MavlinkVehicle& craft, base::Duration patience, base::Logger log);

}  // namespace lapwing::fleet
