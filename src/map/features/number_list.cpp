#include "map/features/number_list.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace lapwing::map {

namespace {

/// Calls `read(word)` for each word until it says false; whether none did.
template <class Read>
bool for_each_word(std::string_view text, Read read) {
  constexpr std::string_view blanks = " \t\r\n";
  for (auto begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    auto const end = text.find_first_of(blanks, begin);
    if (!read(text.substr(begin, end - begin))) return false;
    begin = text.find_first_not_of(blanks, end);
  }
  return true;
}

template <class Number>
std::optional<Number> whole(std::string_view text) {
  Number value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Not over a real number, which has no nanoseconds any more after a few months.
std::optional<base::Duration> duration_of(std::string_view word) {
  bool const is_negative = word.starts_with('-');
  if (is_negative) word.remove_prefix(1);
  auto const point = word.find('.');
  auto const seconds = whole<std::uint32_t>(word.substr(0, point));
  constexpr std::uint32_t most_seconds =
      1'000'000'000U;  // 31 years: a sane time and such a span make a time that 64 bits hold
  if (!seconds || *seconds > most_seconds) return std::nullopt;
  std::string decimals(point == std::string_view::npos ? "0" : word.substr(point + 1));
  if (decimals.empty() || decimals.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  decimals.resize(9, '0');
  auto const duration = std::chrono::seconds(*seconds) + base::Duration(*whole<std::int64_t>(decimals));
  return is_negative ? -duration : duration;
}

}  // namespace

std::string text_of(std::span<double const> numbers) {
  fmt::memory_buffer text;
  for (auto const number : numbers) fmt::format_to(std::back_inserter(text), "{}{}", text.size() ? " " : "", number);
  return fmt::to_string(text);
}

std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  bool const all = for_each_word(text, [&](std::string_view word) {
    auto const number = whole<double>(word);
    if (number) numbers.push_back(*number);
    return number && std::isfinite(*number);
  });
  return all ? std::optional(std::move(numbers)) : std::nullopt;
}

std::string text_of(std::span<base::Duration const> durations) {
  std::string text;
  for (auto const duration : durations) {
    auto const length = std::chrono::abs(duration);
    auto const seconds = std::chrono::floor<std::chrono::seconds>(length);
    if (!text.empty()) text += ' ';
    if (duration < base::Duration::zero()) text += '-';
    text += fmt::format("{}.{:09}", seconds.count(), (length - seconds).count());
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
  }
  return text;
}

std::optional<std::vector<base::Duration>> durations_of(std::string_view text) {
  std::vector<base::Duration> durations;
  bool const all = for_each_word(text, [&](std::string_view word) {
    auto const duration = duration_of(word);
    if (duration) durations.push_back(*duration);
    return duration.has_value();
  });
  return all ? std::optional(std::move(durations)) : std::nullopt;
}

}  // namespace lapwing::map
