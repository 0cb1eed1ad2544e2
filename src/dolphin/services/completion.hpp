#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

enum class CompletionKind {
  variable,
  function,
  instruction,
  block,
  command,
  keyword,
  method,
  property,
  unit,
  constant,
  type,
  value
};

struct CompletionItem {
  std::string label;
  CompletionKind kind = CompletionKind::variable;
  std::string detail = {};  ///< what kind of thing it is, in a few words
  std::string markdown = {};
  std::string insert = {};   ///< when that is more than the label
  std::string snippet = {};  ///< for editors that fill in places: $1, $0
  int rank = 0;              ///< lower ones come first
};

struct Completion {
  base::Span replaced;  ///< the word that is being written
  std::vector<CompletionItem> items;
};

/// What can stand at the offset: the words of the block one is in, units and methods behind a point, variables that can
/// be seen, vehicles behind `execute`, signals, choices within quotes. Not filtered by the word that is being written.
[[nodiscard]] Completion complete(Document const& document, std::uint32_t offset);

}  // namespace lapwing::dolphin
