#include "geo/area.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "geo/polygon.hpp"

namespace lapwing::geo {
namespace {

/// The tangent plane at the first corner: whether lines cross does not change with the plane.
struct PlaneOfCorners {};

bool is_place(Wgs84 const& place) {
  return std::isfinite(place.lon_rad) && std::abs(place.lat_rad) <= std::numbers::pi / 2.0;
}

std::optional<std::string> fault(Disc const& disc) {
  if (!is_place(disc.center)) return "its centre is no place";
  if (!(disc.radius_m > 0.0 && std::isfinite(disc.radius_m))) return "its radius is not above 0 m";
  return std::nullopt;
}

std::optional<std::string> fault(Outline const& outline) {
  constexpr std::size_t fewest_corners = 3;
  auto const& corners = outline.corners;
  if (corners.size() < fewest_corners)
    return fmt::format("it takes {} corners, not {}", fewest_corners, corners.size());
  if (!std::ranges::all_of(corners, is_place)) return "one of its corners is no place";
  LocalFrame const plane({corners.front().lat_rad, corners.front().lon_rad, 0.0});
  Ring<PlaneOfCorners> ring;
  for (auto const& corner : corners) {
    auto const at = plane.ned_from({corner.lat_rad, corner.lon_rad, 0.0});
    ring.emplace_back(at.east, at.north);
  }
  return polygon_fault(Polygon<PlaneOfCorners>{{std::move(ring)}});
}

}  // namespace

std::optional<std::string> area_fault(Area const& area) {
  return std::visit([](auto const& one) { return fault(one); }, area);
}

}  // namespace lapwing::geo
