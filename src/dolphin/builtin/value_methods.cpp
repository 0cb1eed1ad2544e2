#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/builtin/members.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"

/// Methods and properties of numbers, places, vehicles and tasks, and of every value.
namespace lapwing::dolphin::internal {
namespace {

// ---- numbers

Checked<Value> integer_of(Value const& number, double rounded) {
  if (number.is(ValueKind::integer)) return number;
  if (!(std::fabs(rounded) < 9.2e18)) return fault(to_text(number) + " is no integer", "ArithmeticException");
  return Value::integer(static_cast<std::int64_t>(rounded));
}

/// `x.round()` is an integer, `x.round(2)` has two decimal places.
Checked<Value> rounded(Call call, Number const& number) {
  auto const x = number.value.number();
  if (call.arguments.empty()) return integer_of(number.value, std::floor(x + 0.5));
  auto const places = call.integer_argument();
  if (!places) return std::unexpected(places.error());
  if (*places < 0 || *places > 15) return fault("round takes 0 to 15 decimal places", "IllegalArgumentException");
  double const scale = std::pow(10.0, static_cast<double>(*places));
  return Value::real(std::floor(x * scale + 0.5) / scale);
}

Checked<Value> divided(Call call, Number const& number) {
  auto const& by = call.arguments[0];
  if (!number.value.is(ValueKind::integer) || !by.is(ValueKind::integer)) {
    return fault(fmt::format("intdiv divides integers, not {} by {}", kind_name(number.value), kind_name(by)),
                 "MissingMethodException");
  }
  if (by.integer() == 0) return fault("division by zero", "ArithmeticException");
  if (by.integer() == -1) return negate(number.value);
  return Value::integer(number.value.integer() / by.integer());
}

Checked<Value> absolute(Call /*call*/, Number const& number) {
  if (number.value.is(ValueKind::real)) return Value::real(std::fabs(number.value.real()));
  return number.value.integer() < 0 ? negate(number.value) : Checked<Value>(number.value);
}

// ---- places

Value height(Call /*call*/, Position const& place) {
  return Value::real(place.value.alt_m);
}

MethodResult distance(Call call, Position const& place) {
  auto const* other = call.arguments[0].as<Position>();
  if (!other) return std::nullopt;
  return Value::real(geo::distance_m(place.value, other->value));
}

MethodResult is_near(Call call, Position const& place) {
  auto const* other = call.arguments[0].as<Position>();
  if (!other || !call.arguments[1].is_number()) return std::nullopt;
  return Value::boolean(geo::distance_m(place.value, other->value) <= call.arguments[1].number());
}

// ---- vehicles

Value vehicle_id(Call call, Vehicle const& vehicle) {
  return call.text(vehicle.value.text);
}

using Info = tasks::VehicleInfo const&;

Value payload(Call call, Info info) {
  auto names = call.heap.make<List>();
  for (auto const& one : info.payload) names->push(call.text(one));
  return Value(names);
}

/// What the platform tells of a vehicle.
template <auto function>
Checked<Value> told(Call call, Vehicle const& vehicle) {
  auto const info = call.runtime.platform.find(vehicle.value);
  if (!info) return fault(fmt::format("vehicle {} is not known any more", vehicle.value.text), "IllegalStateException");
  return function(call, *info);
}

// ---- every value

Value task_name(Call call, TaskValue const& task) {
  return call.text(tasks::name(task.value));
}

Checked<Value> compared(Call call, Value const& value) {
  auto const order = compare(value, call.arguments[0]);
  if (!order) return std::unexpected(order.error());
  return Value::integer(*order < 0 ? -1 : *order > 0 ? 1 : 0);
}

/// Errors and types have a member of their own.
MethodResult class_of(Call call, Value const& value) {
  if (value.is(ValueKind::error) || value.is(ValueKind::type)) return std::nullopt;
  return type_of(call.heap, value);
}

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    written({number, "times", "closure", any, "Calls the closure with 0 to n - 1.", ""}, R"(def times(n, f) {
  for (def i = 0; i < n; i++) { f(i) }
  return null
})"),
    written({number, "upto", "last, closure", any, "Calls the closure with each up to the other.", ""},
            R"(def upto(first, last, f) {
  for (def i = first; i <= last; i++) { f(i) }
  return null
})"),
    written({number, "step", "end, by, closure", any,
             "Calls the closure with each up to before the other, so far apart.", ""},
            R"(def step(first, last, by, f) {
  for (def i = first; by > 0 ? i < last : i > last; i += by) { f(i) }
  return null
})"),
    {number, "isInfinite", "", Kind::boolean, "Whether it is beyond all numbers.", "1.0.isInfinite()",
     of<[](Call, Number const& x) { return Value::boolean(std::isinf(x.value.number())); }>},
    {number, "div", "n", any, "The same as /.", "", of<by_operator<ast::BinaryOp::divide>>},
    {number, "mod", "n", any, "The same as %.", "", of<by_operator<ast::BinaryOp::remainder>>},
    {number, "power", "n", any, "The same as **.", "", of<by_operator<ast::BinaryOp::power>>},
    written({number, "downto", "last, closure", any, "Calls the closure with each down to the other.", ""},
            R"(def downto(first, last, f) {
  for (def i = first; i >= last; i--) { f(i) }
  return null
})"),
    pure({number, "intdiv", "n", Kind::integer, "Divided, without the rest.", "7.intdiv(2)", of<divided>}),
    pure({number, "abs", "", number, "Without its sign.", "(-7).abs()", of<absolute>}),
    pure({number, "round", "places?", number, "Rounded to an integer, or to so many decimal places.", "2.345.round(1)",
          of<rounded>}),
    {number, "intValue", "", Kind::integer, "As an integer.", "2.9.intValue()", of<as_integer>},
    {number, "longValue", "", Kind::integer, "As an integer.", "", of<as_integer>},
    {number, "toLong", "", Kind::integer, "As an integer.", "", of<as_integer>},
    {number, "isNaN", "", Kind::boolean, "Whether it is not a number.", "NaN.isNaN()",
     of<[](Call, Number const& x) { return Value::boolean(std::isnan(x.value.number())); }>},
    {number, "doubleValue", "", Kind::decimal, "As a decimal.", "", of<as_real>},
    property(Kind::position, "lat", Kind::decimal, "Latitude, degrees.", "location(41, -8).lat",
             of<[](Call, Position& at) { return Value::real(at.value.lat_deg()); }>),
    property(Kind::position, "lon", Kind::decimal, "Longitude, degrees.", "location(41, -8).lon",
             of<[](Call, Position& at) { return Value::real(at.value.lon_deg()); }>),
    property(Kind::position, "hae", Kind::decimal, "Height, metres.", "", of<height>),
    property(Kind::position, "height", Kind::decimal, "Height, metres.", "location(41, -8, 90).height", of<height>),
    pure({Kind::position, "distanceTo", "position", Kind::decimal, "Metres to the other place, height included.",
          "location(41, -8).distanceTo(location(41, -8.001)).round()", of<distance>}),
    pure({Kind::position, "near", "position, metres", Kind::boolean,
          "Whether the other place is within so many metres.", "location(41, -8).near(location(41, -8.001), 50)",
          of<is_near>}),
    property(Kind::displacement, "north", Kind::decimal, "Metres north.", "moveDistance { north 5 }.north",
             of<[](Call, Displacement& by) { return Value::real(by.value.north); }>),
    property(Kind::displacement, "east", Kind::decimal, "Metres east.", "",
             of<[](Call, Displacement& by) { return Value::real(by.value.east); }>),
    property(Kind::displacement, "down", Kind::decimal, "Metres down.", "",
             of<[](Call, Displacement& by) { return Value::real(by.value.down); }>),
    pure({Kind::area, "contains", "position", Kind::boolean, "Whether the place is in it.",
          "(location(41, -8) ^ 50).contains(location(42, -8))", of<holds<Area>>}),
    property(Kind::area, "center", Kind::position, "The centre.", "(location(41, -8) ^ 50).center",
             of<[](Call call, Area& area) { return Value(call.heap.make<Position>(area.value.center)); }>),
    property(Kind::area, "radius", Kind::decimal, "The radius, metres.", "(location(41, -8) ^ 50).radius",
             of<[](Call, Area& area) { return Value::real(area.value.radius_m); }>),
    property(Kind::vehicles, "id", Kind::list, "The id of a vehicle; of a set, the list of all.", "", of<vehicle_id>),
    property(Kind::vehicles, "type", Kind::list, "The type of a vehicle; of a set, the list of all.", "",
             of<told<[](Call call, Info info) { return call.text(info.type); }>>),
    property(Kind::vehicles, "payload", Kind::list, "What a vehicle carries; of a set, the list of all.", "",
             of<told<payload>>),
    property(Kind::vehicles, "name", Kind::list, "The same as `id`; of a set, the list of all.", "", of<vehicle_id>),
    property(Kind::vehicles, "connected", Kind::list,
             "Whether a vehicle has been heard lately; of a set, the list of all.", "",
             of<told<[](Call, Info info) { return Value::boolean(info.connected); }>>),
    property(Kind::vehicles, "battery", Kind::list,
             "What is left in the battery of a vehicle, 0 to 1; of a set, the list of all.", "",
             of<told<[](Call, Info info) {
               return Value::real(info.battery.value_or(std::numeric_limits<double>::quiet_NaN()));
             }>>),
    property(Kind::vehicles, "position", Kind::list, "Where a vehicle is; of a set, the list of all.", "",
             of<told<[](Call call, Info info) {
               return info.position ? Value(call.heap.make<Position>(*info.position)) : Value();
             }>>),
    property(Kind::vehicles, "connectionTimeout", Kind::list,
             "Seconds until a silent vehicle counts as lost; of a set, the list of all.", "",
             of<told<[](Call, Info info) { return Value::real(base::to_seconds(info.connection_timeout)); }>>),
    property(Kind::task, "id", Kind::text, "The name of the task.", "", of<task_name>),
    property(Kind::task, "name", Kind::text, "The same as `id`.", "", of<task_name>),
    {Kind::closure, "call", "values...", any, "Calls it.", "{ a, b -> a + b }.call(1, 2)"},
    pure({any, "toString", "", Kind::text, "As text.", "1.5.toString()",
          of<[](Call call, Value const& value) { return call.text(to_text(value)); }>}),
    {any, "compareTo", "value", Kind::integer, "-1, 0 or 1, as <=> gives.", "1.compareTo(2)", of<compared>},
    {any, "getClass", "", Kind::other, "Its type, also of a map.", "[a: 1].getClass().simpleName",
     of<[](Call call, Value const& value) { return type_of(call.heap, value); }>},
    {any, "equals", "value", Kind::boolean, "Whether both are equal.", "[1].equals([1.0])",
     of<[](Call call, Value const& value) { return Value::boolean(equal(value, call.arguments[0])); }>},
    property(any, "class", Kind::other, "Its type; of a map it is the value of the key `class`.",
             "'text'.class.simpleName", of<class_of>),
});

}  // namespace

Checked<Value> as_integer(Call /*call*/, Number const& number) {
  return integer_of(number.value, std::trunc(number.value.number()));
}

Value as_real(Call /*call*/, Number const& number) {
  return Value::real(number.value.number());
}

std::span<MethodSpec const> value_methods() {
  return table;
}

}  // namespace lapwing::dolphin::internal
