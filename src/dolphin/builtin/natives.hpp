#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "base/async/task.hpp"
#include "dolphin/names/signatures.hpp"
#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

/// The rows that are carried out here: all instructions, the words of handlers, and those that the compiler alone
/// calls; the index is the operand of Op::call_native.
[[nodiscard]] std::span<InstructionSpec const> natives();
/// Nothing for a word that has no function here.
[[nodiscard]] std::optional<int> find_native(std::string_view name);

}  // namespace lapwing::dolphin
