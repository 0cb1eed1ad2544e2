#pragma once

#include <cstdint>
#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

enum class SemanticType : std::uint8_t {
  variable,
  parameter,
  function,
  method,
  property,
  keyword,
  type,
  string,
  number,
  comment
};

struct SemanticToken {
  base::Span span;
  SemanticType type = SemanticType::variable;
  bool is_definition = false;
  bool is_built_in = false;  ///< of the language or the platform
};

/// The words of the script with what they are, in order of place, none over another. Comments and texts may span lines.
[[nodiscard]] std::vector<SemanticToken> semantic_tokens(Document const& document);

}  // namespace lapwing::dolphin
