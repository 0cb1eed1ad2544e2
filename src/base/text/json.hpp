#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

/// How JSON is written here; its values are nlohmann's everywhere, which a .cpp that makes some includes itself.
namespace lapwing::base {

/// Without `indent` on one line. Bytes that are no UTF-8 are replaced: much of what is written comes from vehicles.
template <class Json>
[[nodiscard]] std::string to_text(Json const& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// One line for people and programs that compare bytes: every number in its shortest spelling, as 820 and 0.1, where
/// the library writes 820.0, and one of 600 doubles with 17 digits.
[[nodiscard]] std::string to_plain_line(nlohmann::ordered_json const& json);

/// The double that is spelled as the float is: 0.1 of 0.1F, and not 0.10000000149011612.
[[nodiscard]] double shortest(float value);

/// An integer when it is one, null when it is no number.
template <class Json>
[[nodiscard]] Json json_number(double value) {
  constexpr double exact_up_to = 9e15;
  if (!std::isfinite(value)) return nullptr;
  if (value == std::trunc(value) && std::abs(value) < exact_up_to) return static_cast<std::int64_t>(value);
  return value;
}

}  // namespace lapwing::base
