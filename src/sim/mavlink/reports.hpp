#pragma once

#include <optional>

#include "base/time.hpp"
#include "mavlink/codec/messages.hpp"
#include "sim/autopilot/autopilot.hpp"

namespace lapwing::sim {

/// What a report is made from.
struct ReportView {
  Autopilot const& autopilot;
  Site const& site;
  geo::Ned wind_m_s;
  base::UtcTime utc;
  std::size_t mission_items = 0;  ///< home included
  std::uint8_t system_id = 1;
};

/// The vehicle's present state as that message; nothing when it does not send such a message now (before the estimator
/// has a position, outside guided flight, or at all).
[[nodiscard]] std::optional<mavlink::Message> report(mavlink::MessageId id, ReportView const& view);

}  // namespace lapwing::sim
