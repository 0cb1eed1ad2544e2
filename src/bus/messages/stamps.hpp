#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "base/time.hpp"
#include "bus/messages/common.hpp"

/// Times of messages: UTC, as programs on one vehicle have it.
namespace lapwing::bus {

[[nodiscard]] inline Header header_at(base::UtcTime at, std::string frame) {
  auto const since = at.time_since_epoch();
  auto const seconds = std::chrono::floor<std::chrono::seconds>(since);
  auto const rest = std::chrono::duration_cast<std::chrono::nanoseconds>(since - seconds);
  return {
      .stamp = {.sec = static_cast<std::int32_t>(seconds.count()), .nanosec = static_cast<std::uint32_t>(rest.count())},
      .frame_id = std::move(frame)};
}

[[nodiscard]] inline base::UtcTime utc_of(Time const& stamp) {
  auto const since = std::chrono::seconds(stamp.sec) + std::chrono::nanoseconds(stamp.nanosec);
  return base::UtcTime(std::chrono::duration_cast<base::UtcTime::duration>(since));
}

}  // namespace lapwing::bus
