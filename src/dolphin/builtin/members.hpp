#pragma once

#include <optional>
#include <string_view>

#include "dolphin/builtin/natives.hpp"

/// What stands after a point: properties and methods of values, static members and constructors of types.
namespace lapwing::dolphin {

[[nodiscard]] Checked<Value> member(Runtime& runtime, Value const& object, std::string_view name);
[[nodiscard]] Checked<void> set_member(Runtime& runtime, Value const& object, std::string_view name, Value value);

/// Nothing when values of this kind have no such method here; the prelude may have it.
[[nodiscard]] std::optional<Checked<Value>> call_method(Runtime& runtime, Value const& object, std::string_view name,
                                                        Arguments arguments);

/// A property of the table of methods; nothing when values of this kind have none of that name.
[[nodiscard]] std::optional<Checked<Value>> property(Runtime& runtime, Value const& object, std::string_view name);

/// The type of the value, as `getClass()` and, but for maps, `class` give it.
[[nodiscard]] Value type_of(Heap& heap, Value const& value);

/// "Math.abs", "System.currentTimeMillis", "Position.fromDegrees".
[[nodiscard]] Checked<Value> call_static(Runtime& runtime, Fiber& fiber, std::string_view name, Arguments arguments);
/// `new T(arguments)`
[[nodiscard]] Checked<Value> construct(Runtime& runtime, std::string_view type, Arguments arguments, int line);
/// `x as T`
[[nodiscard]] Checked<Value> cast(Runtime& runtime, Value const& value, std::string_view type);
/// `x instanceof T`; of exceptions also `catch (T e)`.
[[nodiscard]] bool is_instance(Value const& value, std::string_view type);

}  // namespace lapwing::dolphin
