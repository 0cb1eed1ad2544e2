#pragma once

#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

/// Every word of the script that means something, in order of place; fills in where its variables can be seen. Reads
/// the document's tree and resolution, and what it can infer.
[[nodiscard]] std::vector<Occurrence> find_occurrences(Document const& document, Scopes& scopes);

}  // namespace lapwing::dolphin
