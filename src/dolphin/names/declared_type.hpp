#pragma once

#include <string_view>

#include "dolphin/names/signatures.hpp"
#include "dolphin/value/fault.hpp"

/// `int n = 3`, `def f(String name)`: what variables and parameters of a declared type take, as Groovy has it. A
/// variable turns what can be turned: numbers into whole ones, anything into text or truth. A parameter takes what is
/// of its type already; whole numbers are decimals, too.
namespace lapwing::dolphin {

struct Runtime;

/// How the value comes to where it is held.
enum class Holder { variable, parameter };

/// Whether the type means anything to the language; others hold every value.
[[nodiscard]] bool is_checked_type(std::string_view type);
/// What is taken, as far as kinds tell before the script runs.
[[nodiscard]] Kinds kinds_taken(std::string_view type, Holder holder);
/// What a variable or parameter of the type can be.
[[nodiscard]] Kinds kinds_held(std::string_view type);
/// What a variable holds that is declared without a value: 0 for `int`, null for `List`.
[[nodiscard]] Value value_at_first(std::string_view type);
/// The value as it is held, or why it is not. `declaration` is "int n".
[[nodiscard]] Checked<Value> held(Runtime& runtime, Value const& value, std::string_view declaration, Holder holder);

}  // namespace lapwing::dolphin
