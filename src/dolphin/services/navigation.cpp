#include "dolphin/services/navigation.hpp"

#include <algorithm>

#include "dolphin/services/describe.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

/// Whether two words mean one thing that a script defines.
bool means_same(Occurrence const& a, Occurrence const& b, Document const& document) {
  if (a.kind != b.kind) return false;
  if (a.kind == WordKind::variable) return a.variable == b.variable;
  if (a.kind == WordKind::function) return a.functions == b.functions;
  bool const by_name = a.kind == WordKind::plan || a.kind == WordKind::signal;
  return by_name && document.text(a.span) == document.text(b.span);
}

SymbolKind symbol_kind(Variable const& variable, Document const& document) {
  auto const kinds = document.facts(variable).kinds;
  if (kinds == Kinds(Kind::vehicles)) return SymbolKind::vehicles;
  if (kinds != Kinds(Kind::task)) return SymbolKind::variable;
  auto const* call = variable.values.size() == 1 ? std::get_if<ast::Call>(&variable.values[0]->node) : nullptr;
  auto const* callee = call ? std::get_if<ast::Name>(&call->callee->node) : nullptr;
  return callee && document.vocabulary().builder(callee->text) ? SymbolKind::mission : SymbolKind::task;
}

}  // namespace

std::vector<Span> definition(Document const& document, std::uint32_t offset) {
  auto const* word = document.occurrence_at(offset);
  if (!word) return {};
  if (word->kind == WordKind::variable && word->variable->defined.size() > 0) return {word->variable->defined};
  std::vector<Span> out;
  for (auto const& one : document.occurrences()) {
    if (one.is_definition && means_same(one, *word, document)) out.push_back(one.span);
  }
  return out;
}

std::vector<Occurrence> references(Document const& document, std::uint32_t offset) {
  auto const* word = document.occurrence_at(offset);
  if (!word) return {};
  std::vector<Occurrence> out;
  for (auto const& one : document.occurrences()) {
    if (means_same(one, *word, document)) out.push_back(one);
  }
  return out;
}

std::vector<Symbol> symbols(Document const& document) {
  std::vector<Symbol> out;
  for (auto const& [name, functions] : document.resolution().functions) {
    for (auto const* one : functions) {
      auto const span = cover(one->name.span, one->body.span);
      out.push_back({one->name.text, call_text(*one, document).text, SymbolKind::function, span, one->name.span});
    }
  }
  for (auto const& [name, variable] : document.resolution().globals) {
    auto const span =
        variable->values.empty() ? variable->defined : cover(variable->defined, variable->values[0]->span);
    out.push_back({variable->name, kind_text(document.facts(*variable)), symbol_kind(*variable, document), span,
                   variable->defined});
  }
  std::ranges::sort(out, {}, [](Symbol const& one) { return one.name_span.begin; });
  return out;
}

}  // namespace lapwing::dolphin
