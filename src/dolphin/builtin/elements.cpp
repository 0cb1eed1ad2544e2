#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

/// What is in what: `x in list`, `list[0]`, `text[1..2]`, `task[vehicles]`, ranges.
namespace lapwing::dolphin {
namespace {

Checked<std::size_t> position_in(std::int64_t index, std::size_t size) {
  auto const count = static_cast<std::int64_t>(size);
  auto const position = index < 0 ? index + count : index;
  if (position < 0 || position >= count) {
    return fault(fmt::format("index {} is outside 0..<{}", index, count), "IndexOutOfBoundsException");
  }
  return static_cast<std::size_t>(position);
}

Checked<Value> restricted_task(Heap& heap, TaskValue const& task, Value const& index, tasks::Origin const& origin) {
  std::vector<vehicle::VehicleId> ids;
  if (auto const* set = index.as<Vehicles>()) ids = set->ids;
  if (auto const* one = index.as<Vehicle>()) ids = {one->value};
  if (!index.is(ValueKind::vehicles) && !index.is(ValueKind::vehicle))
    return fault(fmt::format("a task can be restricted to a vehicle set, not to {}", kind_name(index)));
  return task_value(heap, tasks::restricted(task.value, std::move(ids), origin));
}

}  // namespace

Checked<Value> make_range(Heap& heap, Value const& first, Value const& last, bool is_inclusive) {
  if (!first.is(ValueKind::integer) || !last.is(ValueKind::integer)) {
    return fault("a range goes from one integer to another", "IllegalArgumentException");
  }
  std::int64_t const from = first.integer();
  std::int64_t to = last.integer();
  if (!is_inclusive && from == to) return Value(heap.make<Range>(from, to, 0));
  if (!is_inclusive) to += to > from ? -1 : 1;
  std::int64_t length = 0;
  bool const is_too_long =
      to >= from ? __builtin_sub_overflow(to, from, &length) : __builtin_sub_overflow(from, to, &length);
  if (is_too_long || __builtin_add_overflow(length, std::int64_t{1}, &length)) return fault("the range is too long");
  return Value(heap.make<Range>(from, to, length));
}

Checked<bool> contains(Value const& container, Value const& item) {
  switch (container.kind()) {
    case ValueKind::null: return false;
    case ValueKind::list: {
      std::size_t compared = 0;
      auto const found = find(container.as<List>()->items, item, compared);
      if (!found) return std::unexpected(found.error());
      return found->has_value();
    }
    case ValueKind::map: return container.as<Map>()->contains(item);
    case ValueKind::text: return find_text(container.as<Text>()->text, to_text(item)) != std::string::npos;
    case ValueKind::range: {
      auto const& range = *container.as<Range>();
      if (!item.is_number() || range.size == 0) return false;
      double const x = item.number();
      auto const [low, high] = std::minmax(range.first, range.last);
      return x >= static_cast<double>(low) && x <= static_cast<double>(high) && x == std::floor(x);
    }
    case ValueKind::vehicles: {
      auto const& ids = container.as<Vehicles>()->ids;
      auto const holds = [&](auto const& id) { return std::ranges::find(ids, id) != ids.end(); };
      if (auto const* one = item.as<Vehicle>()) return holds(one->value);
      if (auto const* set = item.as<Vehicles>()) return std::ranges::all_of(set->ids, holds);
      return holds(vehicle::VehicleId{to_text(item)});
    }
    case ValueKind::area:
      if (auto const* place = item.as<Position>()) return container.as<Area>()->value.contains(place->value);
      return fault("an area contains positions only", "IllegalArgumentException");
    default: return fault(fmt::format("{} has no members", kind_name(container)), "IllegalArgumentException");
  }
}

namespace {

/// Of what has places, but a text.
std::size_t size_of(Value const& object) {
  if (auto const* list = object.as<List>()) return list->items.size();
  if (auto const* range = object.as<Range>()) return static_cast<std::size_t>(range->size);
  return object.as<Vehicles>()->ids.size();
}

/// One element. `pieces`: the code points of a text.
Checked<Value> element_at(Heap& heap, Value const& object, Value const& index,
                          std::vector<std::string_view> const& pieces) {
  if (!index.is(ValueKind::integer)) {
    return fault(fmt::format("{} is no index of {}", kind_name(index), kind_name(object)), "IllegalArgumentException");
  }
  std::int64_t const i = index.integer();
  auto const* list = object.as<List>();
  // As in Groovy: beyond the end of a list there is nothing, before its start is an error.
  if (list && i >= static_cast<std::int64_t>(list->items.size())) return Value();
  auto const* range = object.as<Range>();
  auto const at = position_in(i, object.is(ValueKind::text) ? pieces.size() : size_of(object));
  if (!at) return std::unexpected(at.error());
  if (list) return list->items[*at];
  if (range) return Value::integer(range->at(static_cast<std::int64_t>(*at)));
  if (object.is(ValueKind::text)) return Value(heap.make<Text>(std::string(pieces[*at])));
  return Value(heap.make<Vehicle>(object.as<Vehicles>()->ids[*at]));
}

std::vector<std::string_view> pieces_of(Value const& object) {
  auto const* text = object.as<Text>();
  return text ? code_points(text->text) : std::vector<std::string_view>();
}

/// 1..-1 is from the second to the last.
Checked<std::vector<Value>> indices_of(Range const& range, std::size_t size) {
  std::vector<Value> indices;
  if (range.size == 0) return indices;
  auto const first = position_in(range.first, size);
  auto const last = position_in(range.last, size);
  if (!first) return std::unexpected(first.error());
  if (!last) return std::unexpected(last.error());
  auto const from = static_cast<std::int64_t>(*first);
  auto const to = static_cast<std::int64_t>(*last);
  auto const count = std::abs(to - from) + 1;
  if (count > max_copied_range) return fault("the range is too long to be made a list", "OutOfMemoryError");
  for (std::int64_t i = 0; i < count; ++i) indices.push_back(Value::integer(to < from ? from - i : from + i));
  return indices;
}

/// The elements at several indices: text[1..2], list[0, 2].
Checked<Value> elements(Heap& heap, Value const& object, Value const& indices) {
  auto const pieces = pieces_of(object);
  auto const* range = indices.as<Range>();
  auto const wanted = range ? indices_of(*range, object.is(ValueKind::text) ? pieces.size() : size_of(object))
                            : Checked<std::vector<Value>>(indices.as<List>()->items);
  if (!wanted) return std::unexpected(wanted.error());
  std::string text;
  std::vector<Value> items;
  std::vector<vehicle::VehicleId> ids;
  for (auto const& index : *wanted) {
    auto item = element_at(heap, object, index, pieces);
    if (!item) return item;
    if (object.is(ValueKind::text)) text += item->as<Text>()->text;
    if (object.is(ValueKind::vehicles)) ids.push_back(item->as<Vehicle>()->value);
    if (object.is(ValueKind::list) || object.is(ValueKind::range)) items.push_back(std::move(*item));
  }
  if (object.is(ValueKind::text)) return make_text(heap, std::move(text));
  if (object.is(ValueKind::vehicles)) return Value(heap.make<Vehicles>(std::move(ids)));
  return Value(heap.make<List>(std::move(items)));
}

bool has_places(Value const& object) {
  return object.is(ValueKind::text) || object.is(ValueKind::list) || object.is(ValueKind::range) ||
         object.is(ValueKind::vehicles);
}

}  // namespace

Checked<Value> element(Heap& heap, Value const& object, Value const& index, tasks::Origin const& origin) {
  if (auto const* map = object.as<Map>()) return map->at(index);
  if (auto const* task = object.as<TaskValue>()) return restricted_task(heap, *task, index, origin);
  if (!has_places(object)) return fault(fmt::format("{} has no elements", kind_name(object)), "MissingMethodException");
  if (index.is(ValueKind::range) || index.is(ValueKind::list)) return elements(heap, object, index);
  return element_at(heap, object, index, pieces_of(object));
}

Checked<Value> set_element(Value const& object, Value const& index, Value value) {
  if (auto* map = object.as<Map>()) {
    map->set(index, std::move(value));
    return Value();
  }
  auto* list = object.as<List>();
  if (!list || !index.is(ValueKind::integer))
    return fault(fmt::format("cannot assign to an element of {}", kind_name(object)));
  constexpr std::int64_t furthest = 1'000'000;
  auto const size = static_cast<std::int64_t>(list->items.size());
  if (index.integer() >= size && index.integer() < size + furthest) {
    while (static_cast<std::int64_t>(list->items.size()) < index.integer()) list->push(Value());
    list->push(std::move(value));
    return Value();
  }
  auto const at = position_in(index.integer(), list->items.size());
  if (!at) return std::unexpected(at.error());
  list->items[*at] = std::move(value);
  return Value();
}

}  // namespace lapwing::dolphin
