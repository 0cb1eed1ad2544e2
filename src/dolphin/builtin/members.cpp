#include "dolphin/builtin/members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "dolphin/builtin/method_call.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {
namespace {

std::unexpected<Fault> no_member(Value const& object, std::string_view name) {
  return fault(fmt::format("{} has no property {}", kind_name(object), name), "MissingPropertyException");
}

Checked<Value> error_member(Heap& heap, ErrorData const& error, Value const& object, std::string_view name) {
  if (name == "message") return Value(heap.make<Text>(error.message));
  if (name == "type" || name == "simpleName") return Value(heap.make<Text>(error.type));
  if (name == "line") return Value::integer(error.line);
  if (name == "class") return Value(heap.make<TypeValue>(TypeName{error.type}));
  return no_member(object, name);
}

Checked<Value> outcome_member(Heap& heap, OutcomeData const& outcome, Value const& object, std::string_view name) {
  if (name == "done") return Value::boolean(outcome.done);
  if (name == "error") return outcome.error.empty() ? Value() : Value(heap.make<Text>(outcome.error));
  if (name == "vehicles") return Value(heap.make<Vehicles>(outcome.vehicles));
  return no_member(object, name);
}

struct Constant {
  std::string_view type;
  std::string_view name;
  std::variant<std::int64_t, double> value;
};

template <class T>
using Limits = std::numeric_limits<T>;

/// Double has those of Float. PRECISION_LAND_MODE is MAVLink's, of common.xml.
constexpr auto constants = std::to_array<Constant>({
    {"Float", "NaN", Limits<double>::quiet_NaN()},
    {"Float", "MAX_VALUE", Limits<double>::max()},
    {"Float", "POSITIVE_INFINITY", Limits<double>::infinity()},
    {"Float", "NEGATIVE_INFINITY", -Limits<double>::infinity()},
    {"Long", "MAX_VALUE", Limits<std::int64_t>::max()},
    {"Long", "MIN_VALUE", Limits<std::int64_t>::min()},
    {"Integer", "MAX_VALUE", std::int64_t{Limits<std::int32_t>::max()}},
    {"Integer", "MIN_VALUE", std::int64_t{Limits<std::int32_t>::min()}},
    {"Math", "PI", std::numbers::pi},
    {"Math", "E", std::numbers::e},
    {"PRECISION_LAND_MODE", "PRECISION_LAND_MODE_DISABLED", std::int64_t{0}},
    {"PRECISION_LAND_MODE", "PRECISION_LAND_MODE_OPPORTUNISTIC", std::int64_t{1}},
    {"PRECISION_LAND_MODE", "PRECISION_LAND_MODE_REQUIRED", std::int64_t{2}},
});

Checked<Value> type_member(Heap& heap, TypeName const& type, Value const& object, std::string_view name) {
  if (name == "simpleName" || name == "name") return Value(heap.make<Text>(type.name));
  if (name == "class") return object;
  std::string_view const known_as = type.name == "Double" ? std::string_view("Float") : type.name;
  for (auto const& constant : constants) {
    if (constant.type != known_as || constant.name != name) continue;
    if (auto const* whole = std::get_if<std::int64_t>(&constant.value)) return Value::integer(*whole);
    return Value::real(std::get<double>(constant.value));
  }
  return fault(fmt::format("{} has no constant {}", type.name, name), "MissingPropertyException");
}

/// `list.name` is the list of that member of all; lists may nest, and may hold themselves.
class Spread {
 public:
  Spread(Runtime& runtime, std::string_view name) : runtime_(runtime), name_(name) {}

  Checked<Value> of(List const& list, int depth = 0) {
    if (depth > max_printed_depth) return fault(fmt::format("lists are nested too deep to read {}", name_));
    auto result = runtime_.heap.make<List>();
    for (auto const& item : list.items) {
      if (++looked_at_ > max_spread_values)
        return fault(fmt::format("the lists are too long to read {}", name_), "OutOfMemoryError");
      auto const* inner = item.as<List>();
      auto value = inner ? of(*inner, depth + 1) : member(runtime_, item, name_);
      if (!value) return value;
      result->push(std::move(*value));
    }
    return Value(result);
  }

