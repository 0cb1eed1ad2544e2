#pragma once

#include <string>
#include <string_view>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"
#include "geo/position.hpp"

namespace lapwing::dolphin {

/// How a value prints: `message x`, "$x". Very long or deep values are cut with "…".
[[nodiscard]] std::string to_text(Value const& value);

/// The shortest decimal form that reads back as the same number, always with a point or exponent ("1500.0"); rounding
/// noise of the last digits is dropped (0.1 + 0.2 prints 0.3).
[[nodiscard]] std::string to_text(double number);
[[nodiscard]] std::string to_text(geo::Disc const& area);

/// A text that an operation made; a fault when it is too long.
[[nodiscard]] Checked<Value> make_text(Heap& heap, std::string text);

/// `text.find(wanted, from)`, but linear in the length of the text however both are made.
[[nodiscard]] std::size_t find_text(std::string_view text, std::string_view wanted, std::size_t from = 0);

/// "an integer", "a vehicle set": the kind of a value in messages for people.
[[nodiscard]] std::string_view kind_name(ValueKind kind);
[[nodiscard]] inline std::string_view kind_name(Value const& value) {
  return kind_name(value.kind());
}

}  // namespace lapwing::dolphin
