#pragma once

#include <string>

#include "video/world/car_park.hpp"
#include "video/world/row_of_slots.hpp"

/// A small car park for tests: asphalt round its anchor, and on it two rows of eight slots head to head.
namespace lapwing::video::testing {

inline CarPark small_car_park(std::uint64_t seed = 1, double share = 0.5) {
  CarPark park{.name = "small", .anchor = geo::Wgs84::from_degrees(41.178, -8.598, 90.0), .seed = seed};
  park.patches.push_back({.corners = {Spot(-20, -14), Spot(20, -14), Spot(20, 14), Spot(-20, 14)}});
  add_row(park, {.name = "A", .at = Spot(-10, -5), .count = 8, .share = share});
  add_row(park, {.name = "B", .at = Spot(10, 5), .heading_rad = std::numbers::pi, .count = 8, .share = share});
  return park;
}

}  // namespace lapwing::video::testing
