#include "dolphin/value/platform_arguments.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin {
namespace {

/// One value that is no list and no area; nothing when it is of another type.
std::optional<tasks::Item> converted_item(Value const& value, tasks::Type type) {
  switch (type) {
    case tasks::Type::number:
      if (value.is_number()) return value.number();
      break;
    case tasks::Type::integer:
      if (value.is(ValueKind::integer)) return value.integer();
      if (value.is(ValueKind::real) && std::fabs(value.real()) < 9e15)
        return static_cast<std::int64_t>(std::llround(value.real()));
      break;
    case tasks::Type::text:
      if (value.is(ValueKind::text)) return value.as<Text>()->text;
      break;
    case tasks::Type::boolean:
      if (value.is(ValueKind::boolean)) return value.boolean();
      break;
    case tasks::Type::position:
      if (value.is(ValueKind::position)) return value.as<Position>()->value;
      break;
    case tasks::Type::displacement:
      if (value.is(ValueKind::displacement)) return value.as<Displacement>()->value;
      break;
    case tasks::Type::list:
    case tasks::Type::area:
    case tasks::Type::layer: break;
  }
  return std::nullopt;
}

std::optional<tasks::List> converted_list(Value const& value, tasks::Type items) {
  auto const* list = value.as<List>();
  if (!list) return std::nullopt;
  tasks::List out;
  for (auto const& item : list->items) {
    auto converted = converted_item(item, items);
    if (!converted) return std::nullopt;
    out.push_back(*std::move(converted));
  }
  return out;
}

/// `centre ^ radius`, or the corners in a list.
std::optional<geo::Area> converted_area(Value const& value) {
  if (auto const* disc = value.as<Area>()) return disc->value;
  auto corners = converted_list(value, tasks::Type::position);
  return corners ? tasks::area_from(*std::move(corners)) : std::nullopt;
}

std::optional<tasks::Argument> converted(Value const& value, tasks::Parameter const& parameter) {
  if (parameter.type == tasks::Type::list) return converted_list(value, parameter.items);
  if (parameter.type == tasks::Type::area) return converted_area(value);
  bool const is_layer = parameter.type == tasks::Type::layer;
  auto const item = converted_item(value, is_layer ? tasks::Type::text : parameter.type);
  if (!item) return std::nullopt;
  if (is_layer) return tasks::LayerName{std::get<std::string>(*item)};
  return tasks::argument_of(*item);
}

}  // namespace

std::string_view type_name(tasks::Type type) {
  switch (type) {
    case tasks::Type::number: return "number";
    case tasks::Type::integer: return "integer";
    case tasks::Type::text: return "text";
    case tasks::Type::boolean: return "boolean";
    case tasks::Type::position: return "position";
    case tasks::Type::displacement: return "displacement";
    case tasks::Type::list: return "list";
    case tasks::Type::area: return "area";
    case tasks::Type::layer: return "layer";
  }
  return "value";
}

std::optional<std::vector<tasks::Argument>> fitted(std::span<tasks::Parameter const> parameters,
                                                   std::span<Value const> given) {
  if (given.size() > parameters.size()) return std::nullopt;
  std::vector<tasks::Argument> result;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    auto const argument = i < given.size() ? converted(given[i], parameters[i]) : parameters[i].fallback;
    if (!argument) return std::nullopt;
    result.push_back(*argument);
  }
  return result;
}

std::optional<std::string> wrong_value(std::span<tasks::Parameter const> parameters,
                                       std::span<tasks::Argument const> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto const& name = parameters[i].name;
    auto const& choices = parameters[i].choices;
    auto const* text = std::get_if<std::string>(&values[i]);
    if (text && !choices.empty() && std::ranges::find(choices, *text) == choices.end())
      return fmt::format("{} is \"{}\", but must be one of {}", name, *text, fmt::join(choices, ", "));
    auto const* area = std::get_if<geo::Area>(&values[i]);
    if (auto const fault = area ? geo::area_fault(*area) : std::nullopt)
      return fmt::format("{} is no area: {}", name, *fault);
    auto const* layer = std::get_if<tasks::LayerName>(&values[i]);
    if (layer && layer->text.empty()) return fmt::format("{} is no layer: a layer has a name", name);
  }
  return std::nullopt;
}

std::optional<tasks::Argument> named_value(Value const& value) {
  if (auto const* text = value.as<Text>()) return tasks::Argument{text->text};
  if (value.kind() == ValueKind::integer) return tasks::Argument{value.integer()};
  if (value.is_number()) return tasks::Argument{value.number()};
  if (value.kind() == ValueKind::boolean) return tasks::Argument{value.boolean()};
  return std::nullopt;
}

}  // namespace lapwing::dolphin
