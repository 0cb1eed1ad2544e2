#include "dolphin/equality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dolphin/limits.hpp"
#include "dolphin/objects.hpp"
#include "dolphin/text.hpp"

namespace lapwing::dolphin {
namespace {

constexpr double relative_tolerance = 1e-12;
constexpr std::size_t bytes_of_item = 128;  // of a map: list node, index node, bucket

bool same_number(Value const& a, Value const& b) {
  if (a.is(ValueKind::integer) && b.is(ValueKind::integer)) return a.integer() == b.integer();
  double const x = a.number();
  double const y = b.number();
  if (x == y) return true;
  return std::fabs(x - y) <= relative_tolerance * std::max(std::fabs(x), std::fabs(y)) && std::isfinite(x) &&
         std::isfinite(y);
}

bool same_members(Vehicles const& a, Vehicles const& b) {
  auto const in_b = [&](auto const& id) { return std::ranges::find(b.ids, id) != b.ids.end(); };
  return a.ids.size() == b.ids.size() && std::ranges::all_of(a.ids, in_b);
}

/// Counts what it compares, so that lists that share parts many times over, or hold themselves, end as unequal.
class Comparison {
 public:
  [[nodiscard]] int compared() const { return compared_; }
  bool equal(Value const& a, Value const& b, int depth) {
    if (a.is_number() && b.is_number()) return same_number(a, b);
    if (a.kind() != b.kind()) return same_sequence(a, b, depth);
    if (a.is_object() && &a.object() == &b.object()) return true;
    if (depth > 64 || ++compared_ > 1'000'000) return false;
    switch (a.kind()) {
      case ValueKind::null: return true;
      case ValueKind::boolean: return a.boolean() == b.boolean();
      case ValueKind::text: return a.as<Text>()->text == b.as<Text>()->text;
      case ValueKind::list: return equal_lists(*a.as<List>(), *b.as<List>(), depth);
      case ValueKind::map: return equal_maps(*a.as<Map>(), *b.as<Map>(), depth);
      case ValueKind::entry:
        return equal(a.as<Entry>()->key, b.as<Entry>()->key, depth + 1) &&
               equal(a.as<Entry>()->value, b.as<Entry>()->value, depth + 1);
      case ValueKind::range: {
        auto const& x = *a.as<Range>();
        auto const& y = *b.as<Range>();
        return x.size == y.size && (x.size == 0 || (x.first == y.first && x.last == y.last));
      }
      case ValueKind::vehicles: return same_members(*a.as<Vehicles>(), *b.as<Vehicles>());
      case ValueKind::vehicle: return a.as<Vehicle>()->value == b.as<Vehicle>()->value;
      case ValueKind::position: return a.as<Position>()->value == b.as<Position>()->value;
      case ValueKind::displacement: return a.as<Displacement>()->value == b.as<Displacement>()->value;
      case ValueKind::area: return a.as<Area>()->value == b.as<Area>()->value;
      case ValueKind::type: return a.as<TypeValue>()->value.name == b.as<TypeValue>()->value.name;
      default: return false;
    }
  }

 private:
  /// [1, 2, 3] == 1..3
  bool same_sequence(Value const& a, Value const& b, int depth) {
    auto const* list = a.as<List>() ? a.as<List>() : b.as<List>();
    auto const* range = a.as<Range>() ? a.as<Range>() : b.as<Range>();
    if (!list || !range || static_cast<std::int64_t>(list->items.size()) != range->size) return false;
    for (std::int64_t i = 0; i < range->size; ++i) {
      if (!equal(list->items[static_cast<std::size_t>(i)], Value::integer(range->at(i)), depth + 1)) return false;
    }
    return true;
  }
  bool equal_lists(List const& a, List const& b, int depth) {
    return std::ranges::equal(a.items, b.items, [&](auto const& x, auto const& y) { return equal(x, y, depth + 1); });
  }
  bool equal_maps(Map const& a, Map const& b, int depth) {
    if (a.size() != b.size()) return false;
    return std::ranges::all_of(a.items(), [&](auto const& item) {
      return b.contains(item.first) && equal(item.second, b.at(item.first), depth + 1);
    });
  }

