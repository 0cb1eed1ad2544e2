#include "dolphin/value/operators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/membership.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {
namespace {

using ast::BinaryOp;

std::string_view spelling(BinaryOp op) {
  switch (op) {
    case BinaryOp::power: return "**";
    case BinaryOp::multiply: return "*";
    case BinaryOp::divide: return "/";
    case BinaryOp::remainder: return "%";
    case BinaryOp::add: return "+";
    case BinaryOp::subtract: return "-";
    case BinaryOp::shift_right: return ">>";
    case BinaryOp::shift_left: return "<<";
    case BinaryOp::bit_and: return "&";
    case BinaryOp::bit_xor: return "^";
    case BinaryOp::bit_or: return "|";
    case BinaryOp::find: return "=~";
    case BinaryOp::match: return "==~";
    default: return "this operator";
  }
}

std::unexpected<Fault> no_such_operation(BinaryOp op, Value const& left, Value const& right) {
  return fault(fmt::format("{} has no operator {} with {}", kind_name(left), spelling(op), kind_name(right)),
               "MissingMethodException");
}

std::unexpected<Fault> overflow(BinaryOp op, std::int64_t a, std::int64_t b) {
  return fault(fmt::format("{} {} {} does not fit into a 64-bit integer", a, spelling(op), b), "ArithmeticException");
}

Checked<Value> integer_power(std::int64_t base, std::int64_t exponent) {
  if (exponent < 0) return Value::real(std::pow(static_cast<double>(base), static_cast<double>(exponent)));
  std::int64_t result = 1;
  for (std::int64_t left = exponent, factor = base; left > 0;) {
    if ((left & 1) && __builtin_mul_overflow(result, factor, &result)) return overflow(BinaryOp::power, base, exponent);
    left >>= 1;
    if (left > 0 && __builtin_mul_overflow(factor, factor, &factor)) return overflow(BinaryOp::power, base, exponent);
  }
  return Value::integer(result);
}

Checked<Value> divide(std::int64_t a, std::int64_t b) {
  if (b == 0) return fault("division by zero", "ArithmeticException");
  if (b != -1 && a % b == 0) return Value::integer(a / b);
  if (b == -1) {
    std::int64_t result = 0;
    if (__builtin_sub_overflow(std::int64_t{0}, a, &result)) return overflow(BinaryOp::divide, a, b);
    return Value::integer(result);
  }
  return Value::real(static_cast<double>(a) / static_cast<double>(b));
}

Checked<Value> shift(BinaryOp op, std::int64_t a, std::int64_t b) {
  if (b < 0 || b > 63) return fault(fmt::format("cannot shift by {} bits", b), "ArithmeticException");
  if (op == BinaryOp::shift_right) return Value::integer(a >> b);
  return Value::integer(static_cast<std::int64_t>(static_cast<std::uint64_t>(a) << b));
}

Checked<Value> integer_operation(BinaryOp op, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  switch (op) {
    case BinaryOp::add:
      if (__builtin_add_overflow(a, b, &result)) return overflow(op, a, b);
      return Value::integer(result);
    case BinaryOp::subtract:
      if (__builtin_sub_overflow(a, b, &result)) return overflow(op, a, b);
      return Value::integer(result);
    case BinaryOp::multiply:
      if (__builtin_mul_overflow(a, b, &result)) return overflow(op, a, b);
      return Value::integer(result);
    case BinaryOp::divide: return divide(a, b);
    case BinaryOp::remainder:
      if (b == 0) return fault("division by zero", "ArithmeticException");
      return Value::integer(b == -1 ? 0 : a % b);
    case BinaryOp::power: return integer_power(a, b);
    case BinaryOp::bit_and: return Value::integer(a & b);
    case BinaryOp::bit_or: return Value::integer(a | b);
    case BinaryOp::bit_xor: return Value::integer(a ^ b);
    case BinaryOp::shift_left:
    case BinaryOp::shift_right: return shift(op, a, b);
    default: return no_such_operation(op, Value::integer(a), Value::integer(b));
  }
}

Checked<Value> real_operation(BinaryOp op, Value const& left, Value const& right) {
  double const a = left.number();
  double const b = right.number();
  switch (op) {
    case BinaryOp::add: return Value::real(a + b);
    case BinaryOp::subtract: return Value::real(a - b);
    case BinaryOp::multiply: return Value::real(a * b);
    case BinaryOp::divide:
      if (b == 0.0) return fault("division by zero", "ArithmeticException");
      return Value::real(a / b);
    case BinaryOp::remainder:
      if (b == 0.0) return fault("division by zero", "ArithmeticException");
      return Value::real(std::fmod(a, b));
    case BinaryOp::power: return Value::real(std::pow(a, b));
    default: return no_such_operation(op, left, right);
  }
}

Checked<Value> truth_operation(BinaryOp op, Value const& left, Value const& right) {
  switch (op) {
    case BinaryOp::bit_and: return Value::boolean(left.boolean() && right.boolean());
    case BinaryOp::bit_or: return Value::boolean(left.boolean() || right.boolean());
    case BinaryOp::bit_xor: return Value::boolean(left.boolean() != right.boolean());
    default: return no_such_operation(op, left, right);
  }
}

Checked<Value> vehicles_operation(Heap& heap, BinaryOp op, Vehicles const& a, Vehicles const& b) {
  auto const holds = [](Vehicles const& set, auto const& id) {
    return std::ranges::find(set.ids, id) != set.ids.end();
  };
  std::vector<vehicle::VehicleId> ids;
  switch (op) {
    case BinaryOp::add:
      ids = a.ids;
      std::ranges::copy_if(b.ids, std::back_inserter(ids), [&](auto const& id) { return !holds(a, id); });
      break;
    case BinaryOp::subtract:
      std::ranges::copy_if(a.ids, std::back_inserter(ids), [&](auto const& id) { return !holds(b, id); });
      break;
    case BinaryOp::bit_and:
      std::ranges::copy_if(a.ids, std::back_inserter(ids), [&](auto const& id) { return holds(b, id); });
      break;
    default:
      return fault(fmt::format("two vehicle sets have no operator {}; they have + - &", spelling(op)),
                   "MissingMethodException");
  }
  return Value(heap.make<Vehicles>(std::move(ids)));
}

/// One vehicle counts as a set of one; nothing when `value` is neither.
Ref<Vehicles> as_set(Heap& heap, Value const& value) {
  if (auto* set = value.as<Vehicles>()) return Ref<Vehicles>(set);
  if (auto* one = value.as<Vehicle>()) return heap.make<Vehicles>(std::vector{one->value});
  return {};
}

Checked<Value> repeated_list(Heap& heap, List const& list, std::int64_t times) {
  auto const size = static_cast<std::int64_t>(list.items.size());
  if (times < 0) return fault(fmt::format("a list cannot be repeated {} times", times), "IllegalArgumentException");
  if (size > 0 && times > max_copied_range / size) return fault("the list is too long", "OutOfMemoryError");
  std::vector<Value> items;
  for (std::int64_t i = 0; i < times && size > 0; ++i) {
    items.insert(items.end(), list.items.begin(), list.items.end());
  }
  return Value(heap.make<List>(std::move(items)));
}

Checked<Value> list_difference(Heap& heap, List const& list, std::span<Value const> taken) {
  internal::Membership gone(taken);
  std::vector<Value> rest;
  std::ranges::copy_if(list.items, std::back_inserter(rest), [&](Value const& item) { return !gone.holds(item); });
  return gone.result(Value(heap.make<List>(std::move(rest))));
}

Checked<Value> list_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right) {
  auto* list = left.as<List>();
  auto* other = right.as<List>();
  if (op == BinaryOp::multiply && right.is(ValueKind::integer)) return repeated_list(heap, *list, right.integer());
  if (op == BinaryOp::shift_left) {
    list->push(right);
    return left;
  }
  std::span<Value const> const operand = other ? std::span<Value const>(other->items) : std::span(&right, 1);
  if (op == BinaryOp::subtract) return list_difference(heap, *list, operand);
  if (op != BinaryOp::add) return no_such_operation(op, left, right);
  auto items = list->items;
  items.insert(items.end(), operand.begin(), operand.end());
  return Value(heap.make<List>(std::move(items)));
}

