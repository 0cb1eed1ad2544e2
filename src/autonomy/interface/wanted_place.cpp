#include "autonomy/interface/wanted_place.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace lapwing::autonomy {

namespace {

double distance_m(geo::Box<ArmingFrame> const& box, geo::Point<ArmingFrame> const& place) {
  auto const nearest = place.v.cwiseMax(box.least.v).cwiseMin(box.most.v);
  return (place.v - nearest).norm();
}

}  // namespace

base::Result<> check_place(geo::Point<ArmingFrame> const& place, PlaceLimits const& limits,
                           std::optional<geo::Box<ArmingFrame>> const& lot) {
  using enum base::ErrorKind;
  if (!place.is_finite())
    return base::fail(invalid_input, "the wanted place has a coordinate that is no number", "give X and Y in metres");
  if (double const far_m = place.v.norm(); far_m > limits.furthest_m)
    return base::fail(
        invalid_input,
        fmt::format("the wanted place is {:.0f} m from where the drone was armed, and {:.0f} m is the limit", far_m,
                    limits.furthest_m),
        "give a nearer place, or raise the limit in the drone's settings");
  if (limits.fence && !geo::contains(*limits.fence, place))
    return base::fail(invalid_input,
                      fmt::format("the wanted place ({:.1f} m, {:.1f} m) is {:.1f} m outside the fence", place.x(),
                                  place.y(), geo::distance_to_edge_m(*limits.fence, place)),
                      "give a place within it");
  if (!lot) return {};
  if (double const off_m = distance_m(*lot, place); off_m > limits.furthest_from_lot_m)
    return base::fail(invalid_input,
                      fmt::format("the wanted place is {:.0f} m from the parking lot, and {:.0f} m is the limit", off_m,
                                  limits.furthest_from_lot_m),
                      "give a place in the lot, or use Compulsive Move");
  return {};
}

base::Result<> check_height(double height_m, HoverHeights const& heights) {
  using enum base::ErrorKind;
  if (!std::isfinite(height_m)) return base::fail(invalid_input, "the wanted height is no number");
  if (height_m < heights.min_m)
    return base::fail(invalid_input, fmt::format("the wanted height ({:.1f} m) is below the lowest hover height ({} m)",
                                                 height_m, heights.min_m));
  if (height_m > heights.max_m)
    return base::fail(
        invalid_input,
        fmt::format("the wanted height ({:.1f} m) is above the highest hover height ({} m)", height_m, heights.max_m));
  return {};
}

base::Result<geo::Point<ArmingFrame>> in_arming_frame(geo::Wgs84 place, geo::Wgs84 drone,
                                                      geo::Point<ArmingFrame> const& drone_local) {
  double constexpr half_turn = std::numbers::pi;
  bool const is_on_earth = std::abs(place.lat_rad) <= half_turn / 2.0 && std::abs(place.lon_rad) <= half_turn;
  if (!is_on_earth)
    return base::fail(base::ErrorKind::invalid_input, "the wanted place is none on Earth",
                      "give the latitude from -90 to 90 and the longitude from -180 to 180 degrees");
  place.alt_m = drone.alt_m;
  auto const shift = geo::to_enu(geo::LocalFrame(drone).ned_from(place));
  return drone_local + geo::Vector<ArmingFrame>(shift.east, shift.north);
}

geo::Wgs84 on_globe(geo::Point<ArmingFrame> const& place, geo::Wgs84 drone,
                    geo::Point<ArmingFrame> const& drone_local) {
  auto const shift = place - drone_local;
  return geo::displaced(drone, {.north = shift.y(), .east = shift.x(), .down = 0.0});
}

}  // namespace lapwing::autonomy