  int compared_ = 0;
};

std::partial_ordering order_numbers(Value const& a, Value const& b) {
  if (same_number(a, b)) return std::partial_ordering::equivalent;
  if (a.is(ValueKind::integer) && b.is(ValueKind::integer)) return a.integer() <=> b.integer();
  return a.number() <=> b.number();
}

}  // namespace

bool is_true(Value const& value) {
  switch (value.kind()) {
    case ValueKind::null: return false;
    case ValueKind::boolean: return value.boolean();
    case ValueKind::integer: return value.integer() != 0;
    case ValueKind::real: return value.real() != 0.0 && !std::isnan(value.real());
    case ValueKind::text: return !value.as<Text>()->text.empty();
    case ValueKind::list: return !value.as<List>()->items.empty();
    case ValueKind::map: return value.as<Map>()->size() > 0;
    case ValueKind::range: return value.as<Range>()->size > 0;
    case ValueKind::vehicles: return !value.as<Vehicles>()->ids.empty();
    case ValueKind::outcome: return value.as<ExecuteOutcome>()->value.done;
    default: return true;
  }
}

bool equal(Value const& a, Value const& b) {
  return Comparison().equal(a, b, 0);
}

Checked<std::optional<std::size_t>> find(std::span<Value const> items, Value const& wanted, std::size_t& compared) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    Comparison comparison;
    bool const is_found = comparison.equal(items[i], wanted, 0);
    compared += 1 + static_cast<std::size_t>(comparison.compared());
    if (is_found) return i;
    if (compared > max_comparisons) return fault("the lists are too long to compare", "OutOfMemoryError");
  }
  return std::nullopt;
}

Checked<std::partial_ordering> compare(Value const& a, Value const& b) {
  if (a.is_number() && b.is_number()) return order_numbers(a, b);
  if (a.kind() == b.kind()) {
    switch (a.kind()) {
      case ValueKind::boolean: return a.boolean() <=> b.boolean();
      case ValueKind::text: return a.as<Text>()->text <=> b.as<Text>()->text;
      case ValueKind::vehicle: return a.as<Vehicle>()->value <=> b.as<Vehicle>()->value;
      default: break;
    }
  }
  return fault(fmt::format("{} cannot be compared with {}", kind_name(a), kind_name(b)), "IllegalArgumentException");
}

bool KeyEqual::operator()(Value const& a, Value const& b) const {
  if (a.is(ValueKind::integer) && b.is(ValueKind::integer)) return a.integer() == b.integer();
  if (a.is_number() && b.is_number()) return a.number() == b.number();
  return equal(a, b);
}

std::size_t KeyHash::operator()(Value const& key) const {
  switch (key.kind()) {
    case ValueKind::boolean: return key.boolean() ? 1 : 2;
    case ValueKind::integer:
    case ValueKind::real: return std::hash<double>()(key.number());
    case ValueKind::text: return std::hash<std::string>()(key.as<Text>()->text);
    case ValueKind::vehicle: return std::hash<std::string>()(key.as<Vehicle>()->value.text);
    default: return static_cast<std::size_t>(key.kind());
  }
}

void Map::set(Value const& key, Value value) {
  if (auto const found = index_.find(key); found != index_.end()) {
    found->second->second = std::move(value);
    return;
  }
  items_.emplace_back(key, std::move(value));
  index_.emplace(key, std::prev(items_.end()));
  charge(items_.size() * bytes_of_item);
}

Value Map::at(Value const& key) const {
  auto const found = index_.find(key);
  return found == index_.end() ? Value() : found->second->second;
}

bool Map::erase(Value const& key) {
  auto const found = index_.find(key);
  if (found == index_.end()) return false;
  auto const item = found->second;
  index_.erase(found);
  items_.erase(item);
  charge(items_.size() * bytes_of_item);
  return true;
}

void Map::clear() {
  // Values may refer to this map: empty it first, let them go after.
  auto const index = std::exchange(index_, {});
  auto const items = std::exchange(items_, {});
  charge(0);
}

}  // namespace lapwing::dolphin
