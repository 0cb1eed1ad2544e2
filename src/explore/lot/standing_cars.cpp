#include "explore/lot/standing_cars.hpp"

#include <algorithm>
#include <numbers>

namespace lapwing::explore {

namespace {

constexpr double most_turn_rad = std::numbers::pi / 9.0;

}  // namespace

bool StandingCars::stands(Car const& car) const {
  return car.last - car.first >= settings_.stands_after;
}

void StandingCars::add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint) {
  std::vector<bool> is_known(sight.cars.size(), false);
  std::erase_if(cars_, [&](Car& car) {
    auto const middle = middle_of(car.outline);
    for (std::size_t i = 0; i < sight.cars.size(); ++i) {
      auto const& outline = sight.cars[i].outline;
      if (is_known[i] || geo::distance_m(middle_of(outline), middle) > settings_.stands_within_m ||
          between_axes(axis_of(outline), axis_of(car.outline)) > most_turn_rad)
        continue;
      is_known[i] = true;
      car.first = std::min(car.first, sight.at);
      car.last = std::max(car.last, sight.at);
      return false;
    }
    // In view and not found: it has driven on.
    return geo::contains(footprint, middle) && geo::distance_to_edge_m(footprint, middle) > settings_.edge_m;
  });
  for (std::size_t i = 0; i < sight.cars.size(); ++i)
    if (!is_known[i]) cars_.push_back({sight.cars[i].outline, sight.at, sight.at});
}

std::vector<Corners> StandingCars::standing() const {
  std::vector<Corners> outlines;
  for (auto const& car : cars_)
    if (stands(car)) outlines.push_back(car.outline);
  return outlines;
}

}  // namespace lapwing::explore
