#pragma once

#include "tasks/vocabulary.hpp"

namespace lapwing::autonomy {

/// What survey drones add to the language: the block word `lot { ... }`. Builds `LotTask`s; one without a `name` is
/// called Lot_N, N counting those that this vocabulary has built.
[[nodiscard]] tasks::Vocabulary vocabulary();

}  // namespace lapwing::autonomy
