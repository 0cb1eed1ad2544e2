#include "dolphin/names/signatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "dolphin/names/row_parameters.hpp"

namespace lapwing::dolphin {

namespace {

using namespace rows;

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

ArgumentCount argument_count(InstructionSpec const& instruction) {
  constexpr auto unlimited = std::numeric_limits<std::size_t>::max();
  ArgumentCount out{.least = unlimited, .most = 0};
  for (auto const& [parameters, repeats] : instruction.signatures) {
    auto const optional = std::ranges::count_if(parameters, &ParameterSpec::optional);
    out.least = std::min(out.least, parameters.size() - static_cast<std::size_t>(optional));
    out.most = std::max(out.most, repeats ? unlimited : parameters.size());
  }
  return out;
}

std::span<InstructionSpec const> block_words(BlockKind kind) {
  static auto const pick = pick_fields();
  static auto const position = position_fields();
  static auto const displacement = displacement_fields();
  switch (kind) {
    case BlockKind::pick: return pick;
    case BlockKind::position: return position;
    case BlockKind::displacement: return displacement;
    case BlockKind::handler: return handler_words();
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
