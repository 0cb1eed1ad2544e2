#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/patterns.hpp"
#include "dolphin/value/text.hpp"

/// Methods that need no closure, by the kind of their receiver. Those that take closures are in the prelude.
namespace lapwing::dolphin::internal {

/// Nothing: the receiver has no such method.
using MethodResult = std::optional<Checked<Value>>;

/// One call: what it is about and what it was given.
struct MethodCall {
  Heap& heap;
  Patterns& patterns;
  std::string_view name;
  Arguments arguments;

  [[nodiscard]] bool is(std::string_view wanted, std::size_t count) const {
    return name == wanted && arguments.size() == count;
  }
  [[nodiscard]] Value text(std::string value) const { return Value(heap.make<Text>(std::move(value))); }
  /// A text that may have become too long.
  [[nodiscard]] Checked<Value> long_text(std::string value) const { return make_text(heap, std::move(value)); }
  [[nodiscard]] std::string text_argument(std::size_t index = 0) const { return to_text(arguments[index]); }
  /// The argument as an integer; a fault that names the method when it is none.
  [[nodiscard]] Checked<std::int64_t> integer_argument(std::size_t index = 0) const;
  [[nodiscard]] Value list(std::vector<Value> items) const { return Value(heap.make<List>(std::move(items))); }
};

/// `text.matches(/x+/)` and others that take a pattern.
[[nodiscard]] MethodResult pattern_method(MethodCall const& call, std::string const& text);
[[nodiscard]] MethodResult text_method(MethodCall const& call, std::string const& text);
[[nodiscard]] MethodResult list_method(MethodCall const& call, List& list);
[[nodiscard]] MethodResult map_method(MethodCall const& call, Map& map);
[[nodiscard]] MethodResult range_method(MethodCall const& call, Range& range);

/// As java.util.Formatter: "%.2f m, %5d, %-8s, %x, %%".
[[nodiscard]] Checked<std::string> formatted(std::string_view pattern, Arguments arguments);

}  // namespace lapwing::dolphin::internal
