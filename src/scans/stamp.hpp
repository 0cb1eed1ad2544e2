#pragma once

#include <chrono>
#include <cstdint>

#include "bus/messages/common.hpp"

namespace lapwing::scans {

[[nodiscard]] inline std::chrono::nanoseconds since_epoch(bus::Time const& time) {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

[[nodiscard]] inline bus::Time stamp_at(std::chrono::nanoseconds since_epoch) {
  auto const seconds = std::chrono::floor<std::chrono::seconds>(since_epoch);
  return {.sec = static_cast<std::int32_t>(seconds.count()),
          .nanosec = static_cast<std::uint32_t>((since_epoch - seconds).count())};
}

}  // namespace lapwing::scans
