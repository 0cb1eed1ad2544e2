#pragma once

#include <vector>

#include "explore/lot/lot_settings.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/polygon.hpp"

namespace lapwing::explore {

/// Tells cars that stand from those that pass: one stands when it was found at the same place, looking the same way, in
/// pictures that are `stands_after` apart, and in none between them was it missing.
class StandingCars {
 public:
  explicit StandingCars(LotSettings settings) : settings_(std::move(settings)) {}

  void add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint);
  [[nodiscard]] std::vector<Corners> standing() const;

 private:
  struct Car {
    Corners outline;
    base::UtcTime first;
    base::UtcTime last;
  };
  [[nodiscard]] bool stands(Car const& car) const;

  LotSettings settings_;
  std::vector<Car> cars_;
};

}  // namespace lapwing::explore
