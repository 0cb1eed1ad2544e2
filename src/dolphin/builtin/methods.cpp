#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dolphin/builtin/members.hpp"
#include "dolphin/builtin/method_lists.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"

/// Methods of vehicles, places, numbers and all values; who has a method of that name at all.
namespace lapwing::dolphin {

namespace internal {

Checked<std::int64_t> MethodCall::integer_argument(std::size_t index) const {
  auto const& given = arguments[index];
  if (given.is(ValueKind::integer)) return given.integer();
  return fault(fmt::format("{} takes an integer, not {}", name, kind_name(given)), "IllegalArgumentException");
}

}  // namespace internal

namespace {

using internal::MethodResult;
using Call = internal::MethodCall;

Checked<Value> membership(Value const& container, Value const& item) {
  auto const holds = contains(container, item);
  if (!holds) return std::unexpected(holds.error());
  return Value::boolean(*holds);
}

/// A part of the set in its order: a set again.
MethodResult part_of_set(Call const& call, Vehicles const& set, List& members) {
  auto const part = internal::list_method(call, members);
  if (!part || !*part) return part;
  std::vector<vehicle::VehicleId> ids;
  for (auto const& item : (*part)->as<List>()->items) ids.push_back(item.as<Vehicle>()->value);
  return Value(set.heap().make<Vehicles>(std::move(ids)));
}

MethodResult vehicles_method(Call const& call, Vehicles& set) {
  auto& heap = call.heap;
  auto members = heap.make<List>();
  for (auto const& id : set.ids) members->push(heap.make<Vehicle>(id));
  if (call.is("contains", 1)) return membership(Value(&set), call.arguments[0]);
  if (call.is("emptyLike", 0)) return Value(heap.make<Vehicles>(std::vector<vehicle::VehicleId>{}));
  if (call.is("with", 1) && call.arguments[0].is(ValueKind::vehicle)) {
    auto ids = set.ids;
    ids.push_back(call.arguments[0].as<Vehicle>()->value);
    return Value(heap.make<Vehicles>(std::move(ids)));
  }
  for (auto const* word : {"take", "drop", "tail", "init", "reverse"}) {
    if (call.name == word) return part_of_set(call, set, *members);
  }
  for (auto const* word : {"size", "isEmpty", "join", "first", "last", "get", "toList", "indexOf"}) {
    if (call.name == word) return internal::list_method(call, *members);
  }
  return std::nullopt;
}

MethodResult position_method(Call const& call, geo::Wgs84 const& place) {
  auto const* other = call.arguments.empty() ? nullptr : call.arguments[0].as<Position>();
  if (call.is("distanceTo", 1) && other) return Value::real(geo::distance_m(place, other->value));
  if (call.is("near", 2) && other && call.arguments[1].is_number()) {
    return Value::boolean(geo::distance_m(place, other->value) <= call.arguments[1].number());
  }
  return std::nullopt;
}

Checked<Value> integer_of(Value const& number, double rounded) {
  if (number.is(ValueKind::integer)) return number;
  if (!(std::fabs(rounded) < 9.2e18)) return fault(to_text(number) + " is no integer", "ArithmeticException");
  return Value::integer(static_cast<std::int64_t>(rounded));
}

/// `x.round()` is an integer, `x.round(2)` has two decimal places.
Checked<Value> rounded(Call const& call, Value const& number) {
  if (call.arguments.empty()) return integer_of(number, std::floor(number.number() + 0.5));
  auto const places = call.integer_argument();
  if (!places) return std::unexpected(places.error());
  if (*places < 0 || *places > 15) return fault("round takes 0 to 15 decimal places", "IllegalArgumentException");
  double const scale = std::pow(10.0, static_cast<double>(*places));
  return Value::real(std::floor(number.number() * scale + 0.5) / scale);
}

Checked<Value> divided(Value const& number, Value const& by) {
  if (!number.is(ValueKind::integer) || !by.is(ValueKind::integer)) {
    return fault(fmt::format("intdiv divides integers, not {} by {}", kind_name(number), kind_name(by)),
                 "MissingMethodException");
  }
  if (by.integer() == 0) return fault("division by zero", "ArithmeticException");
  if (by.integer() == -1) return negate(number);
  return Value::integer(number.integer() / by.integer());
}

MethodResult number_method(Call const& call, Value const& number) {
  if (call.is("intdiv", 1)) return divided(number, call.arguments[0]);
  if (call.is("abs", 0)) {
    if (number.is(ValueKind::real)) return Value::real(std::fabs(number.real()));
    return number.integer() < 0 ? negate(number) : Checked<Value>(number);
  }
  if (call.is("toInteger", 0) || call.is("toLong", 0) || call.is("intValue", 0) || call.is("longValue", 0)) {
    return integer_of(number, std::trunc(number.number()));
  }
  if (call.is("toDouble", 0) || call.is("toFloat", 0) || call.is("doubleValue", 0)) {
    return Value::real(number.number());
  }
  if (call.is("isNaN", 0)) return Value::boolean(number.is(ValueKind::real) && std::isnan(number.real()));
  if (call.is("isInfinite", 0)) return Value::boolean(number.is(ValueKind::real) && std::isinf(number.real()));
  if (call.is("round", 0) || call.is("round", 1)) return rounded(call, number);
  return std::nullopt;
}

/// The operators by their names: `a.plus(b)`.
std::optional<ast::BinaryOp> operator_of(std::string_view name) {
  using enum ast::BinaryOp;
  if (name == "plus") return add;
  if (name == "minus") return subtract;
  if (name == "multiply") return multiply;
  if (name == "div") return divide;
  if (name == "mod") return remainder;
  if (name == "power") return power;
  return std::nullopt;
}

MethodResult common_method(Call const& call, Value const& object) {
  if (call.is("toString", 0)) return call.text(to_text(object));
  if (call.is("getClass", 0)) return type_of(call.heap, object);
  if (call.is("equals", 1)) return Value::boolean(equal(object, call.arguments[0]));
  if (call.is("compareTo", 1)) {
    auto const order = compare(object, call.arguments[0]);
    if (!order) return std::unexpected(order.error());
    return Value::integer(*order < 0 ? -1 : *order > 0 ? 1 : 0);
  }
  auto const operation = call.arguments.size() == 1 ? operator_of(call.name) : std::nullopt;
  if (operation) return apply(call.heap, *operation, object, call.arguments[0], {});
  return std::nullopt;
}

MethodResult kind_method(Call const& call, Value const& object) {
  switch (object.kind()) {
    case ValueKind::integer:
    case ValueKind::real: return number_method(call, object);
    case ValueKind::text: return internal::text_method(call, object.as<Text>()->text);
    case ValueKind::list: return internal::list_method(call, *object.as<List>());
    case ValueKind::map: return internal::map_method(call, *object.as<Map>());
    case ValueKind::range: return internal::range_method(call, *object.as<Range>());
    case ValueKind::vehicles: return vehicles_method(call, *object.as<Vehicles>());
    case ValueKind::position: return position_method(call, object.as<Position>()->value);
    case ValueKind::area:
      if (!call.is("contains", 1)) return std::nullopt;
      return membership(object, call.arguments[0]);
    case ValueKind::closure:
      if (!call.is("parameterCount", 0)) return std::nullopt;
      return Value::integer(object.as<Closure>()->function->parameters);
    default: return std::nullopt;
  }
}

bool is_getter(std::string_view name) {
  return name.size() > 3 && name.starts_with("get") && std::isupper(name[3]);
}

}  // namespace

std::optional<Checked<Value>> call_method(Runtime& runtime, Value const& object, std::string_view name,
                                          Arguments arguments) {
  Call const call{runtime.heap, runtime.patterns, name, arguments};
  if (auto result = kind_method(call, object)) return result;
  if (auto result = common_method(call, object)) return result;
  // A map has what was put into it and nothing that getters could get.
  if (is_getter(name) && arguments.empty() && !object.is(ValueKind::map)) {
    std::string property(name.substr(3));
    property[0] = static_cast<char>(std::tolower(property[0]));
    return member(runtime, object, property);
  }
  return std::nullopt;
}

}  // namespace lapwing::dolphin
