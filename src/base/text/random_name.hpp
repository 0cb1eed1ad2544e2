#pragma once

#include <string>

namespace lapwing::base {

/// Hexadecimal digits from the system's random device, four bits each: 8 tell one run of a program from the one before,
/// 32 are guessed by nobody.
[[nodiscard]] std::string random_name(int digits);

}  // namespace lapwing::base
