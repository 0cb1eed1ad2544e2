#include "dolphin/names/signatures.hpp"

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

ParameterSpec quantity(std::string_view name, Dimension dimension, std::string_view doc) {
  return {.name = name, .kinds = number, .dimension = dimension, .doc = doc};
}
ParameterSpec metres(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::length, doc);
}
ParameterSpec seconds(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::time, doc);
}
ParameterSpec degrees(std::string_view name, std::string_view doc = {}) {
  return quantity(name, Dimension::angle, doc);
}
ParameterSpec plain(std::string_view name, Kinds kinds, std::string_view doc = {}) {
  return {.name = name, .kinds = kinds, .doc = doc};
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
       .doc =
           "Takes vehicles that are connected, free, and fit the fields, waiting for them up to `timeout`. They stay "
           "picked until `release` or the end of the script. When there are not enough, none is taken and a "
           "VehicleError is thrown, which halts the script unless it is caught.",
       .block = BlockKind::pick,
       .example = "v = pick { type 'UAV'; count 2; timeout 30.seconds }"},
      {.name = "release",
       .signatures = {takes({plain("vehicles", vehicles)})},
       .doc = "Stops what runs on the vehicles and gives them back; they may be picked again.",
       .example = "v = pick {}\nrelease v"},
      {.name = "position",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = place,
       .doc = "Where the one vehicle of the set is. Waits for the first report, except in guards, up to the connection "
              "timeout. Unknown in a guard: every comparison with it is false.",
       .example = "v = pick {}\nmessage position(v).distanceTo(location(41.178, -8.598))"},
      {.name = "battery",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "What is left in the battery of the one vehicle of the set, 0 to 1. Waits for the first report, except "
              "in guards, up to the connection timeout. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::ratio,
       .example = "v = pick {}\nexecute waitFor { battery(v) >= 90.percent } then idle(1)"},
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
              "`v1: 30.seconds` for some. 20 s until it is set.",
       .named = NamedArguments::vehicles,
       .example = "v = pick {}\nsetConnectionTimeout 60.seconds\nsetConnectionTimeout v: 2.minutes"},
  };
}

std::vector<InstructionSpec> geometry_instructions() {
  return {
      {.name = "location",
       .signatures = {takes({degrees("lat", "north is positive"), degrees("lon", "east is positive"),
                             maybe(metres("height", "above mean sea level, 0 if it is left out"))})},
       .result = place,
       .doc = "A place: latitude and longitude in degrees, height in metres above mean sea level.",
       .example = "base = location(41.1780, -8.5980, 90)"},
      {.name = "pos",
       .signatures = {takes({plain("fields", closure)})},
       .result = place,
       .doc = "A place from fields; those left out are 0.",
       .block = BlockKind::position,
       .example = "base = pos { lat 38.4; lon (-8.8); height 100 }"},
      {.name = "area",
       .signatures = {takes({plain("centre", place), metres("radius")})},
       .result = Kind::area,
       .doc = "All places within the radius, height included; also written `centre ^ radius`.",
       .example = "harbour = area location(41.178, -8.598), 2.km\nmessage location(41.18, -8.6) in harbour"},
      {.name = "move",
       .signatures = {takes({plain("from", place), plain("by", Kinds(Kind::displacement) | closure)})},
       .result = place,
       .doc = "The place some metres away. Not in missions, where `move` is a command of its own.",
       .block = BlockKind::displacement,
       .example = "message move(location(41.178, -8.598), { north 100; east 50 })"},
      {.name = "moveDistance",
       .signatures = {takes({plain("fields", closure)})},
       .result = Kind::displacement,
       .doc = "A displacement; fields left out are 0.",
       .block = BlockKind::displacement,
       .example = "step = moveDistance { north 100; down 10 }\nmessage move(location(41.178, -8.598), step)"},
  };
}