/// 'ab' * 2, 'abc' - 'c'.
Checked<Value> text_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right) {
  auto const& text = left.as<Text>()->text;
  if (op == BinaryOp::subtract) {
    auto const part = to_text(right);
    auto const at = find_text(text, part);
    if (at == std::string::npos) return left;
    return Value(heap.make<Text>(text.substr(0, at) + text.substr(at + part.size())));
  }
  if (op != BinaryOp::multiply || !right.is(ValueKind::integer)) return no_such_operation(op, left, right);
  auto const times = right.integer();
  if (times < 0) return fault(fmt::format("a text cannot be repeated {} times", times), "IllegalArgumentException");
  if (!text.empty() && static_cast<std::size_t>(times) > max_text_size / text.size()) {
    return fault("the text is too long", "OutOfMemoryError");
  }
  std::string repeated;
  for (std::int64_t i = 0; i < times && !text.empty(); ++i) repeated += text;
  return Value(heap.make<Text>(std::move(repeated)));
}

/// A range as the list of its numbers, for operators; null when it is too long.
Ref<List> as_list(Heap& heap, Range const& range) {
  if (range.size > max_copied_range) return {};
  std::vector<Value> items;
  for (std::int64_t i = 0; i < range.size; ++i) items.push_back(Value::integer(range.at(i)));
  return heap.make<List>(std::move(items));
}

