#include "formats/internal/site_records.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ogr_geometry.h>

#include <string>
#include <utility>
#include <vector>

#include "formats/internal/field_values.hpp"

namespace lapwing::formats::internal {

namespace {

using map::PropertyKind;
using Json = nlohmann::ordered_json;

Json floors_json(geo::Site const& site) {
  auto floors = Json::array();
  for (auto const& floor : site.floors()) {
    auto const origin = floor.site_from_floor.origin();
    floors.push_back({{"id", floor.id},
                      {"name", floor.name},
                      {"up_m", floor.up_m},
                      {"x_m", origin.x()},
                      {"y_m", origin.y()},
                      {"yaw_rad", floor.site_from_floor.yaw_rad()}});
  }
  return floors;
}

geo::Floor floor_in(Json const& json) {
  return {.id = json.at("id").get<std::string>(),
          .name = json.value("name", std::string()),
          .up_m = json.value("up_m", 0.0),
          .site_from_floor = {geo::Point<geo::SiteFrame>(json.value("x_m", 0.0), json.value("y_m", 0.0)),
                              json.value("yaw_rad", 0.0)}};
}

base::Result<std::vector<geo::Floor>> floors_in(std::string const& text) {
  std::vector<geo::Floor> floors;
  if (text.empty()) return floors;
  try {
    for (auto const& floor : Json::parse(text)) floors.push_back(floor_in(floor));
  } catch (Json::exception const& exception) {
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("its `floors` are no list of floors: {}", exception.what()));
  }
  return floors;
}

}  // namespace

void define_site(OGRFeatureDefn& definition) {
  define(definition, "id", PropertyKind::text, Times::as_text);
  define(definition, "altitude_m", PropertyKind::real, Times::as_text);
  define(definition, "floors", PropertyKind::text, Times::as_text);
}

void write_site(OGRFeature& feature, geo::Site const& site) {
  OGRPoint const anchor(site.anchor().lon_deg(), site.anchor().lat_deg());
  feature.SetGeometry(&anchor);
  feature.SetField("id", site.id().c_str());
  feature.SetField("altitude_m", site.anchor().alt_m);
  feature.SetField("floors", floors_json(site).dump().c_str());
}

base::Result<geo::Site> read_site(OGRFeature const& feature) {
  auto const* geometry = feature.GetGeometryRef();
  if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbPoint || geometry->IsEmpty() != 0)
    return base::fail(base::ErrorKind::invalid_input, "a site is a point, at its anchor");
  auto const text = [&](char const* name) {
    int const field = feature.GetFieldIndex(name);
    return field < 0 ? std::string() : std::string(feature.GetFieldAsString(field));
  };
  int const altitude = feature.GetFieldIndex("altitude_m");
  auto floors = floors_in(text("floors"));
  if (!floors) return std::unexpected(floors.error());
  auto const anchor = geo::Wgs84::from_degrees(geometry->toPoint()->getY(), geometry->toPoint()->getX(),
                                               altitude < 0 ? 0.0 : feature.GetFieldAsDouble(altitude));
  return geo::Site::make(text("id"), anchor, std::move(*floors));
}

}  // namespace lapwing::formats::internal
