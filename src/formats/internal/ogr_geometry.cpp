#include "formats/internal/ogr_geometry.hpp"

#include <fmt/format.h>

#include <numbers>
#include <variant>
#include <vector>

#include "map/features/placement.hpp"

namespace lapwing::formats::internal {

namespace {

using map::SitePoint;

void add_point(OGRSimpleCurve& curve, SitePoint const& point, geo::Site const& site) {
  auto const place = map::place_of(site, point);
  curve.addPoint(place.lon_deg(), place.lat_deg());
}

SitePoint point_in(double lon_deg, double lat_deg, geo::Site const& site) {
  constexpr double radians = std::numbers::pi / 180.0;
  return map::point_of(site, lon_deg * radians, lat_deg * radians);
}

std::unique_ptr<OGRGeometry> globe_point(SitePoint const& point, geo::Site const& site) {
  auto const place = map::place_of(site, point);
  return std::make_unique<OGRPoint>(place.lon_deg(), place.lat_deg());
}

std::unique_ptr<OGRGeometry> globe_line(map::LineString const& line, geo::Site const& site) {
  auto drawn = std::make_unique<OGRLineString>();
  for (auto const& point : line.points) add_point(*drawn, point, site);
  return drawn;
}

std::unique_ptr<OGRGeometry> globe_polygon(map::SitePolygon const& polygon, geo::Site const& site) {
  auto drawn = std::make_unique<OGRPolygon>();
  for (std::size_t i = 0; i < polygon.rings.size(); ++i) {
    auto ring = std::make_unique<OGRLinearRing>();
    for (auto const& point : polygon.rings[i]) add_point(*ring, point, site);
    ring->closeRings();
    bool const is_outer = i == 0;
    if ((ring->isClockwise() != 0) == is_outer) ring->reverseWindingOrder();
    drawn->addRingDirectly(ring.release());
  }
  return drawn;
}

std::vector<SitePoint> points_in(OGRSimpleCurve const& curve, geo::Site const& site) {
  std::vector<SitePoint> points;
  points.reserve(static_cast<std::size_t>(curve.getNumPoints()));
  for (int i = 0; i < curve.getNumPoints(); ++i) points.push_back(point_in(curve.getX(i), curve.getY(i), site));
  return points;
}

map::SitePolygon polygon_in(OGRPolygon const& polygon, geo::Site const& site) {
  map::SitePolygon drawn;
  for (auto const* ring : polygon) {
    auto corners = points_in(*ring, site);
    // Files repeat the first corner at the end.
    bool const is_closed = ring->getNumPoints() > 1 && ring->getX(0) == ring->getX(ring->getNumPoints() - 1) &&
                           ring->getY(0) == ring->getY(ring->getNumPoints() - 1);
    if (is_closed) corners.pop_back();
    drawn.rings.push_back(std::move(corners));
  }
  return drawn;
}

}  // namespace

std::unique_ptr<OGRGeometry> on_globe(map::Geometry const& geometry, geo::Site const& site) {
  if (auto const* point = std::get_if<SitePoint>(&geometry)) return globe_point(*point, site);
  if (auto const* line = std::get_if<map::LineString>(&geometry)) return globe_line(*line, site);
  return globe_polygon(std::get<map::SitePolygon>(geometry), site);
}

base::Result<map::Geometry> in_site(OGRGeometry const& geometry, geo::Site const& site) {
  if (geometry.IsEmpty() != 0) return base::fail(base::ErrorKind::invalid_input, "its geometry is empty");
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPoint: {
      auto const* point = geometry.toPoint();
      return point_in(point->getX(), point->getY(), site);
    }
    case wkbLineString: return map::LineString{points_in(*geometry.toLineString(), site)};
    case wkbPolygon: return polygon_in(*geometry.toPolygon(), site);
    case wkbMultiPoint:
    case wkbMultiLineString:
    case wkbMultiPolygon:
    case wkbGeometryCollection: {
      auto const* collection = geometry.toGeometryCollection();
      if (collection->getNumGeometries() == 1) return in_site(*collection->getGeometryRef(0), site);
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("its geometry has {} parts", collection->getNumGeometries()),
                        "split it into features of one part each");
    }
    default:
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("its geometry is a {}, neither a point, a line string nor a polygon",
                                    geometry.getGeometryName()));
  }
}

}  // namespace lapwing::formats::internal
