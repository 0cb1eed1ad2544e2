#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dolphin/equality.hpp"
#include "dolphin/members.hpp"
#include "dolphin/operators.hpp"
#include "dolphin/runtime.hpp"
#include "dolphin/text.hpp"

/// Methods that need no closure, by the kind of their receiver. Those that take closures are in the prelude.
namespace lapwing::dolphin {
namespace {

using MethodResult = std::optional<Checked<Value>>;

constexpr std::int64_t largest_copied_range = 10'000'000;

/// One call: what it is about and what it was given.
struct Call {
  Heap& heap;
  std::string_view name;
  Native::Arguments arguments;

  [[nodiscard]] bool is(std::string_view wanted, std::size_t count) const {
    return name == wanted && arguments.size() == count;
  }
  [[nodiscard]] Value text(std::string value) const { return Value(heap.make<Text>(std::move(value))); }
  [[nodiscard]] std::string text_argument(std::size_t index = 0) const { return to_text(arguments[index]); }
};

Checked<Value> membership(Value const& container, Value const& item) {
  auto const holds = contains(container, item);
  if (!holds) return std::unexpected(holds.error());
  return Value::boolean(*holds);
}

std::string case_changed(std::string text, int (*change)(int)) {
  std::ranges::transform(text, text.begin(), [&](unsigned char c) { return static_cast<char>(change(c)); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string replaced(std::string_view text, std::string const& old, std::string const& fresh) {
  if (old.empty()) return std::string(text);
  std::string result;
  for (std::size_t at = 0;;) {
    auto const next = text.find(old, at);
    result += text.substr(at, next - at);
    if (next == std::string_view::npos) return result;
    result += fresh;
    at = next + old.size();
  }
}

Value split(Call const& call, std::string_view text, std::string const& by) {
  auto parts = call.heap.make<List>();
  for (std::size_t at = 0;;) {
    auto const next = by.empty() ? std::string_view::npos : text.find(by, at);
    parts->push(call.text(std::string(text.substr(at, next == std::string_view::npos ? next : next - at))));
    if (next == std::string_view::npos) return Value(parts);
    at = next + by.size();
  }
}

Checked<Value> substring(Call const& call, std::string const& text) {
  auto const size = static_cast<std::int64_t>(text.size());
  bool const are_integers =
      std::ranges::all_of(call.arguments, [](Value const& v) { return v.is(ValueKind::integer); });
  if (!are_integers) return fault("substring takes integers", "IllegalArgumentException");
  auto const begin = call.arguments[0].integer();
  auto const end = call.arguments.size() > 1 ? call.arguments[1].integer() : size;
  if (begin < 0 || end > size || begin > end) {
    return fault(fmt::format("substring {}..<{} of a text of {}", begin, end, size), "IndexOutOfBoundsException");
  }
  return call.text(text.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
}

MethodResult text_method(Call const& call, std::string const& text) {
  if (call.is("length", 0) || call.is("size", 0)) return Value::integer(static_cast<std::int64_t>(text.size()));
  if (call.is("isEmpty", 0)) return Value::boolean(text.empty());
  if (call.is("toUpperCase", 0)) return call.text(case_changed(text, std::toupper));
  if (call.is("toLowerCase", 0)) return call.text(case_changed(text, std::tolower));
  if (call.is("trim", 0)) return call.text(std::string(trimmed(text)));
  if (call.is("contains", 1)) return Value::boolean(text.find(call.text_argument()) != std::string::npos);
  if (call.is("startsWith", 1)) return Value::boolean(text.starts_with(call.text_argument()));
  if (call.is("endsWith", 1)) return Value::boolean(text.ends_with(call.text_argument()));
  if (call.is("indexOf", 1)) {
    auto const at = text.find(call.text_argument());
    return Value::integer(at == std::string::npos ? -1 : static_cast<std::int64_t>(at));
  }
  if (call.is("replace", 2)) return call.text(replaced(text, call.text_argument(0), call.text_argument(1)));
  if (call.is("split", 1) || call.is("tokenize", 1)) return split(call, text, call.text_argument());
  if (call.is("substring", 1) || call.is("substring", 2)) return substring(call, text);
  if (call.is("toInteger", 0) || call.is("toLong", 0) || call.is("toDouble", 0) || call.is("isNumber", 0)) {
    char* end = nullptr;
    auto const number = std::string(trimmed(text));
    double const parsed = std::strtod(number.c_str(), &end);
    bool const is_number = !number.empty() && *end == '\0';
    if (call.name == "isNumber") return Value::boolean(is_number);
    if (!is_number) return fault(fmt::format("'{}' is no number", text), "NumberFormatException");
    if (call.name == "toDouble") return Value::real(parsed);
    if (parsed != std::floor(parsed) || std::fabs(parsed) > 9e18) {
      return fault(fmt::format("'{}' is no integer", text), "NumberFormatException");
    }
    return Value::integer(static_cast<std::int64_t>(parsed));
  }
  if (call.is("reverse", 0)) return call.text(std::string(text.rbegin(), text.rend()));
  return std::nullopt;
}

Value joined(Call const& call, auto const& items) {
  std::string const between = call.arguments.empty() ? "" : call.text_argument();
  std::string text;
  bool is_first = true;
  for (auto const& item : items) {
    if (!is_first) text += between;
    is_first = false;
    text += to_text(item);
  }
  return call.text(std::move(text));
}

std::vector<Value> unique(std::vector<Value> const& items) {
  std::vector<Value> result;
  for (auto const& item : items) {
    if (std::ranges::none_of(result, [&](Value const& kept) { return equal(kept, item); })) result.push_back(item);
  }
  return result;
}

MethodResult changing_list_method(Call const& call, List& list) {
  auto& items = list.items;
  if (call.is("add", 1) || call.is("leftShift", 1) || call.is("push", 1)) {
    list.push(call.arguments[0]);
    return Value::boolean(true);
  }
  if (call.is("with", 1)) {
    list.push(call.arguments[0]);
    return Value(&list);
  }
  if (call.is("addAll", 1) && call.arguments[0].is(ValueKind::list)) {
    auto const more = call.arguments[0].as<List>()->items;
    for (auto const& item : more) list.push(item);
    return Value::boolean(!more.empty());
  }
  if (call.is("clear", 0)) {
    auto const gone = std::exchange(items, {});
    return Value();
  }
  if ((call.is("pop", 0) || call.is("removeLast", 0)) && !items.empty()) {
    Value last = items.back();
    items.pop_back();
    return last;
  }
  if ((call.is("remove", 1) || call.is("removeAt", 1)) && call.arguments[0].is(ValueKind::integer)) {
    auto const at = call.arguments[0].integer();
    if (at < 0 || at >= static_cast<std::int64_t>(items.size())) {
      return fault(fmt::format("the list has no element {}", at), "IndexOutOfBoundsException");
    }
    Value gone = items[static_cast<std::size_t>(at)];
    items.erase(items.begin() + at);
    return gone;
  }
  return std::nullopt;
}

MethodResult list_method(Call const& call, List& list) {
  auto const& items = list.items;
  auto& heap = call.heap;
  if (call.is("size", 0)) return Value::integer(static_cast<std::int64_t>(items.size()));
  if (call.is("isEmpty", 0)) return Value::boolean(items.empty());
  if (call.is("contains", 1)) return membership(Value(&list), call.arguments[0]);
  if (call.name == "join" && call.arguments.size() <= 1) return joined(call, items);
  if (call.is("first", 0) || call.is("last", 0)) {
    if (items.empty()) return fault("the list is empty", "IndexOutOfBoundsException");
    return call.name == "first" ? items.front() : items.back();
  }
  if (call.is("get", 1)) return element(heap, Value(&list), call.arguments[0], {});
  if (call.is("indexOf", 1)) {
    auto const at = std::ranges::find_if(items, [&](Value const& item) { return equal(item, call.arguments[0]); });
    return Value::integer(at == items.end() ? -1 : at - items.begin());
  }
  if (call.is("reverse", 0)) return Value(heap.make<List>(std::vector<Value>(items.rbegin(), items.rend())));
  if (call.is("toList", 0)) return Value(heap.make<List>(items));
  if (call.is("unique", 0)) return Value(heap.make<List>(unique(items)));
  if (call.is("emptyLike", 0)) return Value(heap.make<List>());
  return changing_list_method(call, list);
}

MethodResult map_method(Call const& call, Map& map) {
  auto& heap = call.heap;
  if (call.is("size", 0)) return Value::integer(static_cast<std::int64_t>(map.size()));
  if (call.is("isEmpty", 0)) return Value::boolean(map.size() == 0);
  if (call.is("containsKey", 1)) return Value::boolean(map.contains(call.arguments[0]));
  if (call.is("get", 1)) return map.at(call.arguments[0]);
  if (call.is("get", 2)) return map.contains(call.arguments[0]) ? map.at(call.arguments[0]) : call.arguments[1];
  if (call.is("put", 2)) {
    Value old = map.at(call.arguments[0]);
    map.set(call.arguments[0], call.arguments[1]);
    return old;
  }
  if (call.is("putAll", 1) && call.arguments[0].is(ValueKind::map) && call.arguments[0].as<Map>() != &map) {
    for (auto const& [key, value] : call.arguments[0].as<Map>()->items()) map.set(key, value);
    return Value();
  }
  if (call.is("remove", 1)) {
    Value old = map.at(call.arguments[0]);
    map.erase(call.arguments[0]);
    return old;
  }
  if (call.is("clear", 0)) {
    map.clear();
    return Value();
  }
  if (call.is("keySet", 0) || call.is("values", 0) || call.is("entrySet", 0) || call.is("toList", 0)) {
    auto list = heap.make<List>();
    for (auto const& [key, value] : map.items()) {
      if (call.name == "keySet") list->push(key);
      if (call.name == "values") list->push(value);
      if (call.name == "entrySet" || call.name == "toList") list->push(heap.make<Entry>(key, value));
    }
    return Value(list);
  }
  if (call.is("emptyLike", 0)) return Value(heap.make<Map>());
  if (call.is("with", 1) && call.arguments[0].is(ValueKind::entry)) {
    map.set(call.arguments[0].as<Entry>()->key, call.arguments[0].as<Entry>()->value);
    return Value(&map);
  }
  return std::nullopt;
}

MethodResult range_method(Call const& call, Range& range) {
  auto& heap = call.heap;
  if (call.is("size", 0)) return Value::integer(range.size);
  if (call.is("isEmpty", 0)) return Value::boolean(range.size == 0);
  if (call.is("contains", 1)) return membership(Value(&range), call.arguments[0]);
  if (call.is("emptyLike", 0)) return Value(heap.make<List>());
  if (call.is("toList", 0) || call.is("join", 0) || call.is("join", 1) || call.is("reverse", 0)) {
    if (range.size > largest_copied_range) return fault("the range is too long to be made a list", "OutOfMemoryError");
    auto list = heap.make<List>();
    for (std::int64_t i = 0; i < range.size; ++i) list->push(Value::integer(range.at(i)));
    if (call.name == "toList") return Value(list);
    return list_method(call, *list);
  }
  return std::nullopt;
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
  for (auto const* word : {"size", "isEmpty", "join", "first", "last", "get", "toList", "indexOf", "reverse"}) {
    if (call.name == word) return list_method(call, *members);
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

MethodResult number_method(Call const& call, Value const& number) {
  if (call.is("intdiv", 1) && number.is(ValueKind::integer) && call.arguments[0].is(ValueKind::integer)) {
    auto const divisor = call.arguments[0].integer();
    if (divisor == 0) return fault("division by zero", "ArithmeticException");
    if (divisor == -1) return negate(number);
    return Value::integer(number.integer() / divisor);
  }
  if (call.is("abs", 0)) {
    if (number.is(ValueKind::real)) return Value::real(std::fabs(number.real()));
    return number.integer() < 0 ? negate(number) : Checked<Value>(number);
  }
  if (call.is("toInteger", 0) || call.is("intValue", 0) || call.is("longValue", 0)) {
    if (number.is(ValueKind::integer)) return number;
    if (!(std::fabs(number.real()) < 9.2e18)) return fault(to_text(number) + " is no integer", "ArithmeticException");
    return Value::integer(static_cast<std::int64_t>(number.real()));
  }
  if (call.is("toDouble", 0) || call.is("doubleValue", 0)) return Value::real(number.number());
  if (call.is("isNaN", 0)) return Value::boolean(number.is(ValueKind::real) && std::isnan(number.real()));
  if (call.is("round", 0)) return Value::integer(std::llround(number.number()));
  return std::nullopt;
}

MethodResult common_method(Call const& call, Value const& object) {
  if (call.is("toString", 0)) return call.text(to_text(object));
  if (call.is("equals", 1)) return Value::boolean(equal(object, call.arguments[0]));
  if (call.is("compareTo", 1)) {
    auto const order = compare(object, call.arguments[0]);
    if (!order) return std::unexpected(order.error());
    return Value::integer(*order < 0 ? -1 : *order > 0 ? 1 : 0);
  }
  return std::nullopt;
}

MethodResult kind_method(Call const& call, Value const& object) {
  switch (object.kind()) {
    case ValueKind::integer:
    case ValueKind::real: return number_method(call, object);
    case ValueKind::text: return text_method(call, object.as<Text>()->text);
    case ValueKind::list: return list_method(call, *object.as<List>());
    case ValueKind::map: return map_method(call, *object.as<Map>());
    case ValueKind::range: return range_method(call, *object.as<Range>());
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
                                          Native::Arguments arguments) {
  Call const call{runtime.heap, name, arguments};
  if (auto result = kind_method(call, object)) return result;
  if (auto result = common_method(call, object)) return result;
  if (is_getter(name) && arguments.empty()) {
    std::string property(name.substr(3));
    property[0] = static_cast<char>(std::tolower(property[0]));
    return member(runtime, object, property);
  }
  return std::nullopt;
}

}  // namespace lapwing::dolphin
