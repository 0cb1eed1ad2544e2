#include <string>
#include <utility>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/value/patterns.hpp"

/// Methods of texts that take a pattern.
namespace lapwing::dolphin::internal {

namespace {

/// The parts between the matches; as in Java, what is empty at the end is left out.
Checked<Value> split_by(Call call, std::string_view text, RegularExpression const& by) {
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
Checked<Value> cut_by(Call call, std::string_view text, RegularExpression const& by) {
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

Checked<Value> replaced_in(Call call, std::string_view text, RegularExpression const& pattern) {
  return replaced(call.heap, pattern, text, call.text_argument(1), call.name == "replaceFirst");
}

/// Calls the function when the first argument is a pattern, or a text that may be read as one.
template <auto function>
MethodResult with_pattern(Call call, Text const& text, bool reads_text) {
  auto const& given = call.arguments[0];
  if (!given.is(ValueKind::pattern) && !(reads_text && given.is(ValueKind::text))) return std::nullopt;
  auto const pattern = call.patterns.of(given);
  if (!pattern) return std::unexpected(pattern.error());
  return function(call, text.text, **pattern);
}

}  // namespace

MethodResult matches(Call call, Text const& text) {
  return with_pattern<is_match>(call, text, true);
}

MethodResult first_match(Call call, Text const& text) {
  return with_pattern<first_in>(call, text, true);
}

MethodResult all_matches(Call call, Text const& text) {
  return with_pattern<all_in>(call, text, true);
}

MethodResult replaced_matches(Call call, Text const& text) {
  if (call.arguments[1].is(ValueKind::closure)) return std::nullopt;  // the prelude's
  return with_pattern<replaced_in>(call, text, true);
}

MethodResult cut_by_matches(Call call, Text const& text) {
  return with_pattern<cut_by>(call, text, true);
}

MethodResult contains_match(Call call, Text const& text) {
  return with_pattern<has_match>(call, text, false);
}

MethodResult count_matches(Call call, Text const& text) {
  return with_pattern<count_in>(call, text, false);
}

/// Without a separator it is split at blanks.
MethodResult split_by_matches(Call call, Text const& text) {
  if (call.arguments.empty()) return std::nullopt;
  return with_pattern<split_by>(call, text, false);
}

}  // namespace lapwing::dolphin::internal
