#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "dolphin/names/signatures.hpp"

/// The tables of units and of names of values and types.
namespace lapwing::dolphin {

namespace {

constexpr auto all_units = std::to_array<UnitSpec>({
    {"meters", 1.0, Dimension::length, "metres"},
    {"kilometers", 1000.0, Dimension::length, "kilometres"},
    {"km", 1000.0, Dimension::length, "kilometres"},
    {"degrees", 1.0, Dimension::angle, "degrees"},
    {"radians", 180.0 / std::numbers::pi, Dimension::angle, "radians, as degrees"},
    {"north", 1.0, Dimension::none, "northwards: the number itself"},
    {"south", -1.0, Dimension::none, "southwards: the negative"},
    {"east", 1.0, Dimension::none, "eastwards: the number itself"},
    {"west", -1.0, Dimension::none, "westwards: the negative"},
    {"seconds", 1.0, Dimension::time, "seconds"},
    {"minutes", 60.0, Dimension::time, "minutes, as seconds"},
    {"hours", 3600.0, Dimension::time, "hours, as seconds"},
    {"days", 86400.0, Dimension::time, "days, as seconds"},
    {"percent", 0.01, Dimension::ratio, "hundredths"},
});

constexpr auto all_constants = std::to_array<NameSpec>({
    {"PI", "3.14159..."},
    {"E", "2.71828..."},
    {"NaN", "Not a number: every comparison is false."},
});

constexpr auto all_types = std::to_array<NameSpec>({
    {"ArithmeticException", "A number that cannot be computed."},
    {"ArrayList", "A list."},
    {"AssertionError", "What `assert` throws."},
    {"BigDecimal", "A decimal number."},
    {"Boolean", "true or false."},
    {"ClassCastException", "A value that is not of the type it is taken for."},
    {"Closure", "A piece of code in braces."},
    {"Collection", "A list or a set."},
    {"Double", "A decimal number."},
    {"Error", "What went wrong."},
    {"Exception", "What went wrong."},
    {"Float", "A decimal number."},
    {"HashMap", "A map."},
    {"IOException", "No more input for `ask`."},
    {"IllegalArgumentException", "An argument that cannot be used."},
    {"IllegalFormatException", "A pattern of `format` that does not fit its values."},
    {"IllegalStateException", "Something that cannot be done now."},
    {"IndexOutOfBoundsException", "An element that a list or text does not have."},
    {"Integer", "A whole number."},
    {"LinkedHashMap", "A map."},
    {"List", "A list."},
    {"Long", "A whole number."},
    {"Map", "A map."},
    {"Math", "Functions of numbers; they need no prefix."},
    {"MissingMethodException", "An operation that a value does not have."},
    {"MissingPropertyException", "A name or property that does not exist."},
    {"MissionError", "A mission command that cannot be flown."},
    {"NoSuchElementException", "An element of an empty list."},
    {"NullPointerException", "Null, where a value is needed."},
    {"Number", "A number."},
    {"NumberFormatException", "Text that is no number."},
    {"Object", "Anything."},
    {"OutOfMemoryError", "The script holds too much."},
    {"PRECISION_LAND_MODE", "MAVLink's precision land modes."},
    {"Pattern", "A regular expression: /a+/, ~'a+'."},
    {"PatternSyntaxException", "A pattern that cannot be read."},
    {"Position", "A place."},
    {"Range", "Whole numbers from one to another."},
    {"RuntimeException", "What went wrong."},
    {"Set", "A set."},
    {"StackOverflowError", "Calls are nested too deep."},
    {"String", "Text."},
    {"System", "The machine: System.currentTimeMillis()."},
    {"TaskError", "What a task that failed throws out of `execute`."},
    {"Throwable", "What went wrong."},
    {"TimeoutException", "A guard took too long."},
    {"VehicleError", "No vehicles in time, or not one where one is needed."},
    {"boolean", "true or false."},
    {"double", "A decimal number."},
    {"float", "A decimal number."},
    {"int", "A whole number."},
    {"long", "A whole number."},
});

}  // namespace

ArgumentCount argument_count(MethodSpec const& method) {
  ArgumentCount out;
  auto rest = method.arguments;
  while (!rest.empty()) {
    auto const end = std::min(rest.find(", "), rest.size());
    auto const one = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 2, rest.size()));
    if (one.ends_with("...")) return {out.least, std::numeric_limits<std::size_t>::max()};
    ++out.most;
    out.least += one.ends_with('?') ? 0 : 1;
  }
  return out;
}

std::span<UnitSpec const> units() {
  return all_units;
}
std::span<NameSpec const> constants() {
  return all_constants;
}
std::span<NameSpec const> types() {
  return all_types;
}

}  // namespace lapwing::dolphin
