#include "dolphin/signatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
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
       .doc = "What is left in the battery of the one vehicle of the set, 0 to 1. Waits for the first report, except "
              "in guards, up to the connection timeout. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::ratio},
      {.name = "relativeHeight",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "Metres of the one vehicle of the set above its home. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::length},
      {.name = "mode",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = text,
       .doc = "The flight mode of the one vehicle of the set, as its autopilot calls it: 'AUTO'."},
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
       .doc = "Sends each vehicle, which must be picked, a raw message of its protocol: sendMessage v, 'COMMAND_LONG', "
              "command: 'MAV_CMD_DO_SET_SERVO', param1: 9, param2: 1500. Fields left out are 0.",
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