 private:
  Runtime& runtime_;
  std::string_view name_;
  std::size_t looked_at_ = 0;
};

std::string_view type_name(Value const& value) {
  switch (value.kind()) {
    case ValueKind::null: return "Null";
    case ValueKind::boolean: return "Boolean";
    case ValueKind::integer: return "Integer";
    case ValueKind::real: return "Double";
    case ValueKind::text: return "String";
    case ValueKind::list: return "List";
    case ValueKind::map: return "Map";
    case ValueKind::entry: return "Entry";
    case ValueKind::range: return "Range";
    case ValueKind::closure: return "Closure";
    case ValueKind::vehicles: return "VehicleSet";
    case ValueKind::vehicle: return "Vehicle";
    case ValueKind::position: return "Position";
    case ValueKind::displacement: return "Displacement";
    case ValueKind::area: return "Area";
    case ValueKind::task: return "Task";
    case ValueKind::error: return value.as<Error>()->value.type;
    case ValueKind::pattern: return "Pattern";
    default: return "Object";
  }
}

/// The next more general class of a Java exception; RuntimeException for what has no entry.
std::string_view parent_of(std::string_view type) {
  static constexpr std::pair<std::string_view, std::string_view> parents[] = {
      {"NumberFormatException", "IllegalArgumentException"},
      {"ArrayIndexOutOfBoundsException", "IndexOutOfBoundsException"},
      {"StringIndexOutOfBoundsException", "IndexOutOfBoundsException"},
      {"FileNotFoundException", "IOException"},
      {"IOException", "Exception"},
      {"TimeoutException", "Exception"},
      {"InterruptedException", "Exception"},
      {"RuntimeException", "Exception"},
      {"StackOverflowError", "Error"},
      {"OutOfMemoryError", "Error"},
      {"AssertionError", "Error"},
      {"Error", "Exception"},  // `catch (Exception e)` is how scripts say "whatever it is"
      {"Exception", "Throwable"},
      {"Throwable", "Object"},
      {"Object", ""}};
  auto const found = std::ranges::find(parents, type, &std::pair<std::string_view, std::string_view>::first);
  if (found != std::end(parents)) return found->second;
  return type.ends_with("Error") ? "Exception" : "RuntimeException";
}

bool is_kind_of_error(std::string_view type, std::string_view general) {
  for (; !type.empty(); type = parent_of(type)) {
    if (type == general) return true;
  }
  return false;
}

bool is_error_type(std::string_view type) {
  auto const ends = [&](std::string_view end) { return type.ends_with(end); };
  return ends("Exception") || ends("Error") || type == "Throwable";
}

}  // namespace

Value type_of(Heap& heap, Value const& value) {
  if (value.is(ValueKind::type)) return value;
  return Value(heap.make<TypeValue>(TypeName{std::string(type_name(value))}));
}

Checked<Value> member(Runtime& runtime, Value const& object, std::string_view name) {
  auto& heap = runtime.heap;
  if (object.is_number()) {
    if (auto result = with_unit(object, name)) return *result;
  }
  if (!object.is(ValueKind::map)) {  // a map has its keys and nothing else
    if (auto result = property(runtime, object, name)) return *result;
  }
  switch (object.kind()) {
    case ValueKind::null: return fault(fmt::format("cannot read {} of null", name), "NullPointerException");
    case ValueKind::map: return object.as<Map>()->at(Value(heap.make<Text>(std::string(name))));
    case ValueKind::entry:
      if (name == "key") return object.as<Entry>()->key;
      if (name == "value") return object.as<Entry>()->value;
      return no_member(object, name);
    case ValueKind::list: return Spread(runtime, name).of(*object.as<List>());
    case ValueKind::range:
      if (name == "from") return Value::integer(object.as<Range>()->first);
      if (name == "to") return Value::integer(object.as<Range>()->last);
      return no_member(object, name);
    case ValueKind::vehicles: {
      auto members = heap.make<List>();
      for (auto const& id : object.as<Vehicles>()->ids) members->push(heap.make<Vehicle>(id));
      return Spread(runtime, name).of(*members);
    }
    case ValueKind::error: return error_member(heap, object.as<Error>()->value, object, name);
    case ValueKind::outcome: return outcome_member(heap, object.as<ExecuteOutcome>()->value, object, name);
    case ValueKind::type: return type_member(heap, object.as<TypeValue>()->value, object, name);
    default: return no_member(object, name);
  }
}

Checked<void> set_member(Runtime& runtime, Value const& object, std::string_view name, Value value) {
  auto* map = object.as<Map>();
  if (!map)
    return fault(fmt::format("properties of {} cannot be assigned to", kind_name(object)), "IllegalArgumentException");
  map->set(Value(runtime.heap.make<Text>(std::string(name))), std::move(value));
  return {};
}

