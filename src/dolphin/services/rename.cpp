#include "dolphin/services/rename.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>

#include "dolphin/services/navigation.hpp"
#include "dolphin/syntax/characters.hpp"

namespace lapwing::dolphin {

namespace {

using base::ErrorKind;
using base::Span;

bool is_word(std::string_view text) {
  if (identifier_start(text) == 0) return false;
  std::size_t size = 0;
  while (auto const more = identifier_character(text.substr(size))) size += more;
  return size == text.size();
}

bool is_reserved(std::string_view text) {
  base::SourceFile const source("name", std::string(text));
  base::Diagnostics diagnostics(source);
  return is_reserved_word(lex(diagnostics).tokens.front().kind);
}

base::Result<> usable(std::string_view name, WordKind kind, Document const& document) {
  if (kind == WordKind::plan) {
    bool const plain = !name.empty() && name.find_first_of("'\"\\$\r\n") == std::string_view::npos;
    if (plain) return {};
    return base::fail(ErrorKind::invalid_input, "the name of a mission has no quotes, backslashes and dollar signs");
  }
  if (!is_word(name)) {
    return base::fail(ErrorKind::invalid_input, fmt::format("'{}' is not a name: letters, digits and _", name));
  }
  if (is_reserved(name)) return base::fail(ErrorKind::invalid_input, fmt::format("'{}' is a reserved word", name));
  if (kind != WordKind::signal && document.vocabulary().is_taken(name)) {
    return base::fail(ErrorKind::invalid_input, fmt::format("'{}' is part of the language", name));
  }
  return {};
}

std::string with_replaced(std::string_view text, std::vector<Span> const& places, std::string_view word) {
  std::string out;
  std::uint32_t at = 0;
  for (auto const place : places) {
    out.append(text.substr(at, place.begin - at)).append(word);
    at = place.end;
  }
  return out.append(text.substr(at));
}

/// Each variable by the number of its first place, so that two readings of a script can be compared.
class Meanings {
 public:
  explicit Meanings(Document const& document) : document_(document) {
    auto const& all = document.occurrences();
    for (std::size_t i = 0; i < all.size(); ++i) first_.try_emplace(thing(all[i]), i);
  }
  [[nodiscard]] std::size_t of(Occurrence const& one) const { return first_.at(thing(one)); }

 private:
  [[nodiscard]] std::string thing(Occurrence const& one) const {
    switch (one.kind) {
      case WordKind::variable: return fmt::format("v{}", static_cast<void const*>(one.variable));
      case WordKind::function: return fmt::format("f{}", static_cast<void const*>(one.functions));
      default: return fmt::format("{}{}", static_cast<int>(one.kind), document_.text(one.span));
    }
  }
  Document const& document_;
  std::unordered_map<std::string, std::size_t> first_;
};

bool means_the_same(Document const& before, Document const& after) {
  auto const same_mistakes = before.resolution().redeclared.size() == after.resolution().redeclared.size();
  if (!same_mistakes || before.occurrences().size() != after.occurrences().size()) return false;
  Meanings const old_meanings(before);
  Meanings const new_meanings(after);
  return std::ranges::equal(before.occurrences(), after.occurrences(), [&](Occurrence const& a, Occurrence const& b) {
    return a.kind == b.kind && a.is_definition == b.is_definition && old_meanings.of(a) == new_meanings.of(b);
  });
}

}  // namespace

base::Result<Span> renamable(Document const& document, std::uint32_t offset) {
  auto const* word = document.occurrence_at(offset);
  if (!word) return base::fail(ErrorKind::refused, "there is no name here");
  auto const text = document.text(word->span);
  bool const is_own = word->kind == WordKind::variable || word->kind == WordKind::function ||
                      word->kind == WordKind::signal || word->kind == WordKind::plan;
  if (!is_own) return base::fail(ErrorKind::refused, fmt::format("'{}' is part of the language", text));
  if (word->kind == WordKind::variable && word->variable->defined.size() == 0) {
    return base::fail(ErrorKind::refused, "the parameter 'it' has no other name", "write { name -> ... }");
  }
  if (word->kind == WordKind::plan && definition(document, offset).empty()) {
    return base::fail(ErrorKind::refused, fmt::format("the plan '{}' is not of this script", text));
  }
  return word->span;
}

base::Result<std::vector<Span>> rename(Document const& document, std::uint32_t offset, std::string_view new_name) {
  auto const word = renamable(document, offset);
  if (!word) return std::unexpected(word.error());
  auto const kind = document.occurrence_at(offset)->kind;
  if (auto const fits = usable(new_name, kind, document); !fits) return std::unexpected(fits.error());
  std::vector<Span> places;
  for (auto const& one : references(document, offset)) places.push_back(one.span);
  auto text = with_replaced(document.source().text(), places, new_name);
  Document const renamed(document.source().name(), std::move(text), document.vocabulary());
  if (!means_the_same(document, renamed)) {
    return base::fail(ErrorKind::refused, fmt::format("'{}' already means something in this script", new_name));
  }
  return places;
}

}  // namespace lapwing::dolphin
