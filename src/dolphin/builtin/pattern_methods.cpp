#include <string>
#include <utility>

#include "dolphin/builtin/method_lists.hpp"
#include "dolphin/value/patterns.hpp"

/// Methods of texts that take a pattern.
namespace lapwing::dolphin::internal {

namespace {

/// The parts between the matches; as in Java, what is empty at the end is left out.
Checked<Value> split_by(MethodCall const& call, std::string_view text, RegularExpression const& by) {
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
Checked<Value> cut_by(MethodCall const& call, std::string_view text, RegularExpression const& by) {
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

Checked<Value> with_pattern(MethodCall const& call, std::string const& text, RegularExpression const& pattern) {
  if (call.name == "matches") return Value::boolean(pattern.matches(text));
  if (call.name == "contains") return Value::boolean(pattern.occurs_in(text));
  if (call.name == "split") return split_by(call, text, pattern);
  if (call.name == "cutBy") return cut_by(call, text, pattern);
  if (call.name == "replaceAll" || call.name == "replaceFirst") {
    return replaced(call.heap, pattern, text, call.text_argument(1), call.name == "replaceFirst");
  }
  if (call.name == "find") {
    auto const match = pattern.find(text, 0);
    return match ? call.text(std::string(*match->groups.front())) : Value();
  }
  auto const matches = matches_in(pattern, text);
  if (!matches) return std::unexpected(matches.error());
  if (call.name == "count") return Value::integer(static_cast<std::int64_t>(matches->size()));
  std::vector<Value> all;
  for (auto const& match : *matches) all.push_back(call.text(std::string(*match.groups.front())));
  return call.list(std::move(all));
}

}  // namespace

MethodResult pattern_method(MethodCall const& call, std::string const& text) {
  if (call.arguments.empty()) return std::nullopt;
  bool const has_pattern = call.arguments[0].is(ValueKind::pattern);
  bool const has_text = call.arguments[0].is(ValueKind::text);
  if (!has_pattern && !has_text) return std::nullopt;
  bool const replaces =
      (call.is("replaceAll", 2) || call.is("replaceFirst", 2)) && !call.arguments[1].is(ValueKind::closure);
  bool const reads_text =
      replaces || call.is("matches", 1) || call.is("find", 1) || call.is("findAll", 1) || call.is("cutBy", 1);
  bool const takes_pattern = has_pattern && (call.is("split", 1) || call.is("contains", 1) || call.is("count", 1));
  if (has_pattern && call.is("replace", 2)) {
    return fault("replace takes a text; replaceAll takes a pattern", "IllegalArgumentException");
  }
  if (!reads_text && !takes_pattern) return std::nullopt;
  auto const pattern = call.patterns.of(call.arguments[0]);
  if (!pattern) return std::unexpected(pattern.error());
  return with_pattern(call, text, **pattern);
}

}  // namespace lapwing::dolphin::internal
