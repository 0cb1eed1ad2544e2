#pragma once

#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "dolphin/value/fault.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/regular_expression.hpp"

/// What scripts do with regular expressions: `=~`, `==~`, and methods of texts that take a pattern.
namespace lapwing::dolphin {

using Expression = std::shared_ptr<RegularExpression const>;

/// The patterns of one run, so that a loop does not read the same text again and again.
class Patterns {
 public:
  /// Of a pattern, or of a text that is read as one.
  [[nodiscard]] Checked<Expression> of(Value const& value);

 private:
  std::deque<Expression> lately_;  ///< of texts
};

/// `~text`
[[nodiscard]] Checked<Value> make_pattern(Heap& heap, Patterns& patterns, Value const& text);

/// All places of the text that fit, one behind the other; a fault when that would take too long.
[[nodiscard]] Checked<std::vector<RegularExpression::Match>> matches_in(RegularExpression const& expression,
                                                                        std::string_view text);
/// A match as scripts see it: a text, or the list of it and its groups when the expression has groups.
[[nodiscard]] Value match_value(Heap& heap, RegularExpression::Match const& match);

/// `text =~ pattern`: the list of what fits.
[[nodiscard]] Checked<Value> found_in(Heap& heap, RegularExpression const& expression, std::string_view text);

/// The text with all matches replaced, or the first alone. `$1` in the replacement is the first group, `\$` a dollar
/// sign.
[[nodiscard]] Checked<Value> replaced(Heap& heap, RegularExpression const& expression, std::string_view text,
                                      std::string_view replacement, bool only_first);

}  // namespace lapwing::dolphin