Checked<Value> call_static(Runtime& runtime, Fiber& fiber, std::string_view name, Arguments arguments) {
  auto const point = name.find('.');
  auto const type = name.substr(0, point);
  auto const method = name.substr(point + 1);
  if (type == "System" && method == "currentTimeMillis") {
    auto const since = runtime.loop.utc_now().time_since_epoch();
    return Value::integer(std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
  }
  if (type == "Position" && method == "fromDegrees") {
    return natives()[static_cast<std::size_t>(find_native("location").value())].call(runtime, fiber, arguments);
  }
  if (type == "Math" && method == "random" && arguments.empty()) {
    return Value::real(static_cast<double>(runtime.random() >> 11U) * 0x1p-53);  // 53 bits: [0, 1)
  }
  if (type == "System" && method == "nanoTime" && arguments.empty()) {
    return Value::integer(std::chrono::nanoseconds(runtime.loop.now().time_since_epoch()).count());
  }
  if (type == "String" && method == "format" && !arguments.empty()) {
    auto text = internal::formatted(to_text(arguments.front()), arguments.subspan(1));
    if (!text) return std::unexpected(text.error());
    return make_text(runtime.heap, std::move(*text));
  }
  if (type == "Math") {
    auto const index = find_native(method);
    if (index && natives()[static_cast<std::size_t>(*index)].is_pure) {
      auto const& native = natives()[static_cast<std::size_t>(*index)];
      if (argument_count(native).allows(arguments.size())) return native.call(runtime, fiber, arguments);
    }
  }
  if ((type == "Integer" || type == "Long" || type == "Double" || type == "Float") && method.starts_with("parse") &&
      arguments.size() == 1) {
    return cast(runtime, arguments.front(), type);
  }
  if (type == "String" && method == "valueOf" && arguments.size() == 1)
    return cast(runtime, arguments.front(), "String");
  return fault(fmt::format("{} has no function {} with {} arguments", type, method, arguments.size()),
               "MissingMethodException");
}

Checked<Value> construct(Runtime& runtime, std::string_view type, Arguments arguments, int line) {
  auto& heap = runtime.heap;
  if (is_error_type(type)) {
    std::string message = arguments.empty() ? "null" : to_text(arguments.front());
    return Value(heap.make<Error>(ErrorData{std::string(type), std::move(message), line}));
  }
  if (type == "Position" && (arguments.size() == 2 || arguments.size() == 3)) {
    if (!std::ranges::all_of(arguments, &Value::is_number))
      return fault("new Position takes numbers", "IllegalArgumentException");
    runtime.log.warn(fmt::format("line {}: new Position takes radians; location(lat, lon) takes degrees", line));
    double const height = arguments.size() == 3 ? arguments[2].number() : 0.0;
    return Value(heap.make<Position>(geo::Wgs84{arguments[0].number(), arguments[1].number(), height}));
  }
  if ((type == "ArrayList" || type == "LinkedList") && arguments.empty()) return Value(heap.make<List>());
  if ((type == "HashMap" || type == "LinkedHashMap" || type == "TreeMap") && arguments.empty())
    return Value(heap.make<Map>());
  return fault(fmt::format("there is no type {} to make with {} arguments", type, arguments.size()),
               "IllegalArgumentException");
}

namespace {

bool is_among(std::initializer_list<std::string_view> types, std::string_view type) {
  return std::ranges::find(types, type) != types.end();
}

/// A number, or a text that says one.
Checked<Value> number_of(Value const& value) {
  if (value.is_number()) return value;
  auto const* text = value.as<Text>();
  if (!text) return fault(fmt::format("{} is no number", kind_name(value)), "ClassCastException");
  char* end = nullptr;
  double const parsed = std::strtod(text->text.c_str(), &end);
  if (text->text.empty() || *end != '\0')
    return fault(fmt::format("'{}' is no number", text->text), "NumberFormatException");
  return Value::real(parsed);
}

Checked<Value> integer_of(Value const& value) {
  auto number = number_of(value);
  if (!number || number->is(ValueKind::integer)) return number;
  if (!(std::fabs(number->real()) < 9.2e18))
    return fault(fmt::format("{} is no integer", to_text(*number)), "ArithmeticException");
  return Value::integer(static_cast<std::int64_t>(number->real()));
}

}  // namespace

Checked<Value> cast(Runtime& runtime, Value const& value, std::string_view type) {
  if (type == "boolean" || type == "Boolean") return Value::boolean(is_true(value));
  if (value.is_null()) return value;
  if (type == "String") return Value(runtime.heap.make<Text>(to_text(value)));
  if (type == "List" && value.is(ValueKind::list)) return value;
  if (type == "List" || type == "Set") {
    auto const items = call_method(runtime, value, "toList", {});
    if (items && *items) return type == "Set" ? *call_method(runtime, **items, "unique", {}) : *items;
  }
  if (is_among({"int", "long", "short", "byte", "Integer", "Long", "Short", "Byte", "BigInteger"}, type))
    return integer_of(value);
  if (is_among({"double", "float", "Double", "Float", "BigDecimal"}, type)) {
    auto const number = number_of(value);
    return number ? Value::real(number->number()) : number;
  }
  if (is_instance(value, type)) return value;
  return fault(fmt::format("{} cannot be cast to {}", kind_name(value), type), "ClassCastException");
}

bool is_instance(Value const& value, std::string_view type) {
  if (value.is_null()) return false;
  if (auto const* error = value.as<Error>()) {
    return is_kind_of_error(error->value.type, type);
  }
  auto const own = type_name(value);
  if (type == own || type == "Object" || type == "def") return true;
  if (type == "Number") return value.is_number();
  if (value.is(ValueKind::integer)) return type == "int" || type == "long" || type == "Long";
  if (value.is(ValueKind::real)) return type == "double" || type == "float" || type == "Float" || type == "BigDecimal";
  if (value.is(ValueKind::text)) return type == "CharSequence" || type == "GString";
  if (value.is(ValueKind::list)) return type == "Collection" || type == "ArrayList";
  if (value.is(ValueKind::vehicles)) return type == "VSet" || type == "NodeSet" || type == "Collection";
  if (value.is(ValueKind::boolean)) return type == "boolean";
  return false;
}

}  // namespace lapwing::dolphin
