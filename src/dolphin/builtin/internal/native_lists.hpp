#pragma once

#include <vector>

#include "dolphin/builtin/natives.hpp"

/// The table of instructions, by topic: each row stands beside the function that carries it out.
namespace lapwing::dolphin::internal {

// What a script can write, in the order of the reference.
[[nodiscard]] std::vector<InstructionSpec> vehicle_words();
[[nodiscard]] std::vector<InstructionSpec> place_words();
[[nodiscard]] std::vector<InstructionSpec> control_words();
[[nodiscard]] std::vector<InstructionSpec> task_words();
[[nodiscard]] std::vector<InstructionSpec> signal_words();
[[nodiscard]] std::vector<InstructionSpec> maths_words();
/// What stands in the closure of onError.
[[nodiscard]] std::vector<InstructionSpec> handler_words();

// What the compiler and the prelude alone call.
[[nodiscard]] std::vector<InstructionSpec> vehicle_helpers();
[[nodiscard]] std::vector<InstructionSpec> task_helpers();
[[nodiscard]] std::vector<InstructionSpec> signal_helpers();

}  // namespace lapwing::dolphin::internal
