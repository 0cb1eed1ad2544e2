#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ranges>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/patterns.hpp"

/// Methods of texts, with patterns and without. Lengths and positions count code points.
namespace lapwing::dolphin::internal {
namespace {

constexpr std::string_view blanks = " \t\r\n\f";

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string replaced(std::string_view text, std::string const& old, std::string const& fresh) {
  if (old.empty()) return std::string(text);
  std::string result;
  for (std::size_t at = 0;;) {
    auto const next = find_text(text, old, at);
    result += text.substr(at, next - at);
    if (next == std::string_view::npos || result.size() > max_text_size) return result;
    result += fresh;
    at = next + old.size();
  }
}

// ---- taken apart

/// As in Java: what is empty at the end is left out.
Value split_by(Call call, std::string_view text, std::string_view by) {
  std::vector<Value> parts;
  for (std::size_t at = 0;;) {
    auto const next = by.empty() ? std::string_view::npos : find_text(text, by, at);
    parts.push_back(call.text(std::string(text.substr(at, next == std::string_view::npos ? next : next - at))));
    if (next == std::string_view::npos) break;
    at = next + by.size();
  }
  while (parts.size() > 1 && parts.back().as<Text>()->text.empty()) parts.pop_back();
  return call.list(std::move(parts));
}

/// Words between any of `separators`, none of them empty.
Value words_of(Call call, std::string_view text, std::string_view separators) {
  std::vector<Value> parts;
  while (true) {
    auto const begin = text.find_first_not_of(separators);
    if (begin == std::string_view::npos) break;
    auto const end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(call.text(std::string(text.substr(begin, end - begin))));
    text.remove_prefix(end);
  }
  return call.list(std::move(parts));
}

Value split(Call call, Text const& text) {
  return call.arguments.empty() ? words_of(call, text.text, blanks) : split_by(call, text.text, call.text_argument());
}

Value tokenized(Call call, Text const& text) {
  return words_of(call, text.text, call.arguments.empty() ? std::string(blanks) : call.text_argument());
}

Value lines(Call call, Text const& text) {
  return split_by(call, replaced(text.text, "\r\n", "\n"), "\n");
}

std::string between(std::vector<std::string_view> const& pieces, std::size_t begin, std::size_t end) {
  std::string out;
  for (auto at = begin; at < end; ++at) out += pieces[at];
  return out;
}

Checked<Value> substring(Call call, Text const& text) {
  auto const pieces = code_points(text.text);
  auto const size = static_cast<std::int64_t>(pieces.size());
  auto const begin = call.integer_argument(0);
  if (!begin) return std::unexpected(begin.error());
  auto const end = call.arguments.size() > 1 ? call.integer_argument(1) : Checked<std::int64_t>(size);
  if (!end) return std::unexpected(end.error());
  if (*begin < 0 || *end > size || *begin > *end) {
    return fault(fmt::format("substring {}..<{} of a text of {}", *begin, *end, size), "IndexOutOfBoundsException");
  }
  return call.text(between(pieces, static_cast<std::size_t>(*begin), static_cast<std::size_t>(*end)));
}

/// `take` and `drop`.
Checked<Value> part_of(Call call, std::string const& text, bool takes) {
  auto const count = call.integer_argument();
  if (!count) return std::unexpected(count.error());
  auto const pieces = code_points(text);
  auto const at =
      static_cast<std::size_t>(std::clamp<std::int64_t>(*count, 0, static_cast<std::int64_t>(pieces.size())));
  return call.text(takes ? between(pieces, 0, at) : between(pieces, at, pieces.size()));
}

// ---- questions

std::size_t find_first_text(std::string const& text, std::string const& part) {
  return find_text(text, part);
}

/// Linear as `find_text` is, by looking for the reverse in the reverse.
std::size_t find_last_text(std::string const& text, std::string const& part) {
  auto const at = find_text(std::string(text.rbegin(), text.rend()), std::string(part.rbegin(), part.rend()));
  return at == std::string::npos ? at : text.size() - part.size() - at;
}

/// The code point at which the part begins; -1 when it is not there.
template <auto find>
Value position_of(Call call, Text const& text) {
  auto const at = find(text.text, call.text_argument());
  if (at == std::string::npos) return Value::integer(-1);
  return Value::integer(static_cast<std::int64_t>(count_code_points(std::string_view(text.text).substr(0, at))));
}

Value occurrences(Call call, Text const& text) {
  auto const part = call.text_argument();
  std::int64_t count = 0;
  if (part.empty()) return Value::integer(count);
  for (auto at = find_text(text.text, part); at != std::string::npos; at = find_text(text.text, part, at + part.size()))
    ++count;
  return Value::integer(count);
}

// ---- numbers in texts

std::optional<double> as_number(std::string_view text) {
  auto const number = std::string(trimmed(text));
  char* end = nullptr;
  double const parsed = std::strtod(number.c_str(), &end);
  return !number.empty() && *end == '\0' ? std::optional(parsed) : std::nullopt;
}

bool is_whole(double number) {
  return number == std::floor(number) && std::fabs(number) < 9e18;
}

Value is_integer(Call /*call*/, Text const& text) {
  auto const number = as_number(text.text);
  return Value::boolean(number && is_whole(*number));
}

Checked<Value> read_real(Call /*call*/, Text const& text) {
  auto const number = as_number(text.text);
  if (!number) return fault(fmt::format("'{}' is no number", text.text), "NumberFormatException");
  return Value::real(*number);
}

Checked<Value> read_integer(Call call, Text const& text) {
  auto const number = read_real(call, text);
  if (!number) return number;
  if (!is_whole(number->real())) return fault(fmt::format("'{}' is no integer", text.text), "NumberFormatException");
  return Value::integer(static_cast<std::int64_t>(number->real()));
}

// ---- other texts

Value capitalized(Call call, Text const& text) {
  auto const pieces = code_points(text.text);
  auto const first = text.text.substr(0, pieces.empty() ? 0 : pieces.front().size());
  return call.text(in_capitals(first) + text.text.substr(first.size()));
}

Checked<Value> replaced_text(Call call, Text const& text) {
  if (call.arguments[0].is(ValueKind::pattern))
    return fault("replace takes a text; replaceAll takes a pattern", "IllegalArgumentException");
  return call.long_text(replaced(text.text, call.text_argument(0), call.text_argument(1)));
}

template <bool at_left>
Checked<Value> padded(Call call, Text const& receiver) {
  constexpr std::int64_t widest = 10'000;
  auto const& text = receiver.text;
  auto const width = call.integer_argument();
  if (!width) return std::unexpected(width.error());
  auto const filling = call.arguments.size() > 1 ? call.text_argument(1) : std::string(" ");
  auto const size = static_cast<std::int64_t>(count_code_points(text));
  if (filling.empty() || *width > widest) {
    return fault(fmt::format("{} takes a width up to {} and a text to fill with", call.name, widest),
                 "IllegalArgumentException");
  }
  std::string pad;
  for (auto missing = *width - size; missing > 0 && pad.size() <= max_text_size; --missing) pad += filling;
  return call.long_text(at_left ? pad + text : text + pad);
}

Checked<Value> filled_in(Call call, Text const& text) {
  auto out = formatted(text.text, call.arguments);
  if (!out) return std::unexpected(out.error());
  return call.long_text(std::move(*out));
}

// ---- patterns

/// The parts between the matches; as in Java, what is empty at the end is left out.
Checked<Value> split_by_pattern(Call call, std::string_view text, RegularExpression const& by) {
  auto const matches = matches_in(by, text);
  if (!matches) return std::unexpected(matches.error());
  std::vector<Value> parts;
  std::size_t at = 0;
  for (auto const& match : *matches) {
    if (match.end == 0 || (match.begin == match.end && match.end == text.size())) continue;  // nothing stands before it
    parts.push_back(call.text(std::string(text.substr(at, match.begin - at))));
    at = match.end;
  }
  parts.push_back(call.text(std::string(text.substr(at))));
  while (parts.size() > 1 && parts.back().as<Text>()->text.empty()) parts.pop_back();
  return call.list(std::move(parts));
}

/// For `replaceAll` with a closure, which the prelude calls: what stands before a match, the match, and so on.
Checked<Value> cut_by_pattern(Call call, std::string_view text, RegularExpression const& by) {
  auto const matches = matches_in(by, text);
  if (!matches) return std::unexpected(matches.error());
  std::vector<Value> pieces;
  std::size_t at = 0;
  for (auto const& match : *matches) {
    pieces.push_back(call.text(std::string(text.substr(at, match.begin - at))));
    pieces.push_back(match_value(call.heap, match));
    at = match.end;
  }
  pieces.push_back(call.text(std::string(text.substr(at))));
  return call.list(std::move(pieces));
}

Value is_match(Call /*call*/, std::string_view text, RegularExpression const& pattern) {
  return Value::boolean(pattern.matches(text));
}

Value has_match(Call /*call*/, std::string_view text, RegularExpression const& pattern) {
  return Value::boolean(pattern.occurs_in(text));
}

Value first_in(Call call, std::string_view text, RegularExpression const& pattern) {
  auto const match = pattern.find(text, 0);
  return match ? call.text(std::string(*match->groups.front())) : Value();
}

Checked<Value> all_in(Call call, std::string_view text, RegularExpression const& pattern) {
  auto const found = matches_in(pattern, text);
  if (!found) return std::unexpected(found.error());
  std::vector<Value> all;
  for (auto const& match : *found) all.push_back(call.text(std::string(*match.groups.front())));
  return call.list(std::move(all));
}

Checked<Value> count_in(Call /*call*/, std::string_view text, RegularExpression const& pattern) {
  auto const found = matches_in(pattern, text);
  if (!found) return std::unexpected(found.error());
  return Value::integer(static_cast<std::int64_t>(found->size()));
}

MethodResult replaced_in(Call call, std::string_view text, RegularExpression const& pattern) {
  if (call.arguments[1].is(ValueKind::closure)) return std::nullopt;  // the prelude's
  return replaced(call.heap, pattern, text, call.text_argument(1), call.name == "replaceFirst");
}

enum class Reads { patterns, texts_too };

/// Calls the function when the first argument is a pattern, or a text where that is read as one.
template <auto function, Reads reads = Reads::texts_too>
MethodResult matched(Call call, Text const& text) {
  if (call.arguments.empty()) return std::nullopt;
  auto const& given = call.arguments[0];
  if (!given.is(ValueKind::pattern) && !(reads == Reads::texts_too && given.is(ValueKind::text))) return std::nullopt;
  auto const pattern = call.patterns.of(given);
  if (!pattern) return std::unexpected(pattern.error());
  return function(call, text.text, **pattern);
}

using namespace receivers;

constexpr auto table = std::to_array<MethodSpec>({
    pure({Kind::text, "length", "", Kind::integer, "How many characters.", "'name'.length()",
          of<[](Call, Text const& text) {
            return Value::integer(static_cast<std::int64_t>(count_code_points(text.text)));
          }>}),
    pure({Kind::text, "toUpperCase", "", Kind::text, "In capitals.", "'name'.toUpperCase()",
          of<[](Call call, Text const& text) { return call.text(in_capitals(text.text)); }>}),
    pure({Kind::text, "toLowerCase", "", Kind::text, "In small letters.", "'NAME'.toLowerCase()",
          of<[](Call call, Text const& text) { return call.text(in_small_letters(text.text)); }>}),
    pure({Kind::text, "startsWith", "text", Kind::boolean, "Whether it begins so.", "'harbour'.startsWith('har')",
          of<[](Call call, Text const& text) { return Value::boolean(text.text.starts_with(call.text_argument())); }>}),
    pure({Kind::text, "endsWith", "text", Kind::boolean, "Whether it ends so.", "'harbour'.endsWith('har')",
          of<[](Call call, Text const& text) { return Value::boolean(text.text.ends_with(call.text_argument())); }>}),
    pure({Kind::text, "trim", "", Kind::text, "Without blanks at the ends.", "' a b '.trim()",
          of<[](Call call, Text const& text) { return call.text(std::string(trimmed(text.text))); }>}),
    {Kind::text, "capitalize", "", Kind::text, "With a capital at its beginning.", "'name'.capitalize()",
     of<capitalized>},
    {Kind::text, "equalsIgnoreCase", "text", Kind::boolean, "Whether both are equal but for capitals.",
     "'a'.equalsIgnoreCase('A')", of<[](Call call, Text const& text) {
       return Value::boolean(in_small_letters(text.text) == in_small_letters(call.text_argument()));
     }>},
    {Kind::text, "concat", "text", Kind::text, "With the other text behind it.", "'a'.concat('b')",
     of<[](Call call, Text const& text) { return call.long_text(text.text + call.text_argument()); }>},
    {Kind::text, "padLeft", "width, filling?", Kind::text, "Filled up to a width in front.", "'7'.padLeft(3, '0')",
     of<padded<true>>},
    {Kind::text, "padRight", "width, filling?", Kind::text, "Filled up to a width behind.", "'7'.padRight(3, '.')",
     of<padded<false>>},
    {Kind::text, "format", "values...", Kind::text, "With values in the place of %d, %.2f, %s and others.",
     "'%s: %.1f m'.format('height', 12.34)", of<filled_in>},
    {Kind::text, "isNumber", "", Kind::boolean, "Whether it is a number.", "'1.5'.isNumber()",
     of<[](Call, Text const& text) { return Value::boolean(as_number(text.text).has_value()); }>},
    {Kind::text, "isInteger", "", Kind::boolean, "Whether it is a whole number.", "'1.5'.isInteger()", of<is_integer>},
    {Kind::text, "tokenize", "separators?", Kind::list, "Its words, none of them empty.", "'a, b'.tokenize(', ')",
     of<tokenized>},
    {Kind::text, "readLines", "", Kind::list, "Its lines.", "'a\\nb'.readLines()", of<lines>},
    pure({Kind::text, "split", "separator?", Kind::list, "Its parts, between a text or what fits a pattern.",
          "'a;b'.split(';')", of<matched<split_by_pattern, Reads::patterns>, split>}),
    pure({Kind::text, "replace", "old, new", Kind::text, "With one part replaced.", "'north'.replace('n', 'N')",
          of<replaced_text>}),
    {Kind::text, "matches", "pattern", Kind::boolean, "Whether all of it fits the pattern.", "'uav7'.matches(/uav\\d/)",
     of<matched<is_match>>},
    {Kind::text, "find", "pattern", any, "The first part that fits the pattern, or null.", "'uav7 ugv8'.find(/\\d/)",
     of<matched<first_in>>},
    {Kind::text, "findAll", "pattern", any, "All parts that fit the pattern.", "'uav7 ugv8'.findAll(/\\d/)",
     of<matched<all_in>>},
    written({Kind::text, "replaceAll", "pattern, text or closure", Kind::text,
             "With all that fits the pattern replaced, by a text in which $1 is the first group, or by what a closure "
             "makes of it.",
             "'uav7 ugv8'.replaceAll(/u(.)v/, '$1')", of<matched<replaced_in>>},
            R"(def replaceAll(text, pattern, f) {
  def pieces = text.cutBy(pattern)
  for (def i = 1; i < pieces.size(); i += 2) { pieces[i] = f(pieces[i]) }
  return pieces.join('')
})"),
    {Kind::text, "replaceFirst", "pattern, text", Kind::text, "The same for the first that fits.",
     "'uav7 ugv8'.replaceFirst(/u(.)v/, '$1')", of<matched<replaced_in>>},
    written({Kind::text, "eachMatch", "pattern, closure", any, "Calls the closure with all that fits the pattern.", ""},
            R"(def eachMatch(text, pattern, f) {
  for (match in text =~ pattern) { f(match) }
  return text
})"),
    pure({Kind::text, "substring", "from, to?", Kind::text, "A part of it.", "'harbour'.substring(0, 3)",
          of<substring>}),
    pure({Kind::text, "indexOf", "text", Kind::integer, "Where the part begins, or -1.", "'harbour'.indexOf('bo')",
          of<position_of<find_first_text>>}),
    {Kind::text, "lastIndexOf", "text", Kind::integer, "Where the part begins last, or -1.",
     "'harbour'.lastIndexOf('r')", of<position_of<find_last_text>>},
    {Kind::text, "count", "text", Kind::integer, "How often the text, or what fits a pattern, is in it.",
     "'harbour'.count('r')", of<matched<count_in, Reads::patterns>, occurrences>},
    pure({Kind::text | number, "toInteger", "", Kind::integer, "As an integer.", "'42'.toInteger()",
          of<read_integer, as_integer>}),
    pure({Kind::text | number, "toDouble", "", Kind::decimal, "As a decimal.", "'1.5'.toDouble()",
          of<read_real, as_real>}),
    {Kind::text | number, "toFloat", "", Kind::decimal, "As a decimal.", "", of<read_real, as_real>},
    {Kind::text, "toLong", "", Kind::integer, "As an integer.", "", of<read_integer>},
    {Kind::text, "toBigDecimal", "", Kind::decimal, "As a decimal.", "", of<read_real>},
});

}  // namespace

MethodResult contains_text(Call call, Text const& text) {
  if (call.arguments[0].is(ValueKind::pattern)) return matched<has_match>(call, text);
  return Value::boolean(find_text(text.text, call.text_argument()) != std::string::npos);
}

Checked<Value> take_text(Call call, Text const& text) {
  return part_of(call, text.text, true);
}

Checked<Value> drop_text(Call call, Text const& text) {
  return part_of(call, text.text, false);
}

Value reversed_text(Call call, Text const& text) {
  std::string out;
  for (auto const piece : code_points(text.text) | std::views::reverse) out += piece;
  return call.text(std::move(out));
}

Value letters(Call call, Text const& text) {
  std::vector<Value> out;
  for (auto const piece : code_points(text.text)) out.push_back(call.text(std::string(piece)));
  return call.list(std::move(out));
}

MethodResult cut_text(Call call, Text const& text) {
  return matched<cut_by_pattern>(call, text);
}

std::span<MethodSpec const> text_methods() {
  return table;
}

}  // namespace lapwing::dolphin::internal
