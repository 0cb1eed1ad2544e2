#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/membership.hpp"
#include "dolphin/value/operators.hpp"

/// Methods of lists and maps, and those that ranges and sets of vehicles share with lists.
namespace lapwing::dolphin::internal {

namespace {

Checked<Value> values_of(Call call, Range const& range) {
  if (range.size > max_copied_range) return fault("the range is too long to be made a list", "OutOfMemoryError");
  std::vector<Value> items;
  items.reserve(static_cast<std::size_t>(range.size));
  for (std::int64_t i = 0; i < range.size; ++i) items.push_back(Value::integer(range.at(i)));
  return call.list(std::move(items));
}

Value vehicles_of(Call call, Vehicles const& set) {
  std::vector<Value> items;
  for (auto const& id : set.ids) items.push_back(call.heap.make<Vehicle>(id));
  return call.list(std::move(items));
}

Value set_of(Call call, List const& vehicles) {
  std::vector<vehicle::VehicleId> ids;
  for (auto const& item : vehicles.items) ids.push_back(item.as<Vehicle>()->value);
  return Value(call.heap.make<Vehicles>(std::move(ids)));
}

}  // namespace

MethodResult shared_method(Call call, Value const& object, Shared with, MethodFunction function) {
  if (auto const* range = object.as<Range>()) {
    auto const list = values_of(call, *range);
    return list ? function(call, *list) : list;
  }
  auto const* set = object.as<Vehicles>();
  if (!set) return function(call, object);
  if (with == Shared::with_ranges) return std::nullopt;
  auto result = function(call, vehicles_of(call, *set));
  bool const is_part = with == Shared::as_parts && result && *result;
  return is_part ? set_of(call, *(*result)->as<List>()) : std::move(result);
}

namespace {

std::unexpected<Fault> is_empty() {
  return fault("the list is empty", "NoSuchElementException");
}

// ---- elements

Checked<Value> first(Call /*call*/, List const& list) {
  if (list.items.empty()) return is_empty();
  return list.items.front();
}

Checked<Value> last(Call /*call*/, List const& list) {
  if (list.items.empty()) return is_empty();
  return list.items.back();
}

Checked<Value> get_at(Call call, List& list) {
  return element(call.heap, Value(&list), call.arguments[0], {});
}

Checked<Value> get(Call call, List& list) {
  auto const at = call.integer_argument();
  if (!at) return std::unexpected(at.error());
  if (*at >= static_cast<std::int64_t>(list.items.size()))
    return fault(fmt::format("index {} is outside 0..<{}", *at, list.items.size()), "IndexOutOfBoundsException");
  return get_at(call, list);
}

Checked<Value> set(Call call, List& list) {
  auto old = get_at(call, list);
  auto const done = set_element(Value(&list), call.arguments[0], call.arguments[1]);
  return done ? old : done;
}

Checked<Value> index_of(Call call, List const& list) {
  std::size_t compared = 0;
  auto const at = find(list.items, call.arguments[0], compared);
  if (!at) return std::unexpected(at.error());
  return Value::integer(*at ? static_cast<std::int64_t>(**at) : -1);
}

Checked<Value> last_index_of(Call call, List const& list) {
  std::size_t compared = 0;
  std::vector<Value> const reversed(list.items.rbegin(), list.items.rend());
  auto const at = find(reversed, call.arguments[0], compared);
  if (!at) return std::unexpected(at.error());
  return Value::integer(*at ? static_cast<std::int64_t>(list.items.size() - 1 - **at) : -1);
}

// ---- parts

Value between(Call call, List const& list, std::size_t begin, std::size_t end) {
  auto const items = std::span(list.items).subspan(begin, end - begin);
  return call.list({items.begin(), items.end()});
}

enum class Kept { first, all_but_first, last, all_but_last };

/// `take` and its kin.
template <Kept kept>
Checked<Value> cut(Call call, List const& list) {
  auto const count = call.integer_argument();
  if (!count) return std::unexpected(count.error());
  auto const size = list.items.size();
  auto const n = static_cast<std::size_t>(std::clamp<std::int64_t>(*count, 0, static_cast<std::int64_t>(size)));
  switch (kept) {
    case Kept::first: return between(call, list, 0, n);
    case Kept::all_but_first: return between(call, list, n, size);
    case Kept::last: return between(call, list, size - n, size);
    case Kept::all_but_last: return between(call, list, 0, size - n);
  }
  return Value();
}

Checked<Value> tail(Call call, List const& list) {
  if (list.items.empty()) return is_empty();
  return between(call, list, 1, list.items.size());
}

Checked<Value> init(Call call, List const& list) {
  if (list.items.empty()) return is_empty();
  return between(call, list, 0, list.items.size() - 1);
}

Checked<Value> sub_list(Call call, List const& list) {
  auto const begin = call.integer_argument(0);
  auto const end = call.integer_argument(1);
  if (!begin) return std::unexpected(begin.error());
  if (!end) return std::unexpected(end.error());
  auto const size = static_cast<std::int64_t>(list.items.size());
  if (*begin < 0 || *end > size || *begin > *end)
    return fault(fmt::format("subList {}..<{} of a list of {}", *begin, *end, size), "IndexOutOfBoundsException");
  return between(call, list, static_cast<std::size_t>(*begin), static_cast<std::size_t>(*end));
}

/// Lists of so many items each, the last one what is left.
Checked<Value> in_groups(Call call, List const& list) {
  auto const size = call.integer_argument();
  if (!size) return std::unexpected(size.error());
  if (*size < 1) return fault("collate takes a size of 1 or more", "IllegalArgumentException");
  std::vector<Value> groups;
  auto const step = std::min(static_cast<std::size_t>(*size), list.items.size());
  for (std::size_t at = 0; at < list.items.size(); at += step)
    groups.push_back(between(call, list, at, std::min(at + step, list.items.size())));
  return call.list(std::move(groups));
}

/// The items of lists in lists, to any depth. Lists may share parts, and hold themselves: then there are too many.
Checked<Value> flattened(Call call, List const& list) {
  struct Place {
    List const* list;
    std::size_t next = 0;
  };
  std::vector<Value> flat;
  std::vector<Place> open{{&list}};
  std::size_t looked_at = 0;
  while (!open.empty()) {
    auto& place = open.back();
    if (place.next == place.list->items.size()) {
      open.pop_back();
      continue;
    }
    if (++looked_at > max_spread_values) return fault("the lists are too long to flatten", "OutOfMemoryError");
    auto const& item = place.list->items[place.next++];
    if (auto const* inner = item.as<List>()) {
      open.push_back({inner});
    } else {
      flat.push_back(item);
    }
  }
  return call.list(std::move(flat));
}

Value reversed(Call call, List const& list) {
  return call.list({list.items.rbegin(), list.items.rend()});
}

// ---- with another list

List const* other_list(Call call) {
  return call.arguments[0].as<List>();
}

MethodResult contains_all(Call call, List const& list) {
  auto const* others = other_list(call);
  if (!others) return std::nullopt;
  Membership own(list.items);
  bool const all = std::ranges::all_of(others->items, [&](Value const& other) { return own.holds(other); });
  return own.result(Value::boolean(all));
}

template <bool asks_for_none>
MethodResult in_both(Call call, List const& list) {
  auto const* others = other_list(call);
  if (!others) return std::nullopt;
  Membership theirs(others->items);
  std::vector<Value> both;
  std::ranges::copy_if(list.items, std::back_inserter(both), [&](Value const& item) { return theirs.holds(item); });
  return theirs.result(asks_for_none ? Value::boolean(both.empty()) : call.list(std::move(both)));
}

template <bool removes>
MethodResult filtered(Call call, List& list) {
  auto const* others = other_list(call);
  if (!others) return std::nullopt;
  Membership theirs(others->items);
  auto const before = list.items;
  std::vector<Value> rest;
  for (auto const& item : before) {
    if (theirs.holds(item) != removes) rest.push_back(item);
    if (theirs.gave_up()) return theirs.result({});
  }
  list.items = std::move(rest);
  return Value::boolean(list.items.size() != before.size());
}

// ---- changes

Value append(Call call, List& list) {
  list.push(call.arguments[0]);
  return Value::boolean(true);
}

Checked<Value> add(Call call, List& list) {
  if (call.arguments.size() == 1) return append(call, list);
  auto const at = call.integer_argument();
  if (!at) return std::unexpected(at.error());
  if (*at < 0 || *at > static_cast<std::int64_t>(list.items.size()))
    return fault(fmt::format("the list has no place {}", *at), "IndexOutOfBoundsException");
  list.push(call.arguments[1]);
  std::rotate(list.items.begin() + *at, list.items.end() - 1, list.items.end());
  return Value();
}

MethodResult add_all(Call call, List& list) {
  auto const* others = other_list(call);
  if (!others) return std::nullopt;
  auto const more = others->items;
  for (auto const& item : more) list.push(item);
  return Value::boolean(!more.empty());
}

Checked<Value> pop(Call /*call*/, List& list) {
  if (list.items.empty()) return is_empty();
  Value last_one = list.items.back();
  list.items.pop_back();
  return last_one;
}

Checked<Value> remove_at(Call call, List& list) {
  auto const at = call.integer_argument();
  if (!at) return std::unexpected(at.error());
  if (*at < 0 || *at >= static_cast<std::int64_t>(list.items.size()))
    return fault(fmt::format("the list has no element {}", *at), "IndexOutOfBoundsException");
  Value gone = list.items[static_cast<std::size_t>(*at)];
  list.items.erase(list.items.begin() + *at);
  return gone;
}

Checked<Value> remove_element(Call call, List& list) {
  std::size_t compared = 0;
  auto const found = find(list.items, call.arguments[0], compared);
  if (!found) return std::unexpected(found.error());
  Value const gone = *found ? list.items[**found] : Value();  // what it drops may refer to this list
  if (*found) list.items.erase(list.items.begin() + static_cast<std::ptrdiff_t>(**found));
  return Value::boolean(found->has_value());
}

Checked<Value> remove(Call call, List& list) {
  return call.arguments[0].is(ValueKind::integer) ? remove_at(call, list) : remove_element(call, list);
}

Value clear(Call /*call*/, List& list) {
  auto const gone = list.take_all();
  return {};
}

Checked<Value> without_repeats(Call /*call*/, List& list) {
  Membership seen;
  std::vector<Value> kept;
  for (auto const& item : list.items) {
    if (seen.holds(item)) continue;
    if (seen.gave_up()) return seen.result({});
    seen.add(item);
    kept.push_back(item);
  }
  std::swap(list.items, kept);
  return Value(&list);
}

// ---- maps

Value get_of(Call call, Map const& map) {
  bool const has_other = call.arguments.size() > 1 && !map.contains(call.arguments[0]);
  return has_other ? call.arguments[1] : map.at(call.arguments[0]);
}

Value put(Call call, Map& map) {
  Value old = map.at(call.arguments[0]);
  map.set(call.arguments[0], call.arguments[1]);
  return old;
}

MethodResult put_all(Call call, Map& map) {
  auto const* others = call.arguments[0].as<Map>();
  if (!others || others == &map) return std::nullopt;
  for (auto const& [key, value] : others->items()) map.set(key, value);
  return Value();
}

Value remove_from(Call call, Map& map) {
  Value old = map.at(call.arguments[0]);
  map.erase(call.arguments[0]);
  return old;
}

Value clear_map(Call /*call*/, Map& map) {
  map.clear();
  return {};
}

Value contains_value(Call call, Map const& map) {
  return Value::boolean(
      std::ranges::any_of(map.items(), [&](auto const& item) { return equal(item.second, call.arguments[0]); }));
}

enum class Listed { keys, values, entries };

template <Listed what>
Value listed_map(Call call, Map const& map) {
  auto list = call.heap.make<List>();
  for (auto const& [key, value] : map.items()) {
    if constexpr (what == Listed::keys) list->push(key);
    if constexpr (what == Listed::values) list->push(value);
    if constexpr (what == Listed::entries) list->push(call.heap.make<Entry>(key, value));
  }
  return Value(list);
}

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    pure({ordered, "first", "", any, "The first.", "[1, 2].first()", in_order<first>}),
    pure({ordered, "last", "", any, "The last.", "[1, 2].last()", in_order<last>}),
    pure({ordered, "indexOf", "value", Kind::integer, "Where the value is, or -1.", "['a', 'b'].indexOf('b')",
          in_order<index_of>}),
    {ranged, "lastIndexOf", "value", Kind::integer, "Where the value is last, or -1.", "[1, 2, 1].lastIndexOf(1)",
     listed<last_index_of>},
    pure({parts, "take", "n", any, "The first so many.", "[1, 2, 3].take(2)", of<part<cut<Kept::first>>, take_text>}),
    pure({parts, "drop", "n", any, "All but the first so many.", "[1, 2, 3].drop(2)",
          of<part<cut<Kept::all_but_first>>, drop_text>}),
    {ranged, "takeRight", "n", Kind::list, "The last so many.", "[1, 2, 3].takeRight(2)", listed<cut<Kept::last>>},
    {ranged, "dropRight", "n", Kind::list, "All but the last so many.", "[1, 2, 3].dropRight(2)",
     listed<cut<Kept::all_but_last>>},
    {ranged, "head", "", any, "The first.", "[1, 2].head()", listed<first>},
    {ordered, "tail", "", any, "All but the first.", "[1, 2, 3].tail()", part<tail>},
    {ordered, "init", "", any, "All but the last.", "[1, 2, 3].init()", part<init>},
    {ranged, "subList", "from, to", Kind::list, "From one index to before another.", "[1, 2, 3].subList(1, 3)",
     listed<sub_list>},
    {ranged, "collate", "n", Kind::list, "Lists of so many each.", "[1, 2, 3].collate(2)", listed<in_groups>},
    {ranged, "flatten", "", Kind::list, "With the items of its lists in their place.", "[1, [2, [3]]].flatten()",
     listed<flattened>},
    {ranged, "intersect", "list", Kind::list, "Those that are in the other list too.", "[1, 2].intersect([2, 3])",
     listed<in_both<false>>},
    {ranged, "disjoint", "list", Kind::boolean, "Whether none is in the other list.", "[1, 2].disjoint([2, 3])",
     listed<in_both<true>>},
    {ranged, "containsAll", "list", Kind::boolean, "Whether all of the other list are in it.",
     "[1, 2].containsAll([2])", listed<contains_all>},
    {lists, "add", "index?, value", Kind::boolean, "Appends the value.", "", of<add>},
    {lists, "leftShift", "value", Kind::boolean, "Appends the value, as << does.", "", of<append>},
    {lists, "push", "value", Kind::boolean, "Appends the value.", "", of<append>},
    {lists, "addAll", "list", Kind::boolean, "Appends all of the other list.", "", of<add_all>},
    {lists, "pop", "", any, "Takes the last one out.", "[1, 2].pop()", of<pop>},
    {lists, "removeLast", "", any, "Takes the last one out.", "", of<pop>},
    {lists, "removeAt", "index", any, "Takes the element out.", "[5, 6].removeAt(0)", of<remove_at>},
    {lists, "removeElement", "value", Kind::boolean, "Takes the first that equals the value out.",
     "[5, 6].removeElement(6)", of<remove_element>},
    {lists, "removeAll", "list", Kind::boolean, "Takes out what is in the other list.", "", of<filtered<true>>},
    {lists, "retainAll", "list", Kind::boolean, "Takes out what is not in the other list.", "", of<filtered<false>>},
    {parts, "reverse", "", any, "In reverse order.", "[1, 2].reverse()", of<part<reversed>, reversed_text>},
    {lists, "unique", "", Kind::list, "Takes out what is in it already.", "[1, 2, 1].unique()", of<without_repeats>},
    pure({ordered, "get", "index", any, "The element.", "[5, 6].get(1)", in_order<get>}),
    pure({Kind::map, "get", "key, value?", any, "The element, or null or the other value when there is none.",
          "[a: 1].get('a')", of<get_of>}),
    {lists | Kind::map, "getAt", "index or key", any, "The element, as [ ] gives it.", "[5, 6].getAt(1)",
     of<get_at, get_of>},
    {lists, "set", "index, value", any, "Puts the value in the place of an element.", "", of<set>},
    {lists, "putAt", "index, value", any, "The same as `set`.", "", of<set>},
    {lists | Kind::map, "remove", "index or key", any, "Takes an element out.", "", of<remove, remove_from>},
    {lists | Kind::map, "clear", "", any, "Takes everything out.", "", of<clear, clear_map>},
    {Kind::map, "put", "key, value", any, "Sets a value.", "", of<put>},
    {Kind::map, "putAll", "map", any, "Sets the values of the other map.", "", of<put_all>},
    {Kind::map, "getOrDefault", "key, value", any, "The element, or the other value when there is none.",
     "[a: 1].getOrDefault('b', 0)", of<get_of>},
    {Kind::map, "containsKey", "key", Kind::boolean, "Whether there is that key.", "[a: 1].containsKey('a')",
     of<[](Call call, Map const& map) { return Value::boolean(map.contains(call.arguments[0])); }>},
    {Kind::map, "containsValue", "value", Kind::boolean, "Whether there is that value.", "[a: 1].containsValue(2)",
     of<contains_value>},
    pure({Kind::map, "keySet", "", Kind::list, "The keys.", "[a: 1, b: 2].keySet()", of<listed_map<Listed::keys>>}),
    pure({Kind::map, "values", "", Kind::list, "The values.", "[a: 1, b: 2].values()", of<listed_map<Listed::values>>}),
    {Kind::map, "entrySet", "", Kind::list, "The entries, each with a key and a value.", "[a: 1].entrySet()",
     of<listed_map<Listed::entries>>},
    {walked, "toList", "", Kind::list, "As a list.", "(1..3).toList()",
     of<in_order<[](Call call, List const& list) { return call.list(list.items); }>, listed_map<Listed::entries>,
        letters>},
    {joined, "plus", "n", any, "The same as +.", "", of<by_operator<ast::BinaryOp::add>>},
    {joined, "minus", "n", any, "The same as -.", "", of<by_operator<ast::BinaryOp::subtract>>},
    {Kind::list | number | Kind::text, "multiply", "n", any, "The same as *.", "",
     of<by_operator<ast::BinaryOp::multiply>>},
});

}  // namespace

std::span<MethodSpec const> list_methods() {
  return table;
}

}  // namespace lapwing::dolphin::internal
