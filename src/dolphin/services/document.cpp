#include "dolphin/services/document.hpp"

#include <algorithm>
#include <utility>

#include "dolphin/check/checker.hpp"
#include "dolphin/services/occurrences.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {

namespace {

TokenStream tokens_of(base::SourceFile const& source) {
  base::Diagnostics unused(source);
  return lex(unused);
}

}  // namespace

Document::Document(std::string name, std::string text, Vocabulary const& vocabulary)
    : source_(std::move(name), std::move(text)),
      vocabulary_(vocabulary),
      mistakes_(source_),
      stream_(tokens_of(source_)),
      program_(parse(mistakes_, names_of(vocabulary.added()))),
      resolution_(resolve(program_, vocabulary.instructions())),
      inference_(resolution_, vocabulary.added().builders) {
  occurrences_ = find_occurrences(*this, scopes_);
}

Occurrence const* Document::occurrence_at(std::uint32_t offset) const {
  auto const after =
      std::ranges::upper_bound(occurrences_, offset, {}, [](Occurrence const& one) { return one.span.begin; });
  if (after == occurrences_.begin()) return nullptr;
  auto const& found = *std::prev(after);
  if (found.span.contains(offset) || found.span.end == offset) return &found;
  return nullptr;
}

std::vector<base::Diagnostic> Document::diagnostics() const {
  auto all = mistakes_;
  check(program_, vocabulary_.added(), all);
  return all.sorted();
}

}  // namespace lapwing::dolphin
