#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lapwing::slam {

/// The lines of a text, counted, without their line ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    auto const end = rest_.find('\n');
    is_whole_ = end != std::string_view::npos;
    auto line = rest_.substr(0, end);
    rest_.remove_prefix(is_whole_ ? end + 1 : rest_.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return line;
  }
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Whether the line ended with a line end: the last one of a recording that was cut off does not.
  [[nodiscard]] bool is_whole() const { return is_whole_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
  bool is_whole_ = true;
};

/// The words of a line, between blanks (or another separator).
class Words {
 public:
  explicit Words(std::string_view line, char separator = ' ') : rest_(line), separator_(separator) {}

  /// Empty at the end.
  [[nodiscard]] std::string_view next() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == separator_))
      rest_.remove_prefix(1);
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end] != ' ' && rest_[end] != '\t' && rest_[end] != separator_) ++end;
    auto const word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

  /// Nothing at the end, and for what is no number. "nan" and "inf" are numbers.
  [[nodiscard]] std::optional<double> number() {
    auto const word = next();
    double value = 0.0;
    auto const* end = word.data() + word.size();
    auto const [stop, fault] = std::from_chars(word.data(), end, value);
    if (word.empty() || fault != std::errc() || stop != end) return std::nullopt;
    return value;
  }
  [[nodiscard]] std::optional<double> finite() {
    auto const value = number();
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

 private:
  std::string_view rest_;
  char separator_;
};

[[nodiscard]] inline std::unexpected<base::Error> fail_at(std::size_t line, std::string const& what,
                                                          std::string hint = {}) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("line {}: {}", line, what), std::move(hint));
}

}  // namespace lapwing::slam
