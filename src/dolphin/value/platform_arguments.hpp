#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/value/value.hpp"
#include "tasks/vocabulary.hpp"

/// Script values as a platform takes them, in its commands and instructions.
namespace lapwing::dolphin {

[[nodiscard]] std::string_view type_name(tasks::Type type);

/// The values for all parameters, those left out filled in; nothing when one is missing, too many or of another type.
[[nodiscard]] std::optional<std::vector<tasks::Argument>> fitted(std::span<tasks::Parameter const> parameters,
                                                                 std::span<Value const> given);

/// What is wrong with one of the values although it is of the right type: "dir is "SOUTH", but must be one of ...",
/// "field is no area: its edges cross". They are those of `fitted`.
[[nodiscard]] std::optional<std::string> wrong_value(std::span<tasks::Parameter const> parameters,
                                                     std::span<tasks::Argument const> values);

/// What stands behind a name in the call of an instruction: a number, a text or a truth; nothing for another value.
[[nodiscard]] std::optional<tasks::Argument> named_value(Value const& value);

}  // namespace lapwing::dolphin
