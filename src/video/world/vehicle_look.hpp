#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "video/world/dice.hpp"

namespace lapwing::video {

/// Red, green and blue, 0 to 1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  friend constexpr bool operator==(Colour const&, Colour const&) = default;
};

[[nodiscard]] constexpr Colour operator*(Colour const& colour, double factor) {
  return {colour.red * factor, colour.green * factor, colour.blue * factor};
}

/// A kind of vehicle by its measures, as training/cars/vehicles.py has them. Shares of its length count from the tail.
struct VehicleKind {
  std::string_view name;
  double share = 0.0;  ///< of the vehicles on a car park, beside the other kinds'
  std::array<double, 2> length_m = {};
  std::array<double, 2> width_m = {};
  std::array<double, 2> height_m = {};
  std::array<double, 2> cabin = {};  ///< where its windows begin and end, at the belt
  std::array<double, 2> roof = {};
  bool is_box = false;  ///< a van: its sides are straight up
};

inline constexpr std::array<VehicleKind, 6> vehicle_kinds = {{
    {"saloon", 30, {4.3, 5.0}, {1.74, 1.9}, {1.4, 1.5}, {0.13, 0.72}, {0.27, 0.56}},
    {"hatchback", 18, {3.6, 4.4}, {1.65, 1.82}, {1.42, 1.58}, {0.02, 0.75}, {0.1, 0.58}},
    {"suv", 24, {4.3, 5.1}, {1.8, 2.0}, {1.6, 1.85}, {0.02, 0.74}, {0.07, 0.58}},
    {"minivan", 9, {4.5, 5.2}, {1.8, 2.0}, {1.7, 2.0}, {0.02, 0.84}, {0.05, 0.68}},
    {"pickup", 6, {5.0, 5.6}, {1.85, 2.05}, {1.75, 1.95}, {0.4, 0.76}, {0.44, 0.63}},
    {"van", 5, {4.9, 5.9}, {1.95, 2.1}, {2.1, 2.8}, {0.8, 0.92}, {0.02, 0.8}, true},
}};

/// One vehicle's looks.
struct VehicleLook {
  VehicleKind const* kind = vehicle_kinds.data();
  double length_m = 4.6;
  double width_m = 1.8;
  double height_m = 1.45;
  Colour paint = {0.9, 0.9, 0.9};
  double glass = 1.0;  ///< how bright its windows are, beside usual ones
  bool has_skylight = false;
  bool has_rails = false;
};

/// A vehicle as they stand on car parks: of some kind, size and paint, no longer than `longest_m` if there are such.
[[nodiscard]] VehicleLook drawn_vehicle(Dice& dice, double longest_m);
/// The kind of that name; null for none.
[[nodiscard]] VehicleKind const* vehicle_kind(std::string_view name);

}  // namespace lapwing::video
