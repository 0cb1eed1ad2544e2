#pragma once

#include "base/async/task.hpp"
#include "fleet/state/mavlink_vehicle.hpp"

namespace lapwing::fleet {

/// Asks a vehicle that knows its place for its home, if it has not told it: fences, and how far is far from home, are
/// measured from there, and of their own accord vehicles tell it only every ten seconds. Waits for it no longer than
/// `patience`, and not at all for one that within the last minute did not tell.
base::Task<> learn_home(MavlinkVehicle& craft, base::Duration patience);

}  // namespace lapwing::fleet
