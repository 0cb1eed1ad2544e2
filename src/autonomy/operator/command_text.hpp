#pragma once

#include <cstddef>
#include <string_view>

#include "autonomy/interface/command.hpp"
#include "base/error.hpp"

namespace lapwing::autonomy {

/// A command of more bytes is none.
inline constexpr std::size_t longest_command = 4096;
/// Coordinates and heights beyond are no metres of a drone; limits that mean something are the machine's.
inline constexpr double furthest_number_m = 1e6;

/// A command as the operator's program writes it: one JSON object, of which `Type` decides. Names are taken with and
/// without the blank ("Autonomous Move", "AutonomousMove"), places and heights by either spelling of their keys; keys
/// that nobody knows are passed over. Errors (invalid_input, for an ErrorLog): no JSON, no object, too long, an unknown
/// type, a key that is missing, twice there by different names, or no number.
[[nodiscard]] base::Result<Command> parse_command(std::string_view text);

}  // namespace lapwing::autonomy
