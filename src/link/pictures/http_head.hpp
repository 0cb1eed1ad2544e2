#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

/// Of the heads of HTTP answers and of their parts, as others send them. Pure.
namespace lapwing::link::pictures {

inline constexpr std::string_view end_of_head = "\r\n\r\n";
inline constexpr std::string_view end_of_line = "\r\n";

/// The value of a header, without the blanks before it; nothing where there is none.
[[nodiscard]] std::optional<std::string_view> header(std::string_view head, std::string_view name);

/// What a stranger says, as it may be shown.
[[nodiscard]] std::string printable(std::string_view text);

/// A number and nothing else.
template <class Number>
[[nodiscard]] std::optional<Number> number_of(std::optional<std::string_view> text) {
  Number number{};
  if (!text) return std::nullopt;
  auto const [end, fault] = std::from_chars(text->data(), text->data() + text->size(), number);
  return fault == std::errc{} && end == text->data() + text->size() ? std::optional(number) : std::nullopt;
}

}  // namespace lapwing::link::pictures