std::vector<InstructionSpec> program_instructions() {
  return {
      {.name = "message",
       .signatures = {takes({plain("value", any)})},
       .doc = "Prints the value for the operator, behind `Program message:`.",
       .example = "message 'Survey begins'"},
      {.name = "ask",
       .signatures = {takes({plain("prompt", any)})},
       .result = any,
       .doc = "Prints the prompt and reads one line: the value of the expression in it (literals, variables, functions "
              "of numbers), or its text when it is none. Throws an IOException when there is no more input.",
       .example = "n = ask 'How many vehicles? '"},
      {.name = "halt",
       .signatures = {takes({maybe(plain("reason", any))})},
       .doc = "Ends the script with exit code 3 and makes all vehicles safe. Cannot be caught; `finally` runs.",
       .example = "halt 'the wind is too strong'"},
      {.name = "pause",
       .signatures = {takes({seconds("time")})},
       .doc = "Waits. In an action it holds up nobody else; in a guard it is an error.",
       .example = "pause 5.seconds"},
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
       .doc = "The mission of this script that has the name, or the plan file of `--plans DIR`: north.plan or "
              "north.waypoints for 'north'. On the test platform 'A:3' is a task of 3 s and 'fail:3' one that fails.",
       .example = "north = mission { name 'north'; home 41.178, -8.598, 90; move 50, 0 }\nv = pick {}\nexecute v: "
                  "task('north')"},
      {.name = "imcPlan",
       .signatures = {takes({plain("name", text)})},
       .result = task,
       .doc = "The same as `task`; also written `imcPlan['north']`."},
      {.name = "idle",
       .signatures = {takes({maybe(seconds("time"))})},
       .result = task,
       .doc = "Does nothing for that long; without a time it never ends by itself. Needs no vehicle.",
       .example = "execute idle(10.seconds)"},
      {.name = "action",
       .signatures = {takes({plain("body", closure)})},
       .result = task,
       .doc = "Runs the closure once. Needs no vehicle. An exception in it is an error of the task.",
       .example = "execute idle(1) >> action { message 'a second later' }"},
      {.name = "condition",
       .signatures = {takes({plain("test", closure)})},
       .result = task,
       .doc = "Done when the closure is true; tested at every step. Needs no vehicle.",
       .example = "v = pick {}\nexecute condition { battery(v) > 95.percent }"},
      {.name = "oneOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc =
           "Tests the guards of its branches in order, at every step; the first that is true decides which one runs.",
       .block = BlockKind::choice,
       .example =
           "v = pick {}\nexecute oneOf {\n  when { battery(v) < 0.5 } then idle(60)\n  when { true } then idle(1)\n}"},
      {.name = "choose",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "The same as `oneOf`.",
       .block = BlockKind::choice},
      {.name = "allOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "Runs every branch, one at a time, each when its guard is true; done when all have run.",
       .block = BlockKind::choice,
       .example =
           "execute allOf {\n  when { poll 'ready' } then idle(1)\n  when { true } then action { post ready: 1 }\n}"},
      {.name = "execute",
       .signatures = {takes({plain("task", task)})},
       .result = Kind::other,
       .doc =
           "Runs the task to its end; `execute v1: a, v2: b` runs several at once, each on its vehicles, `_` on any. "
           "Gives a result with `done`, `error` and `vehicles`; a task that fails throws a TaskError.",
       .named = NamedArguments::vehicles,
       .example = "v = pick {}\nr = execute v: idle(1), _: action { message 'begun' }\nmessage r.done"},
      {.name = "post",
       .signatures = {takes({plain("signals", Kind::map)})},
       .doc = "Posts each value under its name; one that is there already changes nothing.",
       .named = NamedArguments::values,
       .example = "post ready: 1, place: 'north'"},
      {.name = "consume",
       .signatures = {takes({plain("signals", Kind::map)})},
       .result = Kind::boolean,
       .doc = "Takes the signals when all are there, or none; whether they were there.",
       .named = NamedArguments::values,
       .example = "post ready: 1\nif (consume(ready: 1)) { message 'ready' }"},
      {.name = "poll",
       .signatures = {takes({plain("name", Kinds(Kind::text) | Kind::map)})},
       .result = Kind::boolean,
       .doc = "Whether there is a signal of that name, or one with that value, or one for which the closure is true. "
              "Takes nothing away.",
       .named = NamedArguments::values,
       .example =
           "post height: 40\nmessage poll('height')\nmessage poll(height: 40)\nmessage poll(height: { it > 30 })"},
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
      {.name = "min",
       .signatures = {takes_many(plain("x", any))},
       .result = any,
       .doc = "The smallest.",
       .example = "message min(3, 1, 2)"},
      {.name = "max",
       .signatures = {takes_many(plain("x", any))},
       .result = any,
       .doc = "The largest.",
       .example = "message max(3, 1, 2)"},
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
      {.name = "type", .signatures = {takes({plain("kind", text)})}, .doc = "UAV, UGV, USV or UUV; any if left out."},
      {.name = "id",
       .signatures = {takes({plain("vehicle", text | Kinds(Kind::integer))})},
       .doc = "The vehicle of that id; over MAVLink its system id."},
      {.name = "payload",
       .signatures = {takes_many(plain("name", text))},
       .doc = "What each vehicle must carry, by exact names; all of them."},
      {.name = "region",
       .signatures = {takes({plain("area", Kind::area)}), takes({plain("centre", place), metres("radius")})},
       .doc = "Where each vehicle must be."},
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
    case tasks::Type::list: return Kind::list;
    case tasks::Type::area: return Kinds(Kind::area) | Kind::list;
    case tasks::Type::layer: return text;
  }
  return any;
}

ParameterSpec parameter_of(tasks::Parameter const& parameter) {
  ParameterSpec out{.name = parameter.name,
                    .kinds = kinds_of(parameter.type),
                    .dimension = parameter.dimension,
                    .optional = parameter.fallback.has_value(),
                    .choices = parameter.choices,
                    .doc = parameter.doc};
  if (parameter.type == tasks::Type::list) out.items = kinds_of(parameter.items);
  if (parameter.type == tasks::Type::area) out.items = place;
  return out;
}

constexpr auto kind_words = std::to_array<std::pair<Kind, std::string_view>>({
    {Kind::boolean, "true or false"},
    {Kind::integer, "a whole number"},
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
    bool const is_said = kind == Kind::integer && kinds.meets(Kind::decimal);  // a number, whole or not
    if (kinds.meets(kind) && !is_said) words.push_back(word);
  }
  return words.empty() ? "another value" : fmt::format("{}", fmt::join(words, " or "));
}

std::string_view noun(Dimension dimension) {
  switch (dimension) {
    case Dimension::none: return "a plain number";
    case Dimension::length: return "a length";
    case Dimension::angle: return "an angle";
    case Dimension::time: return "a time";
    case Dimension::speed: return "a speed";
    case Dimension::ratio: return "a ratio";
  }
  return "a number";
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
    for (auto const& parameter : overload.parameters) signature.parameters.push_back(parameter_of(parameter));
    out.signatures.push_back(std::move(signature));
  }
  return out;
}

InstructionSpec instruction_of(tasks::VehicleInstruction const& instruction) {
  auto signature = takes({plain("vehicles", vehicles)});
  for (auto const& parameter : instruction.parameters) signature.parameters.push_back(parameter_of(parameter));
  return {.name = instruction.name,
          .signatures = {std::move(signature)},
          .result = nothing,
          .doc = instruction.doc,
          .named = instruction.takes_values ? NamedArguments::values : NamedArguments::none,
          .example = instruction.example};
}

}  // namespace lapwing::dolphin
