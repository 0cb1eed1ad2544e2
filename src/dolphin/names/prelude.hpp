#pragma once

#include <string>

namespace lapwing::dolphin {

/// The part of the library that is written in the language itself: methods that call closures, so that these may wait,
/// loop and fail as any other code. Each function is a method of its first parameter. What rows of the table give as
/// their source, and what several of them use.
[[nodiscard]] std::string prelude();

}  // namespace lapwing::dolphin
