#pragma once

#include "tasks/vocabulary.hpp"

namespace lapwing::missions {

/// `sendMessage v, 'COMMAND_LONG', command: 400`: a raw message to a vehicle. What it is; that it is sent is done by
/// the platform that knows the messages.
[[nodiscard]] tasks::VehicleInstruction send_message();

}  // namespace lapwing::missions
