#include "dolphin/signatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace lapwing::dolphin {

namespace {

constexpr auto any = Kinds::any();
constexpr auto number = Kinds::number();
constexpr Kinds text = Kind::text;
constexpr Kinds place = Kind::position;
constexpr Kinds closure = Kind::closure;
constexpr Kinds task = Kind::task;
constexpr Kinds vehicles = Kind::vehicles;
constexpr auto nothing = Kinds::none();

ParameterSpec metres(std::string_view name) {
  return {name, number, Dimension::length};
}
ParameterSpec seconds(std::string_view name) {
  return {name, number, Dimension::time};
}
ParameterSpec degrees(std::string_view name) {
  return {name, number, Dimension::angle};
}
ParameterSpec plain(std::string_view name, Kinds kinds) {
  return {name, kinds};
}
ParameterSpec maybe(ParameterSpec parameter) {
  parameter.optional = true;
  return parameter;
}
SignatureSpec takes(std::vector<ParameterSpec> parameters) {
  return {std::move(parameters)};
}
SignatureSpec takes_many(ParameterSpec parameter) {
  return {{std::move(parameter)}, true};
}

/// A function of numbers as in java.lang.Math.
InstructionSpec maths(std::string_view name, std::size_t count, std::string_view doc) {
  std::vector<ParameterSpec> parameters(count, plain("x", number));
  if (count == 2) parameters[1].name = "y";
  return {name, {takes(std::move(parameters))}, number, doc};
}

std::vector<InstructionSpec> vehicle_instructions() {
  return {
      {.name = "pick",
       .signatures = {takes({plain("fields", closure)})},
       .result = vehicles,
       .doc = "Takes vehicles that are free and fit the fields, waiting for them up to `timeout`; halts when there are "
              "not enough.",
       .block = BlockKind::pick},
      {.name = "release",
       .signatures = {takes({plain("vehicles", vehicles)})},
       .doc = "Stops what runs on the vehicles and gives them back; they may be picked again."},
      {.name = "position",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = place,
       .doc = "Where the one vehicle of the set is."},
      {.name = "battery",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "What is left in the battery of the one vehicle of the set, 0 to 1. Unknown: NaN, and every comparison "
              "is false.",
       .dimension = Dimension::ratio},
      {.name = "connected",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = Kind::boolean,
       .doc = "Whether the one vehicle of the set has been heard within its connection timeout."},
      {.name = "setConnectionTimeout",
       .signatures = {takes({seconds("timeout")})},
       .doc = "After how long a silence a vehicle counts as lost, 5 s to 1 h: for all picked ones and later picks, or "
              "`v1: 30.seconds` for some.",
       .named = NamedArguments::vehicles},
      {.name = "sendMessage",
       .signatures = {takes({plain("vehicles", vehicles), plain("message", text)})},
       .doc = "Sends one raw message to each vehicle: sendMessage v, 'COMMAND_LONG', command: 400, param1: 1.",
       .named = NamedArguments::values},
  };
}

std::vector<InstructionSpec> geometry_instructions() {
  return {
      {.name = "location",
       .signatures = {takes({degrees("lat"), degrees("lon"), maybe(metres("height"))})},
       .result = place,
       .doc = "A place: latitude and longitude in degrees, height in metres above mean sea level."},
      {.name = "pos",
       .signatures = {takes({plain("fields", closure)})},
       .result = place,
       .doc = "A place from fields: pos { lat 38.4; lon (-8.8); height 100 }.",
       .block = BlockKind::position},
      {.name = "area",
       .signatures = {takes({plain("centre", place), metres("radius")})},
       .result = Kind::area,
       .doc = "All places within the radius; also written centre ^ radius."},
      {.name = "move",
       .signatures = {takes({plain("from", place), plain("by", Kinds(Kind::displacement) | closure)})},
       .result = place,
       .doc = "The place some metres away: move p, { north 100; east 50 }.",
       .block = BlockKind::displacement},
      {.name = "moveDistance",
       .signatures = {takes({plain("fields", closure)})},
       .result = Kind::displacement,
       .doc = "A displacement: moveDistance { north 100; down 10 }.",
       .block = BlockKind::displacement},
  };
}

std::vector<InstructionSpec> program_instructions() {
  return {
      {.name = "message", .signatures = {takes({plain("value", any)})}, .doc = "Prints the value for the operator."},
      {.name = "ask",
       .signatures = {takes({plain("prompt", any)})},
       .result = any,
       .doc = "Prints the prompt and reads one line: the value of the expression in it, or its text."},
      {.name = "halt",
       .signatures = {takes({maybe(plain("reason", any))})},
       .doc = "Ends the program and makes all vehicles safe."},
      {.name = "pause", .signatures = {takes({seconds("time")})}, .doc = "Waits; tasks of others go on."},
      {.name = "println",
       .signatures = {takes({maybe(plain("value", any))})},
       .doc = "Prints the value and ends the line."},
      {.name = "print", .signatures = {takes({plain("value", any)})}, .doc = "Prints the value."},
  };
}

std::vector<InstructionSpec> task_instructions() {
  return {
      {.name = "task",
       .signatures = {takes({plain("name", text)})},
       .result = task,
       .doc = "The plan of that name, from a plan file or this script."},
      {.name = "imcPlan", .signatures = {takes({plain("name", text)})}, .result = task, .doc = "The same as `task`."},
      {.name = "idle",
       .signatures = {takes({maybe(seconds("time"))})},
       .result = task,
       .doc = "Does nothing for that long; without a time it never ends by itself."},
      {.name = "action",
       .signatures = {takes({plain("body", closure)})},
       .result = task,
       .doc = "Runs the closure once. Needs no vehicle."},
      {.name = "condition",
       .signatures = {takes({plain("test", closure)})},
       .result = task,
       .doc = "Done when the closure is true; tested at every step. Needs no vehicle."},
      {.name = "oneOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "Runs the first branch whose guard is true: oneOf { when { a } then t }.",
       .block = BlockKind::choice},
      {.name = "choose",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "The same as `oneOf`.",
       .block = BlockKind::choice},
      {.name = "allOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "Runs every branch, one at a time, each when its guard is true.",
       .block = BlockKind::choice},
      {.name = "execute",
       .signatures = {takes({plain("task", task)})},
       .result = Kind::other,
       .doc =
           "Runs the task to its end; `execute v1: a, v2: b` runs several at once, each on its vehicles, `_` on any.",
       .named = NamedArguments::vehicles},
      {.name = "post",
       .signatures = {takes({plain("signals", Kind::map)})},
       .doc = "Posts signals: post ready: 1.",
       .named = NamedArguments::values},
      {.name = "consume",
       .signatures = {takes({plain("signals", Kind::map)})},
       .result = Kind::boolean,
       .doc = "Takes the signals when all are there; whether they were.",
       .named = NamedArguments::values},
      {.name = "poll",
       .signatures = {takes({plain("name", Kinds(Kind::text) | Kind::map)})},
       .result = Kind::boolean,
       .doc = "Whether there is a signal of that name, or one with that value, or one for which the closure is true.",
       .named = NamedArguments::values},
  };
}

std::vector<InstructionSpec> maths_instructions() {
  return {
      maths("abs", 1, "Without its sign."),
      maths("sqrt", 1, "Square root."),
      maths("cbrt", 1, "Cube root."),
      maths("sin", 1, "Sine of radians."),
      maths("cos", 1, "Cosine of radians."),
      maths("tan", 1, "Tangent of radians."),
      maths("asin", 1, "Arc sine, radians."),
      maths("acos", 1, "Arc cosine, radians."),
      maths("atan", 1, "Arc tangent, radians."),
      maths("atan2", 2, "The angle of the point (y, x), radians."),
      maths("exp", 1, "e to the power of x."),
      maths("log", 1, "Natural logarithm."),
      maths("log10", 1, "Decimal logarithm."),
      maths("pow", 2, "x to the power of y."),
      maths("hypot", 2, "Length of (x, y)."),
      maths("floor", 1, "Rounded down."),
      maths("ceil", 1, "Rounded up."),
      maths("round", 1, "Rounded to the nearest integer."),
      maths("signum", 1, "-1, 0 or 1."),
      maths("toRadians", 1, "Degrees to radians."),
      maths("toDegrees", 1, "Radians to degrees."),
      {.name = "min", .signatures = {takes_many(plain("x", any))}, .result = any, .doc = "The smallest."},
      {.name = "max", .signatures = {takes_many(plain("x", any))}, .result = any, .doc = "The largest."},
      {.name = "random", .signatures = {takes({})}, .result = number, .doc = "A number from 0 to below 1."},
  };
}

std::vector<InstructionSpec> all_instructions() {
  auto out = vehicle_instructions();
  for (auto more : {geometry_instructions(), program_instructions(), task_instructions(), maths_instructions()}) {
    std::ranges::move(more, std::back_inserter(out));
  }
  return out;
}

std::vector<InstructionSpec> pick_fields() {
  return {
      {.name = "count", .signatures = {takes({plain("n", number)})}, .doc = "How many vehicles, 1 by default."},
      {.name = "type", .signatures = {takes({plain("kind", text)})}, .doc = "UAV, UGV, USV or UUV."},
      {.name = "id",
       .signatures = {takes({plain("vehicle", text | Kinds(Kind::integer))})},
       .doc = "The vehicle of that id."},
      {.name = "payload",
       .signatures = {takes_many(plain("name", text))},
       .doc = "What the vehicle must carry, by exact names."},
      {.name = "region",
       .signatures = {takes({plain("area", Kind::area)}), takes({plain("centre", place), metres("radius")})},
       .doc = "Where the vehicle must be."},
      {.name = "timeout",
       .signatures = {takes({seconds("time")})},
       .doc = "How long to wait for the vehicles, 0 by default."},
  };
}

std::vector<InstructionSpec> position_fields() {
  return {
      {.name = "lat", .signatures = {takes({degrees("latitude")})}, .doc = "Degrees north."},
      {.name = "lon", .signatures = {takes({degrees("longitude")})}, .doc = "Degrees east."},
      {.name = "height", .signatures = {takes({metres("height")})}, .doc = "Metres above mean sea level."},
      {.name = "hae", .signatures = {takes({metres("height")})}, .doc = "The same as `height`."},
  };
}

std::vector<InstructionSpec> displacement_fields() {
  return {
      {.name = "north", .signatures = {takes({metres("distance")})}, .doc = "Metres north."},
      {.name = "east", .signatures = {takes({metres("distance")})}, .doc = "Metres east."},
      {.name = "down", .signatures = {takes({metres("distance")})}, .doc = "Metres down."},
  };
}

std::vector<InstructionSpec> handler_words() {
  return {
      {.name = "ignore", .signatures = {takes({})}, .doc = "The watched task counts as done."},
      {.name = "propagate", .signatures = {takes({})}, .doc = "The watched task counts as failed (the default)."},
  };
}

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
    {Kind::vehicles, "connectionTimeout", true, Kind::decimal, "Seconds."},
    {Kind::task, "id", true, Kind::text, "The name of the task."},
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

Kinds kinds_of(tasks::Type type) {
  switch (type) {
    case tasks::Type::number:
    case tasks::Type::integer: return number;  // decimals are rounded with a warning (REC-47)
    case tasks::Type::text: return text;
    case tasks::Type::boolean: return Kind::boolean;
    case tasks::Type::position: return place;
    case tasks::Type::displacement: return Kind::displacement;
  }
  return any;
}

constexpr auto kind_words = std::to_array<std::pair<Kind, std::string_view>>({
    {Kind::boolean, "true or false"},
    {Kind::decimal, "a number"},
    {Kind::text, "text"},
    {Kind::position, "a position"},
    {Kind::displacement, "a displacement"},
    {Kind::area, "an area"},
    {Kind::vehicles, "a set of vehicles"},
    {Kind::task, "a task"},
    {Kind::closure, "a closure"},
    {Kind::list, "a list"},
    {Kind::map, "a map"},
});

}  // namespace

