#pragma once

#include <chrono>
#include <cstdint>

namespace lapwing::firmware {

/// Time since the board started. 64 bits of microseconds never wrap.
using Time = std::chrono::duration<std::int64_t, std::micro>;

[[nodiscard]] constexpr float to_seconds(Time time) {
  return std::chrono::duration<float>(time).count();
}

}  // namespace lapwing::firmware
