#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "dolphin/builtin/method_call.hpp"
#include "dolphin/names/signatures.hpp"
#include "dolphin/value/operators.hpp"

/// How rows of the table of methods are written, and their parts by topic: each row stands beside the functions that
/// carry it out. A function says by its second parameter which receivers it is for; `of` takes one for each kind of
/// them.
namespace lapwing::dolphin::internal {

using Call = MethodCall const&;
/// The receiver of what both kinds of numbers have.
struct Number {
  Value const& value;
};

/// What every file of methods has: rows in the order of the reference.
[[nodiscard]] std::span<MethodSpec const> walking_methods();
[[nodiscard]] std::span<MethodSpec const> list_methods();
[[nodiscard]] std::span<MethodSpec const> text_methods();
[[nodiscard]] std::span<MethodSpec const> value_methods();
/// Those that the prelude alone calls.
[[nodiscard]] std::span<MethodSpec const> prelude_methods();

/// A method whose function is written in the language itself.
[[nodiscard]] constexpr MethodSpec written(MethodSpec method, std::string_view source) {
  method.source = source;
  return method;
}
/// A method that may stand in the answer to `ask`.
[[nodiscard]] constexpr MethodSpec pure(MethodSpec method) {
  method.is_pure = true;
  return method;
}
[[nodiscard]] constexpr MethodSpec property(Kinds receiver, std::string_view name, Kinds result, std::string_view doc,
                                            std::string_view example, MethodFunction call) {
  return {receiver, name, "", result, doc, example, call, "", true};
}

template <class Result, class T>
T receiver_of(Result (*)(Call, T&));

template <auto function>
MethodResult called(Call call, Value const& object) {
  using T = std::remove_const_t<decltype(receiver_of(+function))>;
  if constexpr (std::is_same_v<T, Value>) {
    return function(call, object);
  } else if constexpr (std::is_same_v<T, Number>) {
    if (!object.is_number()) return std::nullopt;
    return function(call, Number{object});
  } else {
    auto* const receiver = object.as<T>();
    if (!receiver) return std::nullopt;
    return function(call, *receiver);
  }
}

/// The first of the functions that is for the receiver and these arguments.
template <auto function, auto... others>
MethodResult of(Call call, Value const& object) {
  if constexpr (sizeof...(others) == 0) {
    return called<function>(call, object);
  } else {
    auto result = called<function>(call, object);
    return result ? std::move(result) : of<others...>(call, object);
  }
}

enum class Shared {
  with_ranges,  ///< the list of a range's values has it, too
  with_sets,    ///< and that of a set's vehicles
  as_parts,     ///< and what it leaves of a set is a set
};
[[nodiscard]] MethodResult shared_method(Call call, Value const& object, Shared with, MethodFunction function);

/// A function of lists that ranges have, too.
template <auto function>
MethodResult listed(Call call, Value const& object) {
  return shared_method(call, object, Shared::with_ranges, called<function>);
}

/// A function of lists that ranges and sets of vehicles have, too.
template <auto function>
MethodResult in_order(Call call, Value const& object) {
  return shared_method(call, object, Shared::with_sets, called<function>);
}

/// The same for what leaves out or moves values: of a set it gives a set.
template <auto function>
MethodResult part(Call call, Value const& object) {
  return shared_method(call, object, Shared::as_parts, called<function>);
}

template <class T>
Checked<Value> holds(Call call, T& container) {
  auto const found = contains(Value(&container), call.arguments[0]);
  if (!found) return std::unexpected(found.error());
  return Value::boolean(*found);
}

// For rows that texts or numbers share with others.
[[nodiscard]] MethodResult contains_text(Call call, Text const& text);
[[nodiscard]] Checked<Value> take_text(Call call, Text const& text);
[[nodiscard]] Checked<Value> drop_text(Call call, Text const& text);
[[nodiscard]] Value reversed_text(Call call, Text const& text);
[[nodiscard]] Value letters(Call call, Text const& text);
/// What stands before a match, the match, and so on.
[[nodiscard]] MethodResult cut_text(Call call, Text const& text);
[[nodiscard]] Checked<Value> as_integer(Call call, Number const& number);
[[nodiscard]] Value as_real(Call call, Number const& number);

/// An operator by its name: `a.plus(b)`.
template <ast::BinaryOp operation>
Checked<Value> by_operator(Call call, Value const& left) {
  return apply(call.heap, operation, left, call.arguments[0], {});
}

}  // namespace lapwing::dolphin::internal

/// Of whom a method is.
namespace lapwing::dolphin::receivers {

inline constexpr auto any = Kinds::any();
inline constexpr auto number = Kinds::number();
inline constexpr auto lists = Kinds(Kind::list);
inline constexpr auto ranged = lists | Kind::other;  // ranges
inline constexpr auto ordered = ranged | Kind::vehicles;
inline constexpr auto parts = ordered | Kind::text;
inline constexpr auto many = ordered | Kind::map;
inline constexpr auto walked = many | Kind::text;
inline constexpr auto joined = lists | number | Kind::text | Kind::map | Kind::vehicles | Kind::position | Kind::other;

}  // namespace lapwing::dolphin::receivers
