#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "dolphin/builtin/method_lists.hpp"
#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"

/// Methods of texts. Lengths and positions count code points.
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

/// As in Java: what is empty at the end is left out.
Value split(MethodCall const& call, std::string_view text, std::string_view by) {
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
Value tokenized(MethodCall const& call, std::string_view text, std::string_view separators) {
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

std::string between(std::vector<std::string_view> const& pieces, std::size_t begin, std::size_t end) {
  std::string out;
  for (auto at = begin; at < end; ++at) out += pieces[at];
  return out;
}

Checked<Value> substring(MethodCall const& call, std::string const& text) {
  auto const pieces = code_points(text);
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
Checked<Value> part(MethodCall const& call, std::string const& text, bool takes) {
  auto const count = call.integer_argument();
  if (!count) return std::unexpected(count.error());
  auto const pieces = code_points(text);
  auto const at =
      static_cast<std::size_t>(std::clamp<std::int64_t>(*count, 0, static_cast<std::int64_t>(pieces.size())));
  return call.text(takes ? between(pieces, 0, at) : between(pieces, at, pieces.size()));
}

Checked<Value> padded(MethodCall const& call, std::string const& text, bool at_left) {
  constexpr std::int64_t widest = 10'000;
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

/// Linear as `find_text` is, by looking for the reverse in the reverse.
std::size_t find_last_text(std::string const& text, std::string const& part) {
  auto const at = find_text(std::string(text.rbegin(), text.rend()), std::string(part.rbegin(), part.rend()));
  return at == std::string::npos ? at : text.size() - part.size() - at;
}

/// The code point at which `part` begins; -1 when it is not there.
Value position_of(std::string const& text, std::string const& part, bool from_end) {
  auto const at = from_end ? find_last_text(text, part) : find_text(text, part);
  if (at == std::string::npos) return Value::integer(-1);
  return Value::integer(static_cast<std::int64_t>(count_code_points(std::string_view(text).substr(0, at))));
}

std::int64_t occurrences(std::string const& text, std::string const& part) {
  std::int64_t count = 0;
  if (part.empty()) return count;
  for (auto at = find_text(text, part); at != std::string::npos; at = find_text(text, part, at + part.size())) ++count;
  return count;
}

std::optional<double> as_number(std::string_view text) {
  auto const number = std::string(trimmed(text));
  char* end = nullptr;
  double const parsed = std::strtod(number.c_str(), &end);
  return !number.empty() && *end == '\0' ? std::optional(parsed) : std::nullopt;
}

MethodResult number_in_text(MethodCall const& call, std::string const& text) {
  if (!call.arguments.empty()) return std::nullopt;
  bool const to_integer = call.name == "toInteger" || call.name == "toLong";
  bool const to_real = call.name == "toDouble" || call.name == "toFloat" || call.name == "toBigDecimal";
  bool const asks = call.name == "isNumber" || call.name == "isInteger";
  if (!to_integer && !to_real && !asks) return std::nullopt;
  auto const number = as_number(text);
  bool const is_whole = number && *number == std::floor(*number) && std::fabs(*number) < 9e18;
  if (asks) return Value::boolean(call.name == "isNumber" ? number.has_value() : is_whole);
  if (!number) return fault(fmt::format("'{}' is no number", text), "NumberFormatException");
  if (to_real) return Value::real(*number);
  if (!is_whole) return fault(fmt::format("'{}' is no integer", text), "NumberFormatException");
  return Value::integer(static_cast<std::int64_t>(*number));
}

MethodResult question(MethodCall const& call, std::string const& text) {
  if (call.is("length", 0) || call.is("size", 0)) {
    return Value::integer(static_cast<std::int64_t>(count_code_points(text)));
  }
  if (call.is("isEmpty", 0)) return Value::boolean(text.empty());
  if (call.is("contains", 1)) return Value::boolean(find_text(text, call.text_argument()) != std::string::npos);
  if (call.is("startsWith", 1)) return Value::boolean(text.starts_with(call.text_argument()));
  if (call.is("endsWith", 1)) return Value::boolean(text.ends_with(call.text_argument()));
  if (call.is("indexOf", 1)) return position_of(text, call.text_argument(), false);
  if (call.is("lastIndexOf", 1)) return position_of(text, call.text_argument(), true);
  if (call.is("count", 1)) return Value::integer(occurrences(text, call.text_argument()));
  if (call.is("equalsIgnoreCase", 1)) {
    return Value::boolean(in_small_letters(text) == in_small_letters(call.text_argument()));
  }
  return number_in_text(call, text);
}

MethodResult changed_text(MethodCall const& call, std::string const& text) {
  if (call.is("toUpperCase", 0)) return call.text(in_capitals(text));
  if (call.is("toLowerCase", 0)) return call.text(in_small_letters(text));
  if (call.is("capitalize", 0)) {
    auto const first = text.substr(0, code_points(text).empty() ? 0 : code_points(text).front().size());
    return call.text(in_capitals(first) + text.substr(first.size()));
  }
  if (call.is("trim", 0)) return call.text(std::string(trimmed(text)));
  if (call.is("replace", 2)) return call.long_text(replaced(text, call.text_argument(0), call.text_argument(1)));
  if (call.is("concat", 1)) return call.long_text(text + call.text_argument());
  if (call.is("substring", 1) || call.is("substring", 2)) return substring(call, text);
  if (call.is("take", 1) || call.is("drop", 1)) return part(call, text, call.name == "take");
  if (call.is("padLeft", 1) || call.is("padLeft", 2)) return padded(call, text, true);
  if (call.is("padRight", 1) || call.is("padRight", 2)) return padded(call, text, false);
  if (call.is("reverse", 0)) {
    std::string out;
    for (auto const piece : code_points(text) | std::views::reverse) out += piece;
    return call.text(std::move(out));
  }
  if (call.name == "format") {
    auto out = formatted(text, call.arguments);
    if (!out) return std::unexpected(out.error());
    return call.long_text(std::move(*out));
  }
  return std::nullopt;
}

}  // namespace

MethodResult text_method(MethodCall const& call, std::string const& text) {
  if (auto result = pattern_method(call, text)) return result;
  if (auto result = question(call, text)) return result;
  if (auto result = changed_text(call, text)) return result;
  if (call.is("split", 0)) return tokenized(call, text, blanks);
  if (call.is("split", 1)) return split(call, text, call.text_argument());
  if (call.is("tokenize", 0)) return tokenized(call, text, blanks);
  if (call.is("tokenize", 1)) return tokenized(call, text, call.text_argument());
  if (call.is("readLines", 0)) return split(call, replaced(text, "\r\n", "\n"), "\n");
  if (call.is("toList", 0)) {
    std::vector<Value> letters;
    for (auto const piece : code_points(text)) letters.push_back(call.text(std::string(piece)));
    return call.list(std::move(letters));
  }
  if (call.is("emptyLike", 0)) return call.list({});
  return std::nullopt;
}

}  // namespace lapwing::dolphin::internal