std::string describe(Kinds kinds) {
  if (kinds.is_any()) return "any value";
  if (kinds.is_none()) return "nothing";
  std::vector<std::string_view> words;
  for (auto const& [kind, word] : kind_words) {
    if (kinds.meets(kind) || (kind == Kind::decimal && kinds.meets(Kind::integer))) words.push_back(word);
  }
  if (kinds == Kinds(Kind::integer)) return "a whole number";
  return words.empty() ? "another value" : fmt::format("{}", fmt::join(words, " or "));
}

std::span<InstructionSpec const> instructions() {
  static auto const table = all_instructions();
  return table;
}

std::span<InstructionSpec const> block_words(BlockKind kind) {
  static auto const pick = pick_fields();
  static auto const position = position_fields();
  static auto const displacement = displacement_fields();
  static auto const handler = handler_words();
  switch (kind) {
    case BlockKind::pick: return pick;
    case BlockKind::position: return position;
    case BlockKind::displacement: return displacement;
    case BlockKind::handler: return handler;
    case BlockKind::none:
    case BlockKind::choice:
    case BlockKind::platform: return {};
  }
  return {};
}

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

InstructionSpec instruction_of(tasks::CommandSpec const& command) {
  InstructionSpec out{.name = command.name, .signatures = {}, .result = nothing, .doc = command.doc};
  for (auto const& overload : command.overloads) {
    SignatureSpec signature;
    for (auto const& parameter : overload.parameters) {
      signature.parameters.push_back({parameter.name, kinds_of(parameter.type), parameter.dimension,
                                      parameter.fallback.has_value(), parameter.choices, parameter.doc});
    }
    out.signatures.push_back(std::move(signature));
  }
  return out;
}

}  // namespace lapwing::dolphin
