#include "map/store/rows/shapes.hpp"

#include <numbers>

#include "map/features/placement.hpp"

namespace lapwing::map::rows {

namespace {

using sql::LonLat;
using sql::LonLatArea;
using sql::LonLatLine;

constexpr double degree_rad = std::numbers::pi / 180.0;

LonLat on_globe(SitePoint const& point, geo::Site const& site) {
  auto const place = place_of(site, point);
  return {place.lon_deg(), place.lat_deg()};
}

LonLatLine on_globe(std::vector<SitePoint> const& points, geo::Site const& site) {
  LonLatLine line;
  line.reserve(points.size() + 1);
  for (auto const& point : points) line.push_back(on_globe(point, site));
  return line;
}

SitePoint on_site(LonLat const& place, geo::Site const& site) {
  return point_of(site, place.lon_deg * degree_rad, place.lat_deg * degree_rad);
}

std::vector<SitePoint> on_site(LonLatLine const& line, geo::Site const& site) {
  std::vector<SitePoint> points;
  points.reserve(line.size());
  for (auto const& place : line) points.push_back(on_site(place, site));
  return points;
}

}  // namespace

sql::LonLatGeometry on_globe(Geometry const& geometry, geo::Site const& site) {
  if (auto const* point = std::get_if<SitePoint>(&geometry)) return on_globe(*point, site);
  if (auto const* line = std::get_if<LineString>(&geometry)) return on_globe(line->points, site);
  LonLatArea area;
  for (auto const& ring : std::get<SitePolygon>(geometry).rings) {
    auto corners = on_globe(ring, site);
    if (corners.empty()) continue;
    corners.push_back(corners.front());
    area.push_back(std::move(corners));
  }
  return area;
}

Geometry on_site(sql::LonLatGeometry const& geometry, geo::Site const& site) {
  if (auto const* place = std::get_if<LonLat>(&geometry)) return on_site(*place, site);
  if (auto const* line = std::get_if<LonLatLine>(&geometry)) return LineString{on_site(*line, site)};
  SitePolygon polygon;
  for (auto ring : std::get<LonLatArea>(geometry)) {
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    polygon.rings.push_back(on_site(ring, site));
  }
  return polygon;
}

}  // namespace lapwing::map::rows
