#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/regular_expression.hpp"
#include "dolphin/value/value.hpp"
#include "geo/position.hpp"
#include "tasks/task.hpp"
#include "vehicle/vehicle_id.hpp"

namespace lapwing::dolphin {

struct Function;

struct Text final : Object {
  static constexpr ValueKind its_kind = ValueKind::text;
  Text(Heap& heap, std::string value) : Object(heap, its_kind), text(std::move(value)) { charge(text.capacity()); }
  std::string const text;
};

struct List final : Object {
  static constexpr ValueKind its_kind = ValueKind::list;
  explicit List(Heap& heap) : Object(heap, its_kind) {}
  List(Heap& heap, std::vector<Value> values) : Object(heap, its_kind), items(std::move(values)) {
    charge(items.capacity() * sizeof(Value));
  }
  void push(Value value) {
    items.push_back(std::move(value));
    charge(items.capacity() * sizeof(Value));
  }
  /// Empties the list. Values may refer to it: let them go after.
  [[nodiscard]] std::vector<Value> take_all() {
    auto taken = std::exchange(items, {});
    charge(0);
    return taken;
  }
  void drop_references() override { auto const gone = take_all(); }
  std::vector<Value> items;
};

/// Equality and hash of map keys: numbers by exact value, reference kinds without value equality by identity.
struct KeyEqual {
  bool operator()(Value const& a, Value const& b) const;
};
struct KeyHash {
  std::size_t operator()(Value const& key) const;
};

/// Keeps the order in which keys came.
class Map final : public Object {
 public:
  static constexpr ValueKind its_kind = ValueKind::map;
  using Items = std::list<std::pair<Value const, Value>>;
  explicit Map(Heap& heap) : Object(heap, its_kind) {}

  void set(Value const& key, Value value);
  /// Null when there is no such key.
  [[nodiscard]] Value at(Value const& key) const;
  [[nodiscard]] bool contains(Value const& key) const { return index_.contains(key); }
  bool erase(Value const& key);
  void clear();
  [[nodiscard]] Items const& items() const { return items_; }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  void drop_references() override { clear(); }

 private:
  Items items_;
  std::unordered_map<Value, Items::iterator, KeyHash, KeyEqual> index_;
};

struct Entry final : Object {
  static constexpr ValueKind its_kind = ValueKind::entry;
  Entry(Heap& heap, Value its_key, Value its_value)
      : Object(heap, its_kind), key(std::move(its_key)), value(std::move(its_value)) {}
  void drop_references() override { key = value = Value(); }
  Value key;
  Value value;
};

/// The integers from `first` towards `last`, both included; `size` says how many (0 for `1..<1`).
struct Range final : Object {
  static constexpr ValueKind its_kind = ValueKind::range;
  Range(Heap& heap, std::int64_t from, std::int64_t to, std::int64_t count)
      : Object(heap, its_kind), first(from), last(to), size(count) {}
  [[nodiscard]] std::int64_t at(std::int64_t index) const { return last < first ? first - index : first + index; }
  std::int64_t const first;
  std::int64_t const last;
  std::int64_t const size;
};

struct Cell final : Object {
  static constexpr ValueKind its_kind = ValueKind::cell;
  Cell(Heap& heap, Value held) : Object(heap, its_kind), value(std::move(held)) {}
  void drop_references() override { value = Value(); }
  Value value;
};

struct Closure final : Object {
  static constexpr ValueKind its_kind = ValueKind::closure;
  Closure(Heap& heap, std::shared_ptr<Function const> code, std::vector<Ref<Cell>> cells)
      : Object(heap, its_kind), function(std::move(code)), captured(std::move(cells)) {
    charge(captured.size() * sizeof(Ref<Cell>));
  }
  void drop_references() override { captured.clear(); }
  std::shared_ptr<Function const> const function;
  std::vector<Ref<Cell>> captured;
};

/// An ordered set of vehicles; each id once.
struct Vehicles final : Object {
  static constexpr ValueKind its_kind = ValueKind::vehicles;
  Vehicles(Heap& heap, std::vector<vehicle::VehicleId> members) : Object(heap, its_kind), ids(std::move(members)) {
    charge(ids.size() * sizeof(vehicle::VehicleId));
  }
  std::vector<vehicle::VehicleId> const ids;
};

/// A value without references, wrapped as an object.
template <class T, ValueKind boxed_kind>
struct Boxed final : Object {
  static constexpr ValueKind its_kind = boxed_kind;
  Boxed(Heap& heap, T held) : Object(heap, boxed_kind), value(std::move(held)) { charge(sizeof(T)); }
  T const value;
};

using Vehicle = Boxed<vehicle::VehicleId, ValueKind::vehicle>;
using Position = Boxed<geo::Wgs84, ValueKind::position>;
using Displacement = Boxed<geo::Ned, ValueKind::displacement>;
using Area = Boxed<geo::Disc, ValueKind::area>;

struct TaskValue final : Object {
  static constexpr ValueKind its_kind = ValueKind::task;
  TaskValue(Heap& heap, tasks::TaskTree tree) : Object(heap, its_kind), value(std::move(tree)) { charge(value->bytes); }
  tasks::TaskTree const value;
};

/// What `throw` throws and `catch` catches.
struct ErrorData {
  std::string type;
  std::string message;
  int line = 0;
  Ending ending = Ending::error;
};
using Error = Boxed<ErrorData, ValueKind::error>;

/// What `execute` returns: true when the task is done.
struct OutcomeData {
  bool done = true;
  std::string error;
  std::vector<vehicle::VehicleId> vehicles;
};
using ExecuteOutcome = Boxed<OutcomeData, ValueKind::outcome>;

/// A class name used as a value: `Math`, `Position`, `PRECISION_LAND_MODE`.
struct TypeName {
  std::string name;
};
using TypeValue = Boxed<TypeName, ValueKind::type>;

/// `/x+/`, `~text`.
struct PatternValue final : Object {
  static constexpr ValueKind its_kind = ValueKind::pattern;
  PatternValue(Heap& heap, std::shared_ptr<RegularExpression const> expression)
      : Object(heap, its_kind), value(std::move(expression)) {
    charge(RegularExpression::most_bytes);
  }
  std::shared_ptr<RegularExpression const> const value;
};

}  // namespace lapwing::dolphin
