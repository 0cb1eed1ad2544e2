#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

struct Hover {
  base::Span span;  ///< the word that it is about
  std::string markdown;
};

/// What is to be said about the word at the offset.
[[nodiscard]] std::optional<Hover> hover(Document const& document, std::uint32_t offset);

}  // namespace lapwing::dolphin
