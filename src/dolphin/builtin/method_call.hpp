#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/patterns.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {

/// Nothing: the receiver has no such method.
using MethodResult = std::optional<Checked<Value>>;

/// One call of a method: what it was given and what it may make values with.
struct MethodCall {
  Runtime& runtime;
  Heap& heap;
  Patterns& patterns;
  std::string_view name;
  Arguments arguments;

  [[nodiscard]] Value text(std::string value) const { return Value(heap.make<Text>(std::move(value))); }
  /// A text that may have become too long.
  [[nodiscard]] Checked<Value> long_text(std::string value) const { return make_text(heap, std::move(value)); }
  [[nodiscard]] std::string text_argument(std::size_t index = 0) const { return to_text(arguments[index]); }
  /// The argument as an integer; a fault that names the method when it is none.
  [[nodiscard]] Checked<std::int64_t> integer_argument(std::size_t index = 0) const;
  [[nodiscard]] Value list(std::vector<Value> items) const { return Value(heap.make<List>(std::move(items))); }
};

namespace internal {

/// As java.util.Formatter: "%.2f m, %5d, %-8s, %x, %%".
[[nodiscard]] Checked<std::string> formatted(std::string_view pattern, Arguments arguments);

}  // namespace internal
}  // namespace lapwing::dolphin
