#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "base/error.hpp"
#include "robot/watch/module.hpp"

namespace lapwing::robot {

/// What an old part may have a robot do.
enum class Order : std::uint8_t {
  kill,   ///< the carrier, past the planner; holds until it is let go again
  stand,  ///< leave off what it does
  go_on,  ///< after a kill: let it go; else its normal run, unless it drives already
};

/// What an old part says of itself.
struct OldPartReport {
  Module module = Module::command_centre;
  ModuleReport report = {};
};

using Heard = std::variant<Order, OldPartReport>;

/// What a line of an old part (docs/reference/robot-serial.md) asks of the robot or says of its sender. Error
/// (invalid_input): it is no such line, or asks for what a robot takes from nobody.
[[nodiscard]] base::Result<Heard> heard_in(std::string_view line);

}  // namespace lapwing::robot
