#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "station/http/router.hpp"
#include "vehicle/alarm.hpp"

/// What is told of alarms, and how one is acknowledged: "Alarms" in docs/reference/station-messages.md.
namespace lapwing::station {

struct AcknowledgeAlarms {
  std::vector<std::uint64_t> numbers;
  vehicle::Commander by = {};  ///< as the client calls itself; empty when it does not say
};

/// Reads what `acknowledge_alarms` and `POST /api/v1/alarms/acknowledge` take: {"numbers": [...], "operator": ...}.
[[nodiscard]] base::Result<AcknowledgeAlarms> parse_acknowledge_alarms(std::string_view text);

/// Without `alarms` there are none.
[[nodiscard]] std::string alarms_message(vehicle::VehicleAlarms const* alarms, base::TimePoint now);

/// `alarms` may be null; `loop` outlives the router.
void add_alarm_routes(Router& router, vehicle::VehicleAlarms* alarms, base::Loop const& loop);

}  // namespace lapwing::station
