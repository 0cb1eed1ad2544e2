#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/enums.hpp"
#include "mavlink/codec/messages.hpp"

namespace lapwing::bridge {

/// Three heartbeats: one that is late or lost is no lost link.
inline constexpr base::Duration longest_silence = std::chrono::seconds(3);

/// The flight controller as its heartbeats tell, and what of its telemetry the bus needs for other messages.
struct FlightController {
  mavlink::Address address = {};
  std::optional<mavlink::Heartbeat> heartbeat = {};  ///< the last one; nothing: never heard
  base::TimePoint heard{};                           ///< that heartbeat
  std::optional<mavlink::GpsRaw> gps = {};
  std::optional<geo::Wgs84> origin = {};  ///< of its local frame
  std::optional<mavlink::Attitude> attitude = {};

  [[nodiscard]] bool is_connected(base::TimePoint now) const { return heartbeat && now - heard <= longest_silence; }
  /// As its autopilot names it; empty while it is not heard.
  [[nodiscard]] std::string mode() const;
  /// The number of a mode by its name, or by a number in digits.
  [[nodiscard]] std::optional<std::uint32_t> mode_number(std::string const& name) const;
};

}  // namespace lapwing::bridge
