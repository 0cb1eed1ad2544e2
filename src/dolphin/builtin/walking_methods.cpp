#include <array>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/code/bytecode.hpp"
#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/operators.hpp"

/// Methods of everything that `for (x in items)` walks through: lists, maps, ranges, sets of vehicles and texts. Those
/// that take closures are written in the language, so that these may wait, loop and fail as any other code.
namespace lapwing::dolphin::internal {
namespace {

std::size_t size_of(Text const& text) {
  return count_code_points(text.text);
}
std::size_t size_of(List const& list) {
  return list.items.size();
}
std::size_t size_of(Map const& map) {
  return map.size();
}
std::size_t size_of(Range const& range) {
  return static_cast<std::size_t>(range.size);
}
std::size_t size_of(Vehicles const& set) {
  return set.ids.size();
}

template <class T>
Value size(Call /*call*/, T& items) {
  return Value::integer(static_cast<std::int64_t>(size_of(items)));
}

template <class T>
Value is_empty(Call /*call*/, T& items) {
  return Value::boolean(size_of(items) == 0);
}

Checked<Value> join(Call call, List const& list) {
  std::string const between = call.arguments.empty() ? "" : call.text_argument();
  std::string text;
  bool is_first = true;
  for (auto const& item : list.items) {
    if (!is_first) text += between;
    is_first = false;
    text += to_text(item);
    if (text.size() > max_text_size) break;
  }
  return call.long_text(std::move(text));
}

// ---- what functions of the prelude call

/// What `findAll` and others gather in: of the kind that they walk through.
Value no_items(Call call, Value const& items) {
  switch (items.kind()) {
    case ValueKind::map: return Value(call.heap.make<Map>());
    case ValueKind::vehicles: return Value(call.heap.make<Vehicles>(std::vector<vehicle::VehicleId>{}));
    default: return call.list({});
  }
}

Value list_with(Call call, List& list) {
  list.push(call.arguments[0]);
  return Value(&list);
}

MethodResult map_with(Call call, Map& map) {
  auto const* entry = call.arguments[0].as<Entry>();
  if (!entry) return std::nullopt;
  map.set(entry->key, entry->value);
  return Value(&map);
}

MethodResult set_with(Call call, Vehicles const& set) {
  auto const* one = call.arguments[0].as<Vehicle>();
  if (!one) return std::nullopt;
  auto ids = set.ids;
  ids.push_back(one->value);
  return Value(call.heap.make<Vehicles>(std::move(ids)));
}

/// What `sort` does to a list.
MethodResult become(Call call, List& list) {
  auto const* other = call.arguments[0].as<List>();
  if (!other) return std::nullopt;
  auto fresh = other->items;
  std::swap(list.items, fresh);
  return Value(&list);
}

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    pure({walked, "size", "", Kind::integer, "How many.", "[3, 1].size()",
          of<size<List>, size<Map>, size<Range>, size<Vehicles>, size<Text>>}),
    pure({walked, "isEmpty", "", Kind::boolean, "Whether there is nothing in it.", "[].isEmpty()",
          of<is_empty<List>, is_empty<Map>, is_empty<Range>, is_empty<Vehicles>,
             [](Call, Text const& text) { return Value::boolean(text.text.empty()); }>}),
    pure({parts, "contains", "value", Kind::boolean,
          "Whether the value is in it; a text has parts that fit a pattern, too.", "'harbour'.contains('bo')",
          of<contains_text, holds<List>, holds<Range>, holds<Vehicles>>}),
    written({walked, "each", "closure", any, "Calls the closure with each.", ""}, R"(def each(items, f) {
  for (x in items) { f(x) }
  return items
})"),
    written({walked, "eachWithIndex", "closure", any, "Calls the closure with each and its index.", ""},
            R"(def eachWithIndex(items, f) {
  def i = 0
  def splits = items instanceof Map && parameters(f) > 2
  for (x in items) { if (splits) { f(x.key, x.value, i++) } else { f(x, i++) } }
  return items
})"),
    written({walked, "collect", "closure", Kind::list, "What the closure makes of each.", "[1, 2].collect { it * 10 }"},
            R"(def collect(items, f) {
  def result = []
  for (x in items) { result << f(x) }
  return result
})"),
    written({walked, "collectEntries", "closure", Kind::map, "A map of what the closure makes of each.",
             "['a', 'b'].collectEntries { [it, it.toUpperCase()] }"},
            R"(def collectEntries(items, f) {
  def result = [:]
  for (x in items) {
    def pair = f(x)
    if (pair instanceof Map) { result.putAll(pair) } else { result[pair[0]] = pair[1] }
  }
  return result
})"),
    written({walked, "find", "closure", any, "The first for which the closure is true, or null.",
             "[1, 2, 3].find { it > 1 }"},
            R"(def find(items, f) {
  for (x in items) { if (f(x)) { return x } }
  return null
})"),
    written({walked, "findAll", "closure", any, "Those for which the closure is true.", "[1, 2, 3].findAll { it > 1 }"},
            R"(def findAll(items, f) {
  def result = items.emptyLike()
  for (x in items) { if (f(x)) { result = result.with(x) } }
  return result
})"),
    written({walked, "findIndexOf", "closure", Kind::integer,
             "The index of the first for which the closure is true, or -1.", "[5, 6].findIndexOf { it > 5 }"},
            R"(def findIndexOf(items, f) {
  def i = 0
  for (x in items) {
    if (f(x)) { return i }
    i++
  }
  return -1
})"),
    written({walked, "any", "closure?", Kind::boolean, "Whether the closure is true for one.", "[1, 2].any { it > 1 }"},
            R"(def any(items, f = { it }) {
  for (x in items) { if (f(x)) { return true } }
  return false
})"),
    written(
        {walked, "every", "closure?", Kind::boolean, "Whether the closure is true for all.", "[1, 2].every { it > 1 }"},
        R"(def every(items, f = { it }) {
  for (x in items) { if (!f(x)) { return false } }
  return true
})"),
    written({walked, "inject", "start?, closure", any, "Folds all into one value.",
             "[1, 2, 3].inject(10) { a, b -> a + b }"},
            R"(def inject(items, start, f = null) {
  def fold = f == null ? start : f
  def result = f == null ? null : start
  def isFirst = f == null
  def splits = items instanceof Map && parameters(fold) > 2
  for (x in items) {
    result = isFirst ? x : splits ? fold(result, x.key, x.value) : fold(result, x)
    isFirst = false
  }
  return result
})"),
    written({walked, "collectMany", "closure", Kind::list, "The lists that the closure makes of each, as one.",
             "[1, 2].collectMany { [it, -it] }"},
            R"(def collectMany(items, f) {
  def result = []
  for (x in items) { result.addAll(f(x).toList()) }
  return result
})"),
    written({walked, "findResult", "closure", any, "The first that the closure gives and is not null.",
             "[1, 2].findResult { it > 1 ? 'two' : null }"},
            R"(def findResult(items, f) {
  for (x in items) {
    def found = f(x)
    if (found != null) { return found }
  }
  return null
})"),
    written({walked, "reverseEach", "closure", any, "Calls the closure with each, the last one first.", ""},
            R"(def reverseEach(items, f) {
  for (x in items.toList().reverse()) { f(x) }
  return items
})"),
    written({walked, "withIndex", "", Kind::list, "Pairs of each and its index.", "['a', 'b'].withIndex()"},
            R"(def withIndex(items) {
  def result = []
  def i = 0
  for (x in items) { result << [x, i++] }
  return result
})"),
    written({walked, "toSorted", "closure?", Kind::list, "A new list, in order.", "[3, 1, 2].toSorted()"},
            R"(def toSorted(items, f = { it }) { return ordered(items.toList(), f) })"),
    pure({ordered, "join", "between?", Kind::text, "All as one text.", "[1, 2].join('-')", in_order<join>}),
    written(
        {walked, "sort", "changes itself?, closure?", any,
         "In order; a list is itself put into order, unless the first argument is false.", "[3, 1, 2].sort { -it }"},
        R"(def sort(items, how = null, f = null) {
  def changesItself = how != false && items instanceof List
  def by = how instanceof Boolean ? f : how
  if (items instanceof Map) {
    def sorted = [:]
    for (pair in ordered(items.toList(), by == null ? { it.key } : by)) { sorted[pair.key] = pair.value }
    return sorted
  }
  def result = ordered(items.toList(), by == null ? { it } : by)
  return changesItself ? items.become(result) : result
})"),
    written(pure({walked, "sum", "start?, closure?", any, "All added up, from a first value if there is one.",
                  "[1, 2].sum()"}),
            R"(def sum(items, start = null, f = { it }) {
  def value = start instanceof Closure ? start : f
  def result = start instanceof Closure ? null : start
  for (x in items) { result = result == null ? value(x) : result + value(x) }
  return result
})"),
    written({many, "count", "value or closure", Kind::integer,
             "How many equal the value, or for how many the closure is true.", "[1, 2, 3].count { it > 1 }"},
            R"(def count(items, f) {
  def result = 0
  def counts = f instanceof Closure ? f : { it == f }
  for (x in items) { if (counts(x)) { result++ } }
  return result
})"),
    written({walked, "groupBy", "closure", Kind::map, "Parts by what the closure makes of each.",
             "[1, 2, 3].groupBy { it % 2 }"},
            R"(def groupBy(items, f) {
  def result = [:]
  for (x in items) {
    def key = f(x)
    if (!result.containsKey(key)) { result[key] = items.emptyLike() }
    result[key] = result[key].with(x)
  }
  return result
})"),
    written({walked, "countBy", "closure", Kind::map, "How many there are by what the closure makes of each.",
             "[1, 2, 3].countBy { it % 2 }"},
            R"(def countBy(items, f) {
  def result = [:]
  for (x in items) {
    def key = f(x)
    result[key] = (result[key] ?: 0) + 1
  }
  return result
})"),
    written({walked, "takeWhile", "closure", any, "The first ones, as long as the closure is true.",
             "[1, 2, 3, 1].takeWhile { it < 3 }"},
            R"(def takeWhile(items, f) {
  def result = items.emptyLike()
  for (x in items) {
    if (!f(x)) { return result }
    result = result.with(x)
  }
  return result
})"),
    written({walked, "dropWhile", "closure", any, "What is left from the first on for which the closure is false.",
             "[1, 2, 3, 1].dropWhile { it < 3 }"},
            R"(def dropWhile(items, f) {
  def result = items.emptyLike()
  def drops = true
  for (x in items) {
    drops = drops && f(x)
    if (!drops) { result = result.with(x) }
  }
  return result
})"),
    written({walked, "toSet", "", Kind::list, "A new list in which each is once.", "[1, 2, 1].toSet()"},
            R"(def toSet(items) { return items.toList().unique() })"),
    written(pure({walked, "min", "closure?", any, "The smallest.", "['aa', 'b'].min { it.size() }"}),
            R"(def min(items, f = { it }) { return smallest(items, f, 1) })"),
    written(pure({walked, "max", "closure?", any, "The largest.", "[3, 1, 2].max()"}),
            R"(def max(items, f = { it }) { return smallest(items, f, -1) })"),
});

constexpr auto helpers = std::to_array<MethodSpec>({
    {walked, "emptyLike", "", any, "", "", of<no_items>},
    {many, "with", "value", any, "", "", of<list_with, map_with, set_with>},
    {lists, "become", "list", any, "", "", of<become>},
    {Kind::text, "cutBy", "pattern", any, "", "", of<cut_text>},
    {Kind::closure, "parameterCount", "", any, "", "",
     of<[](Call, Closure const& closure) { return Value::integer(closure.function->parameters); }>},
});

}  // namespace

std::span<MethodSpec const> walking_methods() {
  return table;
}

std::span<MethodSpec const> prelude_methods() {
  return helpers;
}

}  // namespace lapwing::dolphin::internal
