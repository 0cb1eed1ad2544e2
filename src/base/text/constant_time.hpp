#pragma once

#include <string_view>

namespace lapwing::base {

/// Whether `given` is `secret`, in a time that tells nothing of how much of it is right: it depends on the length of
/// `given` alone.
[[nodiscard]] bool equal_in_constant_time(std::string_view given, std::string_view secret);

}  // namespace lapwing::base
