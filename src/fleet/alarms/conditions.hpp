#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vehicle/alarm.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// Something about one vehicle that its operator must be told.
struct Condition {
  vehicle::AlarmKind kind = vehicle::AlarmKind::silent;
  vehicle::Severity severity = vehicle::Severity::warning;
  base::TimePoint since{};
  std::string words = {};  ///< a whole line, with the vehicle's name
};

/// What its state alone does not tell.
struct Circumstances {
  vehicle::BatteryLimits battery = {};
  std::span<vehicle::AlarmKind const> standing = {};  ///< what is true already: the end of it is told with some slack
  std::optional<base::TimePoint> left_at = std::nullopt;  ///< when its last commander went, if nobody came after him
};

/// Everything of that kind that is true of the vehicle now, at most one of a kind. Pure.
[[nodiscard]] std::vector<Condition> conditions_of(vehicle::VehicleState const& state,
                                                   Circumstances const& circumstances, base::TimePoint now);

}  // namespace lapwing::fleet
