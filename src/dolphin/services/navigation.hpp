#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dolphin/services/document.hpp"

/// Ways from word to word.
namespace lapwing::dolphin {

/// Where the word at the offset gets its meaning: a variable its first value, a function its declarations, a plan the
/// mission of that name. Nothing for words of the language.
[[nodiscard]] std::vector<base::Span> definition(Document const& document, std::uint32_t offset);

/// Every place where the variable, function, plan or signal at the offset is meant, definitions included, in order.
[[nodiscard]] std::vector<Occurrence> references(Document const& document, std::uint32_t offset);

enum class SymbolKind { function, mission, vehicles, task, variable };

/// An entry of the outline.
struct Symbol {
  std::string name;
  std::string detail;
  SymbolKind kind = SymbolKind::variable;
  base::Span span;       ///< all of it
  base::Span name_span;  ///< inside `span`
};

/// Functions and global variables in order of their definitions.
[[nodiscard]] std::vector<Symbol> symbols(Document const& document);

}  // namespace lapwing::dolphin
