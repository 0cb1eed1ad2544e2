// Writes plans as GeoJSON (RFC 7946): what there is no geometry for stands in the properties.
#include "plan/files/internal/json_node.hpp"

namespace lapwing::plan::internal {
namespace {

using Ordered = nlohmann::ordered_json;

Ordered position_json(geo::Wgs84 const& place, bool has_height) {
  auto json = Ordered::array({file_degrees(place.lon_deg()), file_degrees(place.lat_deg())});
  if (has_height) json.push_back(place.alt_m);
  return json;
}

Ordered point(geo::Wgs84 const& place, bool has_height) {
  return {{"type", "Point"}, {"coordinates", position_json(place, has_height)}};
}

Ordered feature(Ordered geometry, Ordered properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

Ordered item_feature(mavlink::MissionItem const& item, std::size_t number) {
  auto const values = from_item(item);
  bool const has_place = is_placed(item);
  auto params = Ordered::array();
  std::size_t const count = has_place ? item.params.size() : values.params.size();
  for (std::size_t i = 0; i < count; ++i) params.push_back(base::json_number<Ordered>(values.params[i]));
  Ordered properties{{"seq", number},
                     {"name", to_string(item.command)},
                     {"command", static_cast<int>(item.command)},
                     {"frame", static_cast<int>(item.frame)},
                     {"params", std::move(params)},
                     {"autocontinue", item.autocontinue}};
  return feature(has_place ? point(position_of(item), true) : Ordered(nullptr), std::move(properties));
}

/// For whoever looks at it; our reader takes the items.
void add_path(std::vector<mavlink::MissionItem> const& items, Ordered& features) {
  auto line = Ordered::array();
  for (auto const& item : items)
    if (is_placed(item) && has_position(item)) line.push_back(position_json(position_of(item), true));
  constexpr std::size_t shortest = 2;
  if (line.size() < shortest) return;
  features.push_back(feature({{"type", "LineString"}, {"coordinates", std::move(line)}}, {{"role", "path"}}));
}

void add_mission(Plan const& plan, Ordered& features) {
  if (plan.mission.planned_home)
    features.push_back(feature(point(*plan.mission.planned_home, true), {{"role", "home"}}));
  add_path(plan.mission.items, features);
  for (std::size_t i = 0; i < plan.mission.items.size(); ++i)
    features.push_back(item_feature(plan.mission.items[i], i + 1));
  for (auto const& pattern : plan.patterns) {
    features.push_back(feature(nullptr, {{"role", "pattern"},
                                         {"first", pattern.first + 1},
                                         {"count", pattern.count},
                                         {"source", Ordered(pattern_json(plan, pattern))}}));
  }
}

void add_limit(std::string_view which, std::optional<HeightLimit> const& limit, Ordered& properties) {
  if (!limit) return;
  properties[fmt::format("{}_{}", which, limit->is_above_sea ? "altitude_m" : "height_m")] = limit->height_m;
}

Ordered polygon_json(GeoPolygon const& polygon) {
  auto rings = Ordered::array();
  for (auto const& ring : polygon.rings) {
    auto corners = Ordered::array();
    for (auto const& corner : ring) corners.push_back(position_json(corner, false));
    corners.push_back(position_json(ring.front(), false));
    rings.push_back(std::move(corners));
  }
  return rings;
}

Ordered zone_feature(GeoZone const& zone) {
  Ordered properties{{"role", "fence"}, {"fence", zone.kind == Zone::Kind::inclusion ? "inclusion" : "exclusion"}};
  if (!zone.name.empty()) properties["name"] = zone.name;
  add_limit("min", zone.lowest, properties);
  add_limit("max", zone.highest, properties);
  if (auto const* circle = std::get_if<GeoCircle>(&zone.area)) {
    properties["radius_m"] = circle->radius_m;
    return feature(point(circle->center, false), std::move(properties));
  }
  auto const& polygons = std::get<std::vector<GeoPolygon>>(zone.area);
  if (polygons.size() == 1)
    return feature({{"type", "Polygon"}, {"coordinates", polygon_json(polygons[0])}}, std::move(properties));
  auto coordinates = Ordered::array();
  for (auto const& polygon : polygons) coordinates.push_back(polygon_json(polygon));
  return feature({{"type", "MultiPolygon"}, {"coordinates", std::move(coordinates)}}, std::move(properties));
}

}  // namespace

std::string write_geojson(Plan const& plan) {
  Ordered json{{"type", "FeatureCollection"}};
  if (plan.cruise_speed_m_s) json["cruise_speed_m_s"] = *plan.cruise_speed_m_s;
  if (plan.hover_speed_m_s) json["hover_speed_m_s"] = *plan.hover_speed_m_s;
  if (plan.firmware_type != 0) json["firmware_type"] = plan.firmware_type;
  if (plan.vehicle_type != 0) json["vehicle_type"] = plan.vehicle_type;
  auto features = Ordered::array();
  add_mission(plan, features);
  for (auto const& zone : plan.fence.zones) features.push_back(zone_feature(zone));
  if (plan.fence.breach_return)
    features.push_back(feature(point(*plan.fence.breach_return, true), {{"role", "breach_return"}}));
  for (auto const& rally : plan.rally)
    features.push_back(
        feature(point(rally.place, true), {{"role", "rally"}, {"frame", static_cast<int>(rally.frame)}}));
  json["features"] = std::move(features);
  return base::to_text(json, 1) + "\n";
}

}  // namespace lapwing::plan::internal
