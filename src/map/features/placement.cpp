#include "map/features/placement.hpp"

namespace lapwing::map {

geo::Wgs84 place_of(geo::Site const& site, SitePoint const& point) {
  auto place = site.place_of(geo::Point3<geo::SiteFrame>(point.x(), point.y(), 0.0));
  auto const anchor_rad = site.anchor().lon_rad;
  place.lon_rad = anchor_rad + geo::wrap_pi(place.lon_rad - anchor_rad);
  return place;
}

SitePoint point_of(geo::Site const& site, double lon_rad, double lat_rad) {
  geo::Wgs84 place{lat_rad, geo::wrap_pi(lon_rad), site.anchor().alt_m};
  auto point = site.point_of(place);
  // So far below the plane lies what is 1,600 km away. No plumb line from there meets the map; only the distance is
  // told.
  constexpr double lowest_m = -200'000.0;
  if (!(point.z() > lowest_m)) return {geo::surface_distance_m(site.anchor(), place), 0.0};
  // Where the plumb line through the place meets the plane: 8 m above the ellipsoid at 10 km. Each step brings it
  // nearer by the square of how far the line is from upright, which is 0.016 at 100 km.
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    place.alt_m -= point.z();
    point = site.point_of(place);
  }
  return {point.x(), point.y()};
}

}  // namespace lapwing::map
