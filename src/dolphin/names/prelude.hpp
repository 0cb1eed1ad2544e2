#pragma once

#include <string_view>

namespace lapwing::dolphin {

/// The part of the library that is written in the language itself: methods that call closures, so that these may wait,
/// loop and fail as any other code. Each function is a method of its first parameter.
[[nodiscard]] std::string_view prelude();

}  // namespace lapwing::dolphin
