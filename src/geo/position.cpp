#include "geo/position.hpp"

#include <cmath>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>

namespace lapwing::geo {

namespace {

GeographicLib::Geodesic const& geodesic() {
  return GeographicLib::Geodesic::WGS84();
}

GeographicLib::LocalCartesian cartesian_at(Wgs84 anchor) {
  return {anchor.lat_deg(), anchor.lon_deg(), anchor.alt_m, GeographicLib::Geocentric::WGS84()};
}

}  // namespace

Ned LocalFrame::ned_from(Wgs84 place) const {
  double east = 0.0;
  double north = 0.0;
  double up = 0.0;
  cartesian_at(anchor_).Forward(place.lat_deg(), place.lon_deg(), place.alt_m, east, north, up);
  return {north, east, -up};
}

Wgs84 LocalFrame::place_at(Ned offset) const {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  double alt_m = 0.0;
  cartesian_at(anchor_).Reverse(offset.east, offset.north, -offset.down, lat_deg, lon_deg, alt_m);
  return Wgs84::from_degrees(lat_deg, lon_deg, alt_m);
}

Wgs84 displaced(Wgs84 base, Ned offset) {
  auto place = LocalFrame(base).place_at(offset);
  place.alt_m = base.alt_m - offset.down;
  return place;
}

double surface_distance_m(Wgs84 a, Wgs84 b) {
  double length_m = 0.0;
  geodesic().Inverse(a.lat_deg(), a.lon_deg(), b.lat_deg(), b.lon_deg(), length_m);
  return length_m;
}

double distance_m(Wgs84 a, Wgs84 b) {
  double ax = 0.0, ay = 0.0, az = 0.0, bx = 0.0, by = 0.0, bz = 0.0;
  auto const& earth = GeographicLib::Geocentric::WGS84();
  earth.Forward(a.lat_deg(), a.lon_deg(), a.alt_m, ax, ay, az);
  earth.Forward(b.lat_deg(), b.lon_deg(), b.alt_m, bx, by, bz);
  return std::hypot(bx - ax, by - ay, bz - az);
}

double bearing_rad(Wgs84 from, Wgs84 to) {
  double azimuth_from_deg = 0.0;
  double azimuth_to_deg = 0.0;
  geodesic().Inverse(from.lat_deg(), from.lon_deg(), to.lat_deg(), to.lon_deg(), azimuth_from_deg, azimuth_to_deg);
  return wrap_two_pi(azimuth_from_deg * std::numbers::pi / 180.0);
}

double wrap_two_pi(double angle_rad) {
  double const wrapped = std::fmod(angle_rad, 2.0 * std::numbers::pi);
  // fmod of a tiny negative angle plus 2 pi rounds to 2 pi itself, which is outside the half-open range.
  double const positive = wrapped < 0.0 ? wrapped + 2.0 * std::numbers::pi : wrapped;
  return positive < 2.0 * std::numbers::pi ? positive : 0.0;
}

double wrap_pi(double angle_rad) {
  double const wrapped = wrap_two_pi(angle_rad + std::numbers::pi) - std::numbers::pi;
  return wrapped;
}

}  // namespace lapwing::geo
