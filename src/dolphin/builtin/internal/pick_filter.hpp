#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "dolphin/value/objects.hpp"
#include "geo/position.hpp"
#include "tasks/platform.hpp"

namespace lapwing::dolphin::internal {

/// What a vehicle must be to be picked.
struct PickFilter {
  std::size_t count = 1;
  base::Duration timeout{};
  std::optional<std::string> type;
  std::optional<std::string> id;
  std::vector<std::string> payload;
  std::optional<geo::Disc> region;
};
[[nodiscard]] PickFilter pick_filter(Map const& fields);

/// What rules the vehicle out, field by field: "is a UGV", "has no Camera". Empty: it is what is wanted.
[[nodiscard]] std::vector<std::string> objections(PickFilter const& filter, tasks::VehicleInfo const& vehicle);

/// "2 UAV with Camera": for people.
[[nodiscard]] std::string pick_text(PickFilter const& filter);

/// Every vehicle that there is, and why it was not picked: a line each.
[[nodiscard]] std::vector<std::string> why_not_picked(PickFilter const& filter,
                                                      std::vector<tasks::VehicleInfo> const& vehicles,
                                                      std::vector<tasks::VehicleId> const& picked);

}  // namespace lapwing::dolphin::internal
