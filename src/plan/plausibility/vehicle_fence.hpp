#pragma once

#include <optional>

#include "plan/plan.hpp"

namespace lapwing::plan::plausibility {

/// The fence that a vehicle keeps to by itself while it is switched on there: limits that its parameters set, and the
/// areas that somebody stored.
struct VehicleFence {
  std::optional<double> radius_m = std::nullopt;   ///< round home
  std::optional<double> highest_m = std::nullopt;  ///< above home
  std::optional<double> lowest_m = std::nullopt;   ///< above home, from when it was above that
  GeoFence areas = {};                             ///< as stored: one polygon or circle a zone, without heights
  double margin_m = 0.0;                           ///< nearer to an edge than this is said
  bool one_inclusion_will_do = false;              ///< else it stays in all of them at once
  bool only_tells = false;                         ///< it reports a breach, and flies on
};

}  // namespace lapwing::plan::plausibility
