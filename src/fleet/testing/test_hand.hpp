#pragma once

#include "fleet/state/mavlink_vehicle.hpp"

namespace lapwing::fleet {

/// Lets a test say what was heard of a vehicle without a message.
class TestHand {
 public:
  static Heard& heard_of(MavlinkVehicle& craft) { return craft.heard.write(As<TestHand>()); }
};

}  // namespace lapwing::fleet
