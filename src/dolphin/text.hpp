#pragma once

#include <string>
#include <string_view>

#include "dolphin/value.hpp"
#include "geo/position.hpp"

namespace lapwing::dolphin {

/// How a value prints: `message x`, "$x". Very long or deep values are cut with "…".
[[nodiscard]] std::string to_text(Value const& value);

/// The shortest decimal form that reads back as the same number, always with a point or exponent ("1500.0"); rounding
/// noise of the last digits is dropped (0.1 + 0.2 prints 0.3).
[[nodiscard]] std::string to_text(double number);
[[nodiscard]] std::string to_text(geo::Disc const& area);

/// "an integer", "a vehicle set": the kind of a value in messages for people.
[[nodiscard]] std::string_view kind_name(ValueKind kind);
[[nodiscard]] inline std::string_view kind_name(Value const& value) {
  return kind_name(value.kind());
}

}  // namespace lapwing::dolphin
