#include "map/features/feature_json.hpp"

#include <algorithm>

#include "base/text/utc_text.hpp"
#include "map/features/placement.hpp"

namespace lapwing::map {

namespace {

constexpr int degree_decimals = 9;

Json coordinates_of(SitePoint const& point, geo::Site const& site) {
  auto const place = place_of(site, point);
  return Json::array({geo::rounded(place.lon_deg(), degree_decimals), geo::rounded(place.lat_deg(), degree_decimals)});
}

/// Closed, from its first corner on, whichever way round it is to go.
Json coordinates_of(geo::Ring<geo::SiteFrame> ring, bool is_outer, geo::Site const& site) {
  if (geo::is_counterclockwise(ring) != is_outer) std::reverse(std::next(ring.begin()), ring.end());
  auto coordinates = Json::array();
  for (auto const& corner : ring) coordinates.push_back(coordinates_of(corner, site));
  coordinates.push_back(coordinates.front());
  return coordinates;
}

struct GeometryJson {
  geo::Site const& site;

  Json operator()(SitePoint const& point) const {
    return {{"type", "Point"}, {"coordinates", coordinates_of(point, site)}};
  }
  Json operator()(LineString const& line) const {
    auto coordinates = Json::array();
    for (auto const& point : line.points) coordinates.push_back(coordinates_of(point, site));
    return {{"type", "LineString"}, {"coordinates", std::move(coordinates)}};
  }
  Json operator()(SitePolygon const& polygon) const {
    auto coordinates = Json::array();
    for (auto const& ring : polygon.rings) coordinates.push_back(coordinates_of(ring, coordinates.empty(), site));
    return {{"type", "Polygon"}, {"coordinates", std::move(coordinates)}};
  }
};

struct ValueJson {
  Json operator()(std::monostate /*nothing*/) const { return nullptr; }
  Json operator()(base::UtcTime time) const { return base::utc_text(time); }
  template <class Plain>
  Json operator()(Plain const& value) const {
    return value;
  }
};

Json held_over_json(std::vector<HeldOver> const& held_over) {
  auto list = Json::array();
  for (auto const& held : held_over)
    list.push_back(
        Json{{"property", held.property}, {"writer", held.account.writer}, {"at", base::utc_text(held.account.at)}});
  return list;
}

}  // namespace

Json property_json(PropertyValue const& value) {
  return std::visit(ValueJson(), value);
}

Json geometry_json(Geometry const& geometry, geo::Site const& site) {
  return std::visit(GeometryJson{site}, geometry);
}

Json feature_json(Feature const& feature, geo::Site const& site) {
  Json properties = {{"site", feature.site}};
  if (!feature.floor.empty()) properties["floor"] = feature.floor;
  properties["writer"] = feature.account.writer;
  properties["at"] = base::utc_text(feature.account.at);
  if (!feature.held_over.empty()) properties["held_over"] = held_over_json(feature.held_over);
  for (auto const& property : properties_of(layer_of(feature.content)))
    if (auto value = property_json(property.get(feature.content)); !value.is_null())
      properties[std::string(property.name)] = std::move(value);
  return {{"type", "Feature"},
          {"id", feature.id},
          {"geometry", geometry_json(geometry_of(feature.content), site)},
          {"properties", std::move(properties)}};
}

std::string held_over_text(std::vector<HeldOver> const& held_over) {
  return held_over.empty() ? std::string() : held_over_json(held_over).dump();
}

}  // namespace lapwing::map
