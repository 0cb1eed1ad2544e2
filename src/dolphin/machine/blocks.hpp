#pragma once

#include <memory>
#include <string_view>

#include "dolphin/machine/fiber.hpp"

namespace lapwing::dolphin {

/// Opens a builder block by its word: pick, pos, moveDistance, allOf, oneOf, choose, or one of the platform's.
[[nodiscard]] Checked<std::unique_ptr<Block>> open_block(Runtime& runtime, std::string_view word, int line);

}  // namespace lapwing::dolphin