/// map + map, map - map, map << map, map << entry.
Checked<Value> map_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right) {
  auto& map = *left.as<Map>();
  if (auto const* entry = right.as<Entry>(); entry && op == BinaryOp::shift_left) {
    map.set(entry->key, entry->value);
    return left;
  }
  auto const* other = right.as<Map>();
  bool const is_known = op == BinaryOp::add || op == BinaryOp::subtract || op == BinaryOp::shift_left;
  if (!other || !is_known) return no_such_operation(op, left, right);
  auto result = op == BinaryOp::shift_left ? Ref<Map>(&map) : heap.make<Map>();
  if (op == BinaryOp::subtract) {
    for (auto const& [key, value] : map.items()) {
      if (!other->contains(key) || !equal(other->at(key), value)) result->set(key, value);
    }
    return Value(result);
  }
  if (op == BinaryOp::add) {
    for (auto const& [key, value] : map.items()) result->set(key, value);
  }
  if (other != result.get()) {
    for (auto const& [key, value] : other->items()) result->set(key, value);
  }
  return Value(result);
}

Checked<Value> position_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right) {
  auto const& place = left.as<Position>()->value;
  if (op == BinaryOp::bit_xor && right.is_number()) {
    double const radius = right.number();
    if (!(radius >= 0.0)) return fault("the radius of an area must not be negative", "IllegalArgumentException");
    return Value(heap.make<Area>(geo::Disc{place, radius}));
  }
  if (op == BinaryOp::add && right.is(ValueKind::displacement)) {
    return Value(heap.make<Position>(geo::displaced(place, right.as<Displacement>()->value)));
  }
  return no_such_operation(op, left, right);
}

}  // namespace

Checked<Value> task_value(Heap& heap, tasks::TaskTree tree) {
  if (tree->depth > tasks::max_task_depth) {
    return fault(fmt::format("the task is nested more than {} deep", tasks::max_task_depth),
                 "IllegalArgumentException");
  }
  if (tree->size > tasks::max_task_size) {
    return fault(fmt::format("the task has more than {} parts", tasks::max_task_size), "IllegalArgumentException");
  }
  return Value(heap.make<TaskValue>(std::move(tree)));
}

