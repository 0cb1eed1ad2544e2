#pragma once

#include <span>

#include "dolphin/builtin/natives.hpp"

/// The table of natives, by topic.
namespace lapwing::dolphin::internal {

[[nodiscard]] std::span<Native const> control_natives();
[[nodiscard]] std::span<Native const> math_natives();
[[nodiscard]] std::span<Native const> task_natives();
[[nodiscard]] std::span<Native const> vehicle_natives();

}  // namespace lapwing::dolphin::internal
