#include <array>
#include <numbers>

#include "dolphin/signatures.hpp"

/// The tables of what stands behind a point and of names of values and types.
namespace lapwing::dolphin {

namespace {

constexpr auto any = Kinds::any();
constexpr auto number = Kinds::number();

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

constexpr auto lists = Kinds(Kind::list);
constexpr auto many = Kinds(Kind::list) | Kind::map | Kind::vehicles | Kind::other;
constexpr auto all_methods = std::to_array<MethodSpec>({
    {many | Kind::text, "size", false, Kind::integer, "How many."},
    {many | Kind::text, "isEmpty", false, Kind::boolean, "Whether there is nothing in it."},
    {many | Kind::text, "contains", false, Kind::boolean, "Whether the value is in it."},
    {many, "each", false, any, "Calls the closure with each."},
    {many, "eachWithIndex", false, any, "Calls the closure with each and its index."},
    {many, "collect", false, Kind::list, "What the closure makes of each."},
    {many, "collectEntries", false, Kind::map, "A map of what the closure makes of each."},
    {many, "find", false, any, "The first for which the closure is true, or null."},
    {many, "findAll", false, any, "Those for which the closure is true."},
    {many, "findIndexOf", false, Kind::integer, "The index of the first for which the closure is true, or -1."},
    {many, "any", false, Kind::boolean, "Whether the closure is true for one."},
    {many, "every", false, Kind::boolean, "Whether the closure is true for all."},
    {many, "inject", false, any, "Folds all into one value."},
    {many, "join", false, Kind::text, "All as one text."},
    {many, "sort", false, Kind::list, "In order."},
    {many, "sum", false, any, "All added up."},
    {many, "count", false, Kind::integer, "How many equal the value, or for how many the closure is true."},
    {many, "groupBy", false, Kind::map, "Lists by what the closure makes of each."},
    {many, "min", false, any, "The smallest."},
    {many, "max", false, any, "The largest."},
    {many, "first", false, any, "The first."},
    {many, "last", false, any, "The last."},
    {lists, "add", false, Kind::boolean, "Appends the value."},
    {lists | Kind::other, "reverse", false, Kind::list, "In reverse order."},
    {lists, "unique", false, Kind::list, "Each value once."},
    {lists | Kind::map, "get", false, any, "The element."},
    {lists | Kind::map, "remove", false, any, "Takes an element out."},
    {Kind::map, "put", false, any, "Sets a value."},
    {Kind::map, "containsKey", false, Kind::boolean, "Whether there is that key."},
    {Kind::map, "keySet", false, Kind::list, "The keys."},
    {Kind::map, "values", false, Kind::list, "The values."},
    {many, "toList", false, Kind::list, "As a list."},
    {Kind::text, "length", false, Kind::integer, "How many characters."},
    {Kind::text, "toUpperCase", false, Kind::text, "In capitals."},
    {Kind::text, "toLowerCase", false, Kind::text, "In small letters."},
    {Kind::text, "startsWith", false, Kind::boolean, "Whether it begins so."},
    {Kind::text, "endsWith", false, Kind::boolean, "Whether it ends so."},
    {Kind::text, "trim", false, Kind::text, "Without blanks at the ends."},
    {Kind::text, "split", false, Kind::list, "Its parts."},
    {Kind::text, "replace", false, Kind::text, "With one part replaced."},
    {Kind::text, "substring", false, Kind::text, "A part of it."},
    {Kind::text, "indexOf", false, Kind::integer, "Where the part begins, or -1."},
    {Kind::text | number, "toInteger", false, Kind::integer, "As an integer."},
    {Kind::text | number, "toDouble", false, Kind::decimal, "As a decimal."},
    {number, "times", false, any, "Calls the closure with 0 to n - 1."},
    {number, "upto", false, any, "Calls the closure with each up to the other."},
    {number, "downto", false, any, "Calls the closure with each down to the other."},
    {number, "intdiv", false, Kind::integer, "Divided, without the rest."},
    {number, "abs", false, number, "Without its sign."},
    {number, "round", false, number, "Rounded."},
    {number, "intValue", false, Kind::integer, "As an integer."},
    {number, "longValue", false, Kind::integer, "As an integer."},
    {number, "toLong", false, Kind::integer, "As an integer."},
    {number, "isNaN", false, Kind::boolean, "Whether it is not a number."},
    {number, "compareTo", false, Kind::integer, "-1, 0 or 1."},
    {number, "doubleValue", false, Kind::decimal, "As a decimal."},
    {Kind::position, "lat", true, Kind::decimal, "Latitude, degrees."},
    {Kind::position, "lon", true, Kind::decimal, "Longitude, degrees."},
    {Kind::position, "hae", true, Kind::decimal, "Height, metres."},
    {Kind::position, "height", true, Kind::decimal, "Height, metres."},
    {Kind::position, "distanceTo", false, Kind::decimal, "Metres to the other place, height included."},
    {Kind::position, "near", false, Kind::boolean, "Whether the other place is within so many metres."},
    {Kind::displacement, "north", true, Kind::decimal, "Metres north."},
    {Kind::displacement, "east", true, Kind::decimal, "Metres east."},
    {Kind::displacement, "down", true, Kind::decimal, "Metres down."},
    {Kind::area, "contains", false, Kind::boolean, "Whether the place is in it."},
    {Kind::area, "center", true, Kind::position, "The centre."},
    {Kind::area, "radius", true, Kind::decimal, "The radius, metres."},
    {Kind::vehicles, "id", true, Kind::text, "The id of the one vehicle."},
    {Kind::vehicles, "type", true, Kind::text, "The type of the one vehicle."},
    {Kind::vehicles, "payload", true, Kind::list, "What the one vehicle carries."},
    {Kind::vehicles, "name", true, Kind::text, "The same as `id`."},
    {Kind::vehicles, "connected", true, Kind::boolean, "Whether the one vehicle has been heard lately."},
    {Kind::vehicles, "battery", true, Kind::decimal, "What is left in the battery of the one vehicle, 0 to 1."},
    {Kind::vehicles, "position", true, Kind::position, "Where the one vehicle is."},
    {Kind::vehicles, "connectionTimeout", true, Kind::decimal, "Seconds."},
    {Kind::task, "id", true, Kind::text, "The name of the task."},
    {Kind::task, "name", true, Kind::text, "The same as `id`."},
    {Kind::closure, "call", false, any, "Calls it."},
    {any, "toString", false, Kind::text, "As text."},
    {any, "equals", false, Kind::boolean, "Whether both are equal."},
    {any, "class", true, Kind::other, "Its type."},
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
    {"NullPointerException", "Null, where a value is needed."},
    {"Number", "A number."},
    {"NumberFormatException", "Text that is no number."},
    {"Object", "Anything."},
    {"OutOfMemoryError", "The script holds too much."},
    {"PRECISION_LAND_MODE", "MAVLink's precision land modes."},
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

std::span<UnitSpec const> units() {
  return all_units;
}
std::span<MethodSpec const> methods() {
  return all_methods;
}
std::span<NameSpec const> constants() {
  return all_constants;
}
std::span<NameSpec const> types() {
  return all_types;
}

}  // namespace lapwing::dolphin