namespace {

/// task >> task, task | task; nothing for anything else.
std::optional<Checked<Value>> tasks_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right,
                                              tasks::Origin const& origin) {
  auto const* const first = left.as<TaskValue>();
  auto const* const second = right.as<TaskValue>();
  if (!first || !second) return std::nullopt;
  if (op == BinaryOp::shift_right) return task_value(heap, tasks::sequence(first->value, second->value, origin));
  if (op == BinaryOp::bit_or) return task_value(heap, tasks::concurrent(first->value, second->value, origin));
  return std::nullopt;
}

/// Of a list or a range. A range counts as the list of its numbers where there is more to do than to look at it.
Checked<Value> items_operation(Heap& heap, BinaryOp op, Value const& left, Value const& right,
                               tasks::Origin const& origin) {
  if (auto const* const range = right.as<Range>(); range && op != BinaryOp::shift_left) {
    auto const list = as_list(heap, *range);
    return list ? apply(heap, op, left, Value(list), origin) : no_such_operation(op, left, right);
  }
  if (auto const* const range = left.as<Range>(); range && (op == BinaryOp::add || op == BinaryOp::subtract)) {
    auto const list = as_list(heap, *range);
    return list ? apply(heap, op, Value(list), right, origin) : no_such_operation(op, left, right);
  }
  return left.is(ValueKind::list) ? list_operation(heap, op, left, right) : no_such_operation(op, left, right);
}

}  // namespace

Checked<Value> apply(Heap& heap, BinaryOp op, Value const& left, Value const& right, tasks::Origin const& origin) {
  if (left.is(ValueKind::integer) && right.is(ValueKind::integer))
    return integer_operation(op, left.integer(), right.integer());
  if (left.is_number() && right.is_number()) return real_operation(op, left, right);
  if (left.is(ValueKind::boolean) && right.is(ValueKind::boolean)) return truth_operation(op, left, right);
  bool const has_items = left.is(ValueKind::list) || left.is(ValueKind::range);
  if (op == BinaryOp::add && (left.is(ValueKind::text) || (right.is(ValueKind::text) && !has_items)))
    return make_text(heap, to_text(left) + to_text(right));
  if (auto joined = tasks_operation(heap, op, left, right, origin)) return *std::move(joined);
  if (auto const a = as_set(heap, left))
    if (auto const b = as_set(heap, right)) return vehicles_operation(heap, op, *a, *b);
  if (has_items) return items_operation(heap, op, left, right, origin);
  if (left.is(ValueKind::text)) return text_operation(heap, op, left, right);
  if (left.is(ValueKind::position)) return position_operation(heap, op, left, right);
  if (left.is(ValueKind::map)) return map_operation(heap, op, left, right);
  return no_such_operation(op, left, right);
}

Checked<Value> negate(Value const& operand) {
  if (operand.is(ValueKind::real)) return Value::real(-operand.real());
  if (!operand.is(ValueKind::integer)) return fault(fmt::format("{} has no negative", kind_name(operand)));
  return integer_operation(BinaryOp::subtract, 0, operand.integer());
}

std::optional<Checked<Value>> with_unit(Value const& number, std::string_view name) {
  struct Unit {
    std::string_view name;
    std::int64_t factor;
  };
  static constexpr Unit whole[] = {{"meters", 1},  {"km", 1000},    {"kilometers", 1000}, {"degrees", 1},
                                   {"north", 1},   {"south", -1},   {"east", 1},          {"west", -1},
                                   {"seconds", 1}, {"minutes", 60}, {"hours", 3600},      {"days", 86400}};
  for (auto const& unit : whole) {
    if (unit.name != name) continue;
    if (number.is(ValueKind::integer)) return integer_operation(BinaryOp::multiply, number.integer(), unit.factor);
    return Value::real(number.real() * static_cast<double>(unit.factor));
  }
  if (name == "radians") return Value::real(number.number() * 180.0 / std::numbers::pi);
  if (name == "percent") return Value::real(number.number() / 100.0);
  return std::nullopt;
}

}  // namespace lapwing::dolphin
