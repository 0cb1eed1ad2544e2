#include "dolphin/services/semantic_tokens.hpp"

#include <algorithm>
#include <optional>

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

SemanticType type_of(Occurrence const& one) {
  switch (one.kind) {
    case WordKind::variable:
      return one.variable->kind == VariableKind::parameter ? SemanticType::parameter : SemanticType::variable;
    case WordKind::function:
    case WordKind::instruction:
    case WordKind::builder: return SemanticType::function;
    case WordKind::command: return SemanticType::method;
    case WordKind::chain: return SemanticType::keyword;
    case WordKind::member: return one.method->is_property ? SemanticType::property : SemanticType::method;
    case WordKind::unit:
    case WordKind::signal: return SemanticType::property;
    case WordKind::plan: return SemanticType::string;
    case WordKind::constant: return SemanticType::variable;
    case WordKind::type: return SemanticType::type;
  }
  return SemanticType::variable;
}

bool is_built_in(WordKind kind) {
  return kind != WordKind::variable && kind != WordKind::function && kind != WordKind::signal && kind != WordKind::plan;
}

std::optional<SemanticType> type_of(Token const& token, std::string_view text) {
  if (is_reserved_word(token.kind)) return SemanticType::keyword;
  switch (token.kind) {
    case integer:
    case decimal: return SemanticType::number;
    case string:
    case string_open:
    case string_text:
    case string_close:
    case pattern: return SemanticType::string;
    case identifier:
      if (text == "then" || text == "run" || text == "onError") return SemanticType::keyword;
      return std::nullopt;
    default: return std::nullopt;
  }
}

}  // namespace

std::vector<SemanticToken> semantic_tokens(Document const& document) {
  std::vector<SemanticToken> all;
  for (auto const& one : document.occurrences()) {
    if (one.kind == WordKind::plan) continue;  // part of a text
    all.push_back({one.span, type_of(one), one.is_definition, is_built_in(one.kind)});
  }
  for (auto const& token : document.stream().tokens) {
    if (auto const type = type_of(token, document.text(token.span)); type && token.span.size() > 0)
      all.push_back({token.span, *type});
  }
  for (auto const comment : document.stream().comments) all.push_back({comment, SemanticType::comment});
  std::ranges::stable_sort(all, {}, [](SemanticToken const& one) { return one.span.begin; });
  std::vector<SemanticToken> out;
  for (auto const& one : all) {
    if (out.empty() || one.span.begin >= out.back().span.end) out.push_back(one);
  }
  return out;
}

}  // namespace lapwing::dolphin
