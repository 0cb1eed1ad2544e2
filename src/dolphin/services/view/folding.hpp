#pragma once

#include <cstdint>
#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

enum class FoldKind { code, comment, region };

/// Lines, from 0, that an editor can hide behind the first of them; the last one is hidden, too.
struct Fold {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  FoldKind kind = FoldKind::code;
};

/// What stands in brackets over several lines (the line of the closing bracket stays), long comments, comments on lines
/// that follow each other, texts in triple quotes, and what stands between `// region` and `// endregion`. In order of
/// their first lines, one a line.
[[nodiscard]] std::vector<Fold> folds(Document const& document);

}  // namespace lapwing::dolphin
