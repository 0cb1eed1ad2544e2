#pragma once

#include "tasks/vocabulary.hpp"

namespace lapwing::robot {

/// What robots add to the language: the block word `drive { ... }`. Builds `DriveTask`s; one without a `name` is called
/// Drive_N, N counting the drives that this vocabulary has built.
[[nodiscard]] tasks::Vocabulary vocabulary();

}  // namespace lapwing::robot
