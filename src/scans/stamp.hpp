#pragma once

#include <chrono>

#include "bus/messages/common.hpp"

namespace lapwing::scans {

[[nodiscard]] inline std::chrono::nanoseconds since_epoch(bus::Time const& time) {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

}  // namespace lapwing::scans
