#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace re2 {
class RE2;
}

namespace lapwing::dolphin {

/// A regular expression that is found in linear time, whatever it says (by RE2): no script can hang the program with
/// one. That is why there are no back references and no look-ahead.
class RegularExpression {
 public:
  /// The expression, or what is wrong with it.
  [[nodiscard]] static std::expected<std::shared_ptr<RegularExpression const>, std::string> make(std::string text);
  ~RegularExpression();
  RegularExpression(RegularExpression const&) = delete;
  RegularExpression& operator=(RegularExpression const&) = delete;

  /// As it was written.
  [[nodiscard]] std::string const& text() const { return text_; }
  /// How many pairs of parentheses take what they fit.
  [[nodiscard]] std::size_t groups() const;
  /// What an expression holds in memory, at most.
  static constexpr std::size_t most_bytes = std::size_t{512} << 10U;

  /// The whole text fits.
  [[nodiscard]] bool matches(std::string_view text) const;
  /// A part of the text fits.
  [[nodiscard]] bool occurs_in(std::string_view text) const;

  struct Match {
    std::size_t begin;
    std::size_t end;
    std::vector<std::optional<std::string_view>> groups;  ///< the whole first; nothing for those that took no part
  };
  /// The first place at or behind `from` that fits.
  [[nodiscard]] std::optional<Match> find(std::string_view text, std::size_t from) const;

 private:
  RegularExpression(std::string text, std::unique_ptr<re2::RE2> machine);

  std::string text_;
  std::unique_ptr<re2::RE2> machine_;
};

}  // namespace lapwing::dolphin
