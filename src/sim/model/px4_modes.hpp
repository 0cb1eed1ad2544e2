#pragma once

#include <cstdint>

namespace lapwing::sim {

/// PX4's HEARTBEAT.custom_mode: main mode in bits 16..23, sub mode in bits 24..31 (px4_custom_mode.h).
[[nodiscard]] constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16U | sub << 24U;
}
inline constexpr std::uint32_t px4_auto = 4;
inline constexpr std::uint32_t px4_auto_mission = 4;
inline constexpr std::uint32_t px4_offboard = px4_mode(6);

}  // namespace lapwing::sim
