#include "dolphin/value/patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/text.hpp"

namespace lapwing::dolphin {

namespace {

constexpr std::size_t most_remembered = 32;

/// Appends the replacement of one match.
Checked<void> append_replacement(std::string& out, std::string_view replacement,
                                 RegularExpression::Match const& match) {
  for (std::size_t at = 0; at < replacement.size(); ++at) {
    auto const c = replacement[at];
    bool const is_last = at + 1 == replacement.size();
    if (c == '\\' && !is_last) {
      out += replacement[++at];
    } else if (c == '$') {
      if (is_last || !std::isdigit(static_cast<unsigned char>(replacement[at + 1])))
        return fault("a $ in a replacement stands before the number of a group; write \\$ for the sign",
                     "IllegalArgumentException");
      auto const group = static_cast<std::size_t>(replacement[++at] - '0');
      if (group >= match.groups.size())
        return fault(fmt::format("the pattern has no group {}", group), "IndexOutOfBoundsException");
      out += match.groups[group].value_or("");
    } else {
      out += c;
    }
  }
  return {};
}

}  // namespace

Checked<Expression> Patterns::of(Value const& value) {
  if (auto const* pattern = value.as<PatternValue>()) return pattern->value;
  auto const* text = value.as<Text>();
  if (!text) return fault(fmt::format("a pattern is needed here, not {}", kind_name(value)), "MissingMethodException");
  auto const known = std::ranges::find_if(lately_, [&](Expression const& one) { return one->text() == text->text; });
  if (known != lately_.end()) return *known;
  auto made = RegularExpression::make(text->text);
  if (!made) return fault(fmt::format("this is no pattern: {}", made.error()), "PatternSyntaxException");
  lately_.push_back(*made);
  if (lately_.size() > most_remembered) lately_.pop_front();
  return *std::move(made);
}

Checked<Value> make_pattern(Heap& heap, Patterns& patterns, Value const& text) {
  if (text.as<PatternValue>()) return text;
  auto expression = patterns.of(text);
  if (!expression) return std::unexpected(expression.error());
  return Value(heap.make<PatternValue>(*std::move(expression)));
}

Checked<std::vector<RegularExpression::Match>> matches_in(RegularExpression const& expression, std::string_view text) {
  std::vector<RegularExpression::Match> out;
  std::size_t looked_at = 0;
  for (std::size_t at = 0; at <= text.size();) {
    looked_at += text.size() - at;
    if (looked_at > max_matched_bytes) return fault("the text has too many matches for its length", "OutOfMemoryError");
    auto match = expression.find(text, at);
    if (!match) break;
    at = match->end;
    if (match->begin == match->end) at += at < text.size() ? first_code_point_size(text.substr(at)) : 1;
    out.push_back(*std::move(match));
  }
  return out;
}

Value match_value(Heap& heap, RegularExpression::Match const& match) {
  auto const text = [&](std::optional<std::string_view> part) {
    return part ? Value(heap.make<Text>(std::string(*part))) : Value();
  };
  if (match.groups.size() == 1) return text(match.groups.front());
  auto list = heap.make<List>();
  for (auto const& group : match.groups) list->push(text(group));
  return Value(list);
}

Checked<Value> found_in(Heap& heap, RegularExpression const& expression, std::string_view text) {
  auto const matches = matches_in(expression, text);
  if (!matches) return std::unexpected(matches.error());
  auto list = heap.make<List>();
  for (auto const& match : *matches) list->push(match_value(heap, match));
  return Value(list);
}

Checked<Value> replaced(Heap& heap, RegularExpression const& expression, std::string_view text,
                        std::string_view replacement, bool only_first) {
  auto const matches = matches_in(expression, text);
  if (!matches) return std::unexpected(matches.error());
  std::string out;
  std::size_t at = 0;
  for (auto const& match : *matches) {
    out += text.substr(at, match.begin - at);
    if (auto const done = append_replacement(out, replacement, match); !done) return std::unexpected(done.error());
    at = match.end;
    if (only_first || out.size() > max_text_size) break;
  }
  out += text.substr(at);
  return make_text(heap, std::move(out));
}

}  // namespace lapwing::dolphin
