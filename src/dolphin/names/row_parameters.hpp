#pragma once

#include <utility>

#include "dolphin/names/signatures.hpp"

/// How rows of the table of instructions are written, by `using namespace rows`: `takes({metres("height"),
/// maybe(seconds("time"))})`.
namespace lapwing::dolphin::rows {

inline constexpr auto any = Kinds::any();
inline constexpr auto number = Kinds::number();
inline constexpr Kinds text = Kind::text;
inline constexpr Kinds place = Kind::position;
inline constexpr Kinds closure = Kind::closure;
inline constexpr Kinds task = Kind::task;
inline constexpr Kinds vehicles = Kind::vehicles;
inline constexpr auto nothing = Kinds::none();

[[nodiscard]] inline ParameterSpec quantity(std::string_view name, Dimension dimension, std::string_view doc) {
  return {.name = name, .kinds = number, .dimension = dimension, .doc = doc};
}
[[nodiscard]] inline ParameterSpec metres(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::length, doc);
}
[[nodiscard]] inline ParameterSpec seconds(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::time, doc);
}
[[nodiscard]] inline ParameterSpec degrees(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::angle, doc);
}
[[nodiscard]] inline ParameterSpec plain(std::string_view name, Kinds kinds, std::string_view doc = {}) {
  return {.name = name, .kinds = kinds, .doc = doc};
}
[[nodiscard]] inline ParameterSpec maybe(ParameterSpec parameter) {
  parameter.optional = true;
  return parameter;
}
[[nodiscard]] inline SignatureSpec takes(std::vector<ParameterSpec> parameters) {
  return {std::move(parameters)};
}
[[nodiscard]] inline SignatureSpec takes_many(ParameterSpec parameter) {
  return {{std::move(parameter)}, true};
}

}  // namespace lapwing::dolphin::rows
