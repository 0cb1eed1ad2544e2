#pragma once

#include <cstdint>

#include "base/async/task.hpp"
#include "mavlink/codec/enums.hpp"

namespace lapwing::fleet {

struct MavlinkVehicle;

/// A message that is wanted once, and of whom. What the argument says is the message's: the number of a picture, the
/// place in a list.
struct Question {
  mavlink::MessageId message{};
  std::uint8_t component = 0;
  float argument = 0.0F;
  int tries = 0;  ///< before this one
};

/// Puts it behind those that wait. While the vehicle cannot be asked they do not pile up: the oldest are given up.
void ask(MavlinkVehicle& craft, Question question);

}  // namespace lapwing::fleet
