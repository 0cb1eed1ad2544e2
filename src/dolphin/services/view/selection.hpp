#pragma once

#include <cstdint>
#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

/// What one may want to select at the offset, smallest first, each inside the next: the word, what it is part of, the
/// statement, what stands in the brackets round it, the brackets, and so on up to the whole text.
[[nodiscard]] std::vector<base::Span> selections(Document const& document, std::uint32_t offset);

}  // namespace lapwing::dolphin
