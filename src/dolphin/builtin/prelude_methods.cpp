#include <array>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/code/bytecode.hpp"

/// Methods that functions of the prelude call and scripts do not know.
namespace lapwing::dolphin::internal {
namespace {

// ---- what `findAll` and others gather in: of the kind that they walk through

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

// ---- others

/// What `sort` does to a list.
MethodResult become(Call call, List& list) {
  auto const* other = call.arguments[0].as<List>();
  if (!other) return std::nullopt;
  auto fresh = other->items;
  std::swap(list.items, fresh);
  return Value(&list);
}

Value parameter_count(Call /*call*/, Closure const& closure) {
  return Value::integer(closure.function->parameters);
}

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    {walked, "emptyLike", "", any, "", "", of<no_items>},
    {many, "with", "value", any, "", "", of<list_with, map_with, set_with>},
    {lists, "become", "list", any, "", "", of<become>},
    {Kind::text, "cutBy", "pattern", any, "", "", of<cut_by_matches>},
    {Kind::closure, "parameterCount", "", any, "", "", of<parameter_count>},
});

}  // namespace

std::span<MethodSpec const> prelude_methods() {
  return table;
}

}  // namespace lapwing::dolphin::internal
