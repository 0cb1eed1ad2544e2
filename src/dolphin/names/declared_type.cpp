#include "dolphin/names/declared_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "dolphin/builtin/members.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {

namespace {

enum class Held { whole, decimal, number, text, truth, list, set, map, closure, own_kind };

struct Declared {
  std::string_view name;
  Held held;
  bool takes_null = true;
};

constexpr auto declared_types = std::to_array<Declared>({
    {"int", Held::whole, false},
    {"long", Held::whole, false},
    {"short", Held::whole, false},
    {"byte", Held::whole, false},
    {"Integer", Held::whole},
    {"Long", Held::whole},
    {"Short", Held::whole},
    {"Byte", Held::whole},
    {"BigInteger", Held::whole},
    {"double", Held::decimal, false},
    {"float", Held::decimal, false},
    {"Double", Held::decimal},
    {"Float", Held::decimal},
    {"BigDecimal", Held::decimal},
    {"Number", Held::number},
    {"String", Held::text},
    {"CharSequence", Held::text},
    {"boolean", Held::truth, false},
    {"Boolean", Held::truth},
    {"List", Held::list},
    {"ArrayList", Held::list},
    {"LinkedList", Held::list},
    {"Collection", Held::list},
    {"Set", Held::set},
    {"Map", Held::map},
    {"HashMap", Held::map},
    {"LinkedHashMap", Held::map},
    {"Closure", Held::closure},
    {"Position", Held::own_kind},
    {"Displacement", Held::own_kind},
    {"Area", Held::own_kind},
    {"Task", Held::own_kind},
    {"VehicleSet", Held::own_kind},
    {"Vehicle", Held::own_kind},
    {"Pattern", Held::own_kind},
});

Declared const* find(std::string_view type) {
  auto const* found = std::ranges::find(declared_types, type, &Declared::name);
  return found == declared_types.end() ? nullptr : found;
}

constexpr auto several = Kinds(Kind::list) | Kind::vehicles | Kind::other;

Kinds own_kind(std::string_view type) {
  if (type == "Position") return Kind::position;
  if (type == "Displacement") return Kind::displacement;
  if (type == "Area") return Kind::area;
  if (type == "Task") return Kind::task;
  return type == "Pattern" ? Kinds(Kind::other) : Kinds(Kind::vehicles);
}

bool is_several(Value const& value) {
  return value.is(ValueKind::list) || value.is(ValueKind::range) || value.is(ValueKind::vehicles);
}

std::optional<Checked<Value>> if_it_fits(Value const& value, bool fits) {
  return fits ? std::optional(Checked<Value>(value)) : std::nullopt;
}

/// The value as the type has it; nothing when it cannot be had.
std::optional<Checked<Value>> turned(Runtime& runtime, Value const& value, Declared const& type, Holder holder) {
  bool const is_passed = holder == Holder::parameter;
  switch (type.held) {
    case Held::whole:
      if (value.is(ValueKind::integer)) return value;
      if (is_passed || !value.is_number()) return std::nullopt;
      return cast(runtime, value, "long");
    case Held::decimal:
      return value.is_number() ? std::optional(Checked<Value>(Value::real(value.number()))) : std::nullopt;
    case Held::number: return if_it_fits(value, value.is_number());
    case Held::text:
      if (value.is(ValueKind::text)) return value;
      if (is_passed) return std::nullopt;
      return make_text(runtime.heap, to_text(value));
    case Held::truth:
      if (value.is(ValueKind::boolean)) return value;
      if (is_passed) return std::nullopt;
      return Value::boolean(is_true(value));
    case Held::list: return if_it_fits(value, is_several(value));
    case Held::set:
      if (!is_several(value)) return std::nullopt;
      return is_passed || value.is(ValueKind::vehicles) ? Checked<Value>(value) : cast(runtime, value, "Set");
    case Held::map: return if_it_fits(value, value.is(ValueKind::map));
    case Held::closure: return if_it_fits(value, value.is(ValueKind::closure));
    case Held::own_kind: return if_it_fits(value, is_instance(value, type.name));
  }
  return value;
}

}  // namespace

bool is_checked_type(std::string_view type) {
  return find(type) != nullptr;
}

Kinds kinds_taken(std::string_view type, Holder holder) {
  auto const* declared = find(type);
  if (!declared) return Kinds::any();
  bool const is_passed = holder == Holder::parameter;
  switch (declared->held) {
    case Held::whole: return is_passed ? Kinds(Kind::integer) | Kind::other : Kinds::number() | Kind::other;
    case Held::decimal:
    case Held::number: return Kinds::number() | Kind::other;
    case Held::text: return is_passed ? Kinds(Kind::text) | Kind::other : Kinds::any();
    case Held::truth: return is_passed ? Kinds(Kind::boolean) | Kind::other : Kinds::any();
    case Held::list:
    case Held::set: return several;
    case Held::map: return Kinds(Kind::map) | Kind::other;
    case Held::closure: return Kinds(Kind::closure) | Kind::other;
    case Held::own_kind: return own_kind(type) | Kind::other;
  }
  return Kinds::any();
}

Kinds kinds_held(std::string_view type) {
  auto const* declared = find(type);
  if (!declared) return Kinds::any();
  Kinds const null = declared->takes_null ? Kinds(Kind::other) : Kinds::none();
  switch (declared->held) {
    case Held::whole: return Kinds(Kind::integer) | null;
    case Held::decimal: return Kinds(Kind::decimal) | null;
    case Held::number: return Kinds::number() | null;
    case Held::text: return Kinds(Kind::text) | null;
    case Held::truth: return Kinds(Kind::boolean) | null;
    case Held::list:
    case Held::set: return several;
    case Held::map: return Kinds(Kind::map) | null;
    case Held::closure: return Kinds(Kind::closure) | null;
    case Held::own_kind: return own_kind(type) | null;
  }
  return Kinds::any();
}

Value value_at_first(std::string_view type) {
  auto const* declared = find(type);
  if (!declared || declared->takes_null) return {};
  if (declared->held == Held::whole) return Value::integer(0);
  return declared->held == Held::decimal ? Value::real(0.0) : Value::boolean(false);
}

Checked<Value> held(Runtime& runtime, Value const& value, std::string_view declaration, Holder holder) {
  auto const* type = find(declaration.substr(0, declaration.find(' ')));
  if (!type || (value.is_null() && type->takes_null)) return value;
  bool const is_false = value.is_null() && type->held == Held::truth && holder == Holder::variable;
  if (is_false) return Value::boolean(false);
  if (!value.is_null()) {
    if (auto made = turned(runtime, value, *type, holder)) return *std::move(made);
  }
  if (holder == Holder::parameter)
    return fault(fmt::format("{} does not take {}", declaration, kind_name(value)), "MissingMethodException");
  return fault(fmt::format("{} cannot hold {}", declaration, kind_name(value)), "ClassCastException");
}

}  // namespace lapwing::dolphin
