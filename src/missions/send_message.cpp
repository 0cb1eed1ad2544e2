#include "missions/send_message.hpp"

namespace lapwing::missions {

tasks::VehicleInstruction send_message() {
  return {
      .name = "sendMessage",
      .parameters = {{.name = "message", .type = tasks::Type::text, .doc = "its name in the protocol"}},
      .takes_values = true,
      .doc =
          "Sends each vehicle, which must be picked, a raw message of its protocol: sendMessage v, 'COMMAND_LONG', "
          "command: 'MAV_CMD_DO_SET_SERVO', param1: 9, param2: 1500. Fields left out are 0; no answer is waited for.",
      .usage = "takes vehicles, the name of a message and its fields: sendMessage v, 'COMMAND_LONG', command: 400",
      .example =
          "v = pick {}\nsendMessage v, 'COMMAND_LONG', command: 'MAV_CMD_DO_SET_SERVO', param1: 9, param2: 1500"};
}

}  // namespace lapwing::missions
