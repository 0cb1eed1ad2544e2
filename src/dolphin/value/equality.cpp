#include "dolphin/value/equality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/text.hpp"

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

/// Compares lists in lists to any depth, without recursion. A pair of containers that is being compared, or has been,
/// is not looked at again: lists that hold themselves, or share parts many times over, come to an end.
class Comparison {
 public:
  [[nodiscard]] std::size_t compared() const { return compared_; }

  bool equal(Value const& a, Value const& b) {
    if (!equal_so_far(a, b)) return false;
    while (!pending_.empty()) {
      auto const [x, y] = std::move(pending_.back());
      pending_.pop_back();
      if (!equal_inside(x, y)) return false;
    }
    return true;
  }

 private:
  static bool is_container(Value const& value) {
    return value.is(ValueKind::list) || value.is(ValueKind::map) || value.is(ValueKind::entry);
  }

  /// Whether they are equal as far as can be seen without looking into them; containers are put by for later.
  bool equal_so_far(Value const& a, Value const& b) {
    if (a.is_number() && b.is_number()) return same_number(a, b);
    if (a.is_object() && b.is_object() && &a.object() == &b.object()) return true;
    if (++compared_ > max_comparisons) return false;
    bool const are_lists = a.is(ValueKind::range) || b.is(ValueKind::range);
    if (a.kind() != b.kind()) return are_lists && same_sequence(a, b);
    if (!is_container(a)) return equal_values(a, b);
    bool const is_new = seen_.emplace(&a.object(), &b.object()).second;
    if (is_new) pending_.emplace_back(a, b);
    return true;
  }

  static bool equal_values(Value const& a, Value const& b) {
    switch (a.kind()) {
      case ValueKind::null: return true;
      case ValueKind::boolean: return a.boolean() == b.boolean();
      case ValueKind::text: return a.as<Text>()->text == b.as<Text>()->text;
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
      case ValueKind::pattern: return a.as<PatternValue>()->value->text() == b.as<PatternValue>()->value->text();
      case ValueKind::type: return a.as<TypeValue>()->value.name == b.as<TypeValue>()->value.name;
      default: return false;
    }
  }

  bool equal_inside(Value const& a, Value const& b) {
    if (auto const* entry = a.as<Entry>()) {
      return equal_so_far(entry->key, b.as<Entry>()->key) && equal_so_far(entry->value, b.as<Entry>()->value);
    }
    if (auto const* list = a.as<List>()) {
      return std::ranges::equal(list->items, b.as<List>()->items,
                                [&](Value const& x, Value const& y) { return equal_so_far(x, y); });
    }
    auto const& map = *a.as<Map>();
    auto const& other = *b.as<Map>();
    return map.size() == other.size() && std::ranges::all_of(map.items(), [&](auto const& item) {
             return other.contains(item.first) && equal_so_far(item.second, other.at(item.first));
           });
  }

  /// [1, 2, 3] == 1..3
  bool same_sequence(Value const& a, Value const& b) {
    auto const* list = a.as<List>() ? a.as<List>() : b.as<List>();
    auto const* range = a.as<Range>() ? a.as<Range>() : b.as<Range>();
    if (!list || !range || static_cast<std::int64_t>(list->items.size()) != range->size) return false;
    for (std::int64_t i = 0; i < range->size; ++i) {
      if (!equal_so_far(list->items[static_cast<std::size_t>(i)], Value::integer(range->at(i)))) return false;
    }
    return true;
  }

  std::size_t compared_ = 0;
  std::vector<std::pair<Value, Value>> pending_;
  std::set<std::pair<Object const*, Object const*>> seen_;
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
  return Comparison().equal(a, b);
}

Checked<std::optional<std::size_t>> find(std::span<Value const> items, Value const& wanted, std::size_t& compared) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    Comparison comparison;
    bool const is_found = comparison.equal(items[i], wanted);
    compared += 1 + comparison.compared();
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
