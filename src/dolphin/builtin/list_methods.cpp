#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>

#include "dolphin/builtin/method_lists.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/membership.hpp"
#include "dolphin/value/operators.hpp"

/// Methods of lists, maps and ranges.
namespace lapwing::dolphin::internal {
namespace {

Checked<Value> membership(Value const& container, Value const& item) {
  auto const holds = contains(container, item);
  if (!holds) return std::unexpected(holds.error());
  return Value::boolean(*holds);
}

Checked<Value> joined(MethodCall const& call, auto const& items) {
  std::string const between = call.arguments.empty() ? "" : call.text_argument();
  std::string text;
  bool is_first = true;
  for (auto const& item : items) {
    if (!is_first) text += between;
    is_first = false;
    text += to_text(item);
    if (text.size() > max_text_size) break;
  }
  return call.long_text(std::move(text));
}

/// The items of lists in lists, to any depth. Lists may share parts, and hold themselves: then there are too many.
Checked<Value> flattened(MethodCall const& call, List const& list) {
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

/// Lists of `size` items each, the last one what is left.
Checked<Value> in_groups(MethodCall const& call, std::vector<Value> const& items) {
  auto const size = call.integer_argument();
  if (!size) return std::unexpected(size.error());
  if (*size < 1) return fault("collate takes a size of 1 or more", "IllegalArgumentException");
  std::vector<Value> groups;
  auto const step = std::min(static_cast<std::size_t>(*size), items.size());
  for (std::size_t at = 0; at < items.size(); at += step) {
    auto const count = std::min(step, items.size() - at);
    auto const group = std::span(items).subspan(at, count);
    groups.push_back(call.list({group.begin(), group.end()}));
  }
  return call.list(std::move(groups));
}

Checked<Value> removed_at(MethodCall const& call, std::vector<Value>& items) {
  auto const at = call.integer_argument();
  if (!at) return std::unexpected(at.error());
  if (*at < 0 || *at >= static_cast<std::int64_t>(items.size())) {
    return fault(fmt::format("the list has no element {}", *at), "IndexOutOfBoundsException");
  }
  Value gone = items[static_cast<std::size_t>(*at)];
  items.erase(items.begin() + *at);
  return gone;
}

MethodResult adding_method(MethodCall const& call, List& list) {
  if (call.is("add", 1) || call.is("leftShift", 1) || call.is("push", 1)) {
    list.push(call.arguments[0]);
    return Value::boolean(true);
  }
  if (call.is("with", 1)) {
    list.push(call.arguments[0]);
    return Value(&list);
  }
  if (call.is("add", 2)) {
    auto const at = call.integer_argument();
    if (!at) return std::unexpected(at.error());
    if (*at < 0 || *at > static_cast<std::int64_t>(list.items.size())) {
      return fault(fmt::format("the list has no place {}", *at), "IndexOutOfBoundsException");
    }
    list.push(call.arguments[1]);
    std::rotate(list.items.begin() + *at, list.items.end() - 1, list.items.end());
    return Value();
  }
  if (call.is("addAll", 1) && call.arguments[0].is(ValueKind::list)) {
    auto const more = call.arguments[0].as<List>()->items;
    for (auto const& item : more) list.push(item);
    return Value::boolean(!more.empty());
  }
  // What `sort` of the prelude does to a list.
  if (call.is("become", 1) && call.arguments[0].is(ValueKind::list)) {
    auto fresh = call.arguments[0].as<List>()->items;
    std::swap(list.items, fresh);
    return Value(&list);
  }
  return std::nullopt;
}

MethodResult removing_method(MethodCall const& call, List& list) {
  auto& items = list.items;
  if (call.is("unique", 0)) {
    Membership seen;
    std::vector<Value> kept;
    for (auto const& item : items) {
      if (seen.holds(item)) continue;
      if (seen.gave_up()) return seen.result({});
      seen.add(item);
      kept.push_back(item);
    }
    std::swap(items, kept);
    return Value(&list);
  }
  if (call.is("clear", 0)) {
    auto const gone = list.take_all();
    return Value();
  }
  if (call.is("pop", 0) || call.is("removeLast", 0)) {
    if (items.empty()) return fault("the list is empty", "NoSuchElementException");
    Value last = items.back();
    items.pop_back();
    return last;
  }
  if (call.is("removeAt", 1) || (call.is("remove", 1) && call.arguments[0].is(ValueKind::integer))) {
    return removed_at(call, items);
  }
  if (call.is("remove", 1) || call.is("removeElement", 1)) {
    std::size_t compared = 0;
    auto const found = find(items, call.arguments[0], compared);
    if (!found) return std::unexpected(found.error());
    Value const gone = *found ? items[**found] : Value();  // what it drops may refer to this list
    if (*found) items.erase(items.begin() + static_cast<std::ptrdiff_t>(**found));
    return Value::boolean(found->has_value());
  }
  bool const removes = call.is("removeAll", 1);
  if ((removes || call.is("retainAll", 1)) && call.arguments[0].is(ValueKind::list)) {
    Membership others(call.arguments[0].as<List>()->items);
    auto const before = items;
    std::vector<Value> rest;
    for (auto const& item : before) {
      if (others.holds(item) != removes) rest.push_back(item);
      if (others.gave_up()) return others.result({});
    }
    items = std::move(rest);
    return Value::boolean(items.size() != before.size());
  }
  return std::nullopt;
}

/// Parts of a list, as new lists.
MethodResult list_part(MethodCall const& call, std::vector<Value> const& items) {
  auto const size = static_cast<std::int64_t>(items.size());
  auto const part = [&](std::int64_t begin, std::int64_t end) {
    auto const from = std::clamp<std::int64_t>(begin, 0, size);
    auto const to = std::clamp<std::int64_t>(end, from, size);
    return call.list({items.begin() + from, items.begin() + to});
  };
  if (call.is("tail", 0) || call.is("init", 0)) {
    if (items.empty()) return fault("the list is empty", "NoSuchElementException");
    return call.name == "tail" ? part(1, size) : part(0, size - 1);
  }
  bool const is_part = call.is("take", 1) || call.is("drop", 1) || call.is("takeRight", 1) || call.is("dropRight", 1);
  if (is_part) {
    auto const count = call.integer_argument();
    if (!count) return std::unexpected(count.error());
    auto const n = std::clamp<std::int64_t>(*count, 0, size);
    if (call.name == "take") return part(0, n);
    if (call.name == "drop") return part(n, size);
    return call.name == "takeRight" ? part(size - n, size) : part(0, size - n);
  }
  if (call.is("subList", 2)) {
    auto const begin = call.integer_argument(0);
    auto const end = call.integer_argument(1);
    if (!begin) return std::unexpected(begin.error());
    if (!end) return std::unexpected(end.error());
    if (*begin < 0 || *end > size || *begin > *end) {
      return fault(fmt::format("subList {}..<{} of a list of {}", *begin, *end, size), "IndexOutOfBoundsException");
    }
    return part(*begin, *end);
  }
  if (call.is("collate", 1)) return in_groups(call, items);
  return std::nullopt;
}

/// What two lists make together.
MethodResult list_with_list(MethodCall const& call, std::vector<Value> const& items) {
  if (call.arguments.size() != 1 || !call.arguments[0].is(ValueKind::list)) return std::nullopt;
  auto const& other_items = call.arguments[0].as<List>()->items;
  if (call.name == "containsAll") {
    Membership own(items);
    bool const all = std::ranges::all_of(other_items, [&](Value const& other) { return own.holds(other); });
    return own.result(Value::boolean(all));
  }
  if (call.name != "disjoint" && call.name != "intersect") return std::nullopt;
  Membership others(other_items);
  std::vector<Value> both;
  std::ranges::copy_if(items, std::back_inserter(both), [&](Value const& item) { return others.holds(item); });
  return others.result(call.name == "disjoint" ? Value::boolean(both.empty()) : call.list(std::move(both)));
}

MethodResult list_element(MethodCall const& call, List& list) {
  auto const& items = list.items;
  if (call.is("first", 0) || call.is("last", 0) || call.is("head", 0)) {
    if (items.empty()) return fault("the list is empty", "NoSuchElementException");
    return call.name == "last" ? items.back() : items.front();
  }
  if (call.is("getAt", 1)) return element(call.heap, Value(&list), call.arguments[0], {});
  if (call.is("set", 2) || call.is("putAt", 2)) {
    auto old = element(call.heap, Value(&list), call.arguments[0], {});
    auto const done = set_element(Value(&list), call.arguments[0], call.arguments[1]);
    return done ? old : done;
  }
  if (call.is("get", 1)) {
    auto const at = call.integer_argument();
    if (!at) return std::unexpected(at.error());
    if (*at >= static_cast<std::int64_t>(items.size())) {
      return fault(fmt::format("index {} is outside 0..<{}", *at, items.size()), "IndexOutOfBoundsException");
    }
    return element(call.heap, Value(&list), call.arguments[0], {});
  }
  if (call.is("indexOf", 1)) {
    std::size_t compared = 0;
    auto const at = find(items, call.arguments[0], compared);
    if (!at) return std::unexpected(at.error());
    return Value::integer(*at ? static_cast<std::int64_t>(**at) : -1);
  }
  if (call.is("lastIndexOf", 1)) {
    std::size_t compared = 0;
    std::vector<Value> const reversed(items.rbegin(), items.rend());
    auto const at = find(reversed, call.arguments[0], compared);
    if (!at) return std::unexpected(at.error());
    return Value::integer(*at ? static_cast<std::int64_t>(items.size() - 1 - **at) : -1);
  }
  return std::nullopt;
}

/// As list and back: the value when the method is one of lists that are not changed by it.
constexpr std::string_view unchanging[] = {"toList",    "join",        "reverse",    "first",   "last",    "head",
                                           "tail",      "init",        "take",       "drop",    "get",     "indexOf",
                                           "takeRight", "dropRight",   "subList",    "collate", "flatten", "intersect",
                                           "disjoint",  "containsAll", "lastIndexOf"};

}  // namespace

MethodResult list_method(MethodCall const& call, List& list) {
  auto const& items = list.items;
  if (call.is("size", 0)) return Value::integer(static_cast<std::int64_t>(items.size()));
  if (call.is("isEmpty", 0)) return Value::boolean(items.empty());
  if (call.is("contains", 1)) return membership(Value(&list), call.arguments[0]);
  if (call.name == "join" && call.arguments.size() <= 1) return joined(call, items);
  if (call.is("reverse", 0)) return call.list({items.rbegin(), items.rend()});
  if (call.is("toList", 0)) return call.list(items);
  if (call.is("flatten", 0)) return flattened(call, list);
  if (call.is("emptyLike", 0)) return call.list({});
  if (auto result = list_element(call, list)) return result;
  if (auto result = list_part(call, items)) return result;
  if (auto result = list_with_list(call, items)) return result;
  if (auto result = adding_method(call, list)) return result;
  return removing_method(call, list);
}

MethodResult map_method(MethodCall const& call, Map& map) {
  auto& heap = call.heap;
  if (call.is("size", 0)) return Value::integer(static_cast<std::int64_t>(map.size()));
  if (call.is("isEmpty", 0)) return Value::boolean(map.size() == 0);
  if (call.is("containsKey", 1)) return Value::boolean(map.contains(call.arguments[0]));
  if (call.is("containsValue", 1)) {
    return Value::boolean(
        std::ranges::any_of(map.items(), [&](auto const& item) { return equal(item.second, call.arguments[0]); }));
  }
  if (call.is("get", 1)) return map.at(call.arguments[0]);
  if (call.is("get", 2) || call.is("getOrDefault", 2)) {
    return map.contains(call.arguments[0]) ? map.at(call.arguments[0]) : call.arguments[1];
  }
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
  if (call.is("getAt", 1)) return map.at(call.arguments[0]);
  if (call.is("with", 1) && call.arguments[0].is(ValueKind::entry)) {
    map.set(call.arguments[0].as<Entry>()->key, call.arguments[0].as<Entry>()->value);
    return Value(&map);
  }
  return std::nullopt;
}

MethodResult range_method(MethodCall const& call, Range& range) {
  if (call.is("size", 0)) return Value::integer(range.size);
  if (call.is("isEmpty", 0)) return Value::boolean(range.size == 0);
  if (call.is("contains", 1)) return membership(Value(&range), call.arguments[0]);
  if (call.is("emptyLike", 0)) return call.list({});
  if (std::ranges::find(unchanging, call.name) == std::end(unchanging)) return std::nullopt;
  if (range.size > max_copied_range) return fault("the range is too long to be made a list", "OutOfMemoryError");
  std::vector<Value> items;
  items.reserve(static_cast<std::size_t>(range.size));
  for (std::int64_t i = 0; i < range.size; ++i) items.push_back(Value::integer(range.at(i)));
  auto const list = call.heap.make<List>(std::move(items));
  return list_method(call, *list);
}

}  // namespace lapwing::dolphin::internal
