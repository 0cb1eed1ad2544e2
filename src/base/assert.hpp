#pragma once

#include <charconv>
#include <chrono>
#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

/// `LAPWING_ASSERT(cond, values...)`: a contract between two parts of this program, checked in every build. When it
/// does not hold, the condition, the values and the place go to standard error and the process aborts.
///
/// For what only a mistake in the source can break: a precondition that a comment states and whose breach would leave
/// the rest undefined. Never for what comes from outside (messages, files, scripts, people): those are `Result` and
/// `Diagnostics`, because an abort takes the ground station away from everything that flies (what that means for the
/// vehicles: docs/adr/0011-a-broken-contract-ends-the-process.md). Not in the innermost loops.
#define LAPWING_ASSERT(cond, ...)                                                               \
  (static_cast<bool>(cond)                                                                      \
       ? static_cast<void>(0)                                                                   \
       : ::lapwing::base::internal::assertion_failed({#cond, #__VA_ARGS__, __FILE__, __LINE__}, \
                                                     ::lapwing::base::internal::texts_of(__VA_ARGS__)))

namespace lapwing::base::internal {

struct Assertion {
  char const* condition;
  char const* names;  ///< the values as the source has them, with commas between
  char const* file;
  int line;
};

template <class T>
concept HasToString = requires(T const& value) {
  { to_string(value) } -> std::convertible_to<std::string_view>;
};

/// What a value looks like to people; no formatting library, as headers that everything includes use this.
template <class T>
std::string text_of(T const& value) {
  if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    char digits[64];
    auto const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    return {digits, end};
  } else if constexpr (std::convertible_to<T const&, std::string_view>) {
    std::string text = "'";
    return text.append(std::string_view(value)).append("'");
  } else if constexpr (HasToString<T>) {
    return std::string(std::string_view(to_string(value)));
  } else if constexpr (std::is_enum_v<T>) {
    return text_of(static_cast<long long>(value));
  } else if constexpr (std::is_pointer_v<T>) {
    return value ? "not null" : "null";
  } else if constexpr (requires { value.time_since_epoch(); }) {
    return text_of(value.time_since_epoch());
  } else {
    return text_of(std::chrono::duration<double>(value).count()) + " s";
  }
}

/// One text a value, with line breaks between.
template <class... T>
std::string texts_of(T const&... values) {
  std::string all;
  ((all += text_of(values), all += '\n'), ...);
  return all;
}

[[noreturn]] void assertion_failed(Assertion assertion, std::string const& values);

}  // namespace lapwing::base::internal
