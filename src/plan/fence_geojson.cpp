#include "plan/fence_geojson.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lapwing::plan {

using base::ErrorKind;
using base::Result;
using nlohmann::json;

namespace {

std::unexpected<base::Error> wrong(std::string const& path, std::string_view what, std::string hint = {}) {
  return base::fail(ErrorKind::invalid_input, fmt::format("fence: {}: {}", path, what), std::move(hint));
}

/// The text of a member, or nothing.
std::optional<std::string> text_of(json const& object, char const* key) {
  auto const found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// Fits messages on a line.
std::string shown(std::string text) {
  constexpr std::size_t longest = 40;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

class Reader {
 public:
  explicit Reader(geo::Wgs84 home) : home_(home), frame_(home) {}

  Result<Fence> read(json const& document) {
    auto const type = text_of(document, "type");
    Result<> done;
    if (type == "FeatureCollection") {
      done = collection(document);
    } else if (type == "Feature") {
      done = feature(document, "$");
    } else {
      done = zone(document, json::object(), "$", "$");
    }
    if (!done) return std::unexpected(done.error());
    if (fence_.zones.empty()) return wrong("$", "there is no area in it");
    return std::move(fence_);
  }

 private:
  Result<> collection(json const& document) {
    auto const features = document.find("features");
    if (features == document.end() || !features->is_array()) return wrong("$.features", "an array is missing");
    for (std::size_t i = 0; i < features->size(); ++i)
      if (auto done = feature((*features)[i], fmt::format("$.features[{}]", i)); !done) return done;
    return {};
  }

  Result<> feature(json const& object, std::string const& path) {
    if (text_of(object, "type") != "Feature") return wrong(path, "is no Feature");
    auto const geometry = object.find("geometry");
    if (geometry == object.end()) return wrong(path, "has no geometry");
    auto const properties = object.find("properties");
    bool const has_properties = properties != object.end() && properties->is_object();
    return zone(*geometry, has_properties ? *properties : json::object(), path + ".geometry", path + ".properties");
  }

  Result<> zone(json const& geometry, json const& properties, std::string const& path, std::string const& about) {
    if (fence_.zones.size() == max_fence_zones) return wrong(path, fmt::format("more than {} zones", max_fence_zones));
    Zone zone;
    zone.name = shown(text_of(properties, "name").value_or(fmt::format("zone {}", fence_.zones.size() + 1)));
    auto const kind = text_of(properties, "fence").value_or("inclusion");
    if (kind != "inclusion" && kind != "exclusion") {
      return wrong(about + ".fence", fmt::format("'{}' is no kind of fence", shown(kind)),
                   "use inclusion (stay inside, the default) or exclusion (stay outside)");
    }
    zone.kind = kind == "inclusion" ? Zone::Kind::inclusion : Zone::Kind::exclusion;
    if (auto done = limits(properties, about, zone); !done) return done;
    if (auto done = shape(geometry, properties, path, zone); !done) return done;
    fence_.zones.push_back(std::move(zone));
    return {};
  }

  Result<> limits(json const& properties, std::string const& about, Zone& zone) const {
    auto const take = [&](char const* key, double zero_m, std::optional<double>& limit) -> Result<> {
      auto const found = properties.find(key);
      if (found == properties.end() || found->is_null()) return {};
      if (!found->is_number()) return wrong(fmt::format("{}.{}", about, key), "is no number of metres");
      if (limit) return wrong(fmt::format("{}.{}", about, key), "says height and altitude: give one of them");
      limit = found->get<double>() - zero_m;
      return {};
    };
    for (auto const& [key, zero_m, limit] :
         {std::tuple{"min_height_m", 0.0, &zone.lowest_m}, std::tuple{"max_height_m", 0.0, &zone.highest_m},
          std::tuple{"min_altitude_m", home_.alt_m, &zone.lowest_m},
          std::tuple{"max_altitude_m", home_.alt_m, &zone.highest_m}}) {
      if (auto done = take(key, zero_m, *limit); !done) return done;
    }
    if (zone.lowest_m && zone.highest_m && *zone.lowest_m >= *zone.highest_m)
      return wrong(about, "the lower limit of height is not below the upper one");
    return {};
  }

  Result<> shape(json const& geometry, json const& properties, std::string const& path, Zone& zone) {
    auto const type = text_of(geometry, "type");
    if (!type) return wrong(path, "is no GeoJSON geometry");
    auto const coordinates = geometry.find("coordinates");
    auto const place = path + ".coordinates";
    if (coordinates == geometry.end() || !coordinates->is_array()) return wrong(place, "an array is missing");
    if (*type == "Polygon") return polygon(*coordinates, place, zone);
    if (*type == "MultiPolygon") {
      for (std::size_t i = 0; i < coordinates->size(); ++i)
        if (auto done = polygon((*coordinates)[i], fmt::format("{}[{}]", place, i), zone); !done) return done;
      if (zone.polygons.empty()) return wrong(place, "there is no polygon in it");
      return {};
    }
    if (*type == "Point") return circle(*coordinates, properties, place, zone);
    return wrong(path + ".type", fmt::format("{} encloses no area", shown(*type)),
                 "a fence is made of Polygon, MultiPolygon, or Point with the property radius_m");
  }

  Result<> polygon(json const& rings, std::string const& path, Zone& zone) {
    if (!rings.is_array() || rings.empty()) return wrong(path, "there is no ring in it");
    Polygon polygon;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      auto ring = read_ring(rings[i], fmt::format("{}[{}]", path, i));
      if (!ring) return std::unexpected(ring.error());
      polygon.rings.push_back(std::move(*ring));
    }
    zone.polygons.push_back(std::move(polygon));
    return {};
  }

  Result<Ring> read_ring(json const& positions, std::string const& path) {
    if (!positions.is_array()) return wrong(path, "is no array of positions");
    Ring ring;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      auto const point = corner(positions[i], fmt::format("{}[{}]", path, i));
      if (!point) return std::unexpected(point.error());
      ring.push_back(*point);
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3) return wrong(path, "a ring needs at least three corners");
    return ring;
  }

  Result<LevelPoint> corner(json const& position, std::string const& path) {
    if (++corners_ > max_fence_corners) return wrong(path, fmt::format("more than {} corners", max_fence_corners));
    bool const is_position =
        position.is_array() && position.size() >= 2 && position[0].is_number() && position[1].is_number();
    if (!is_position) return wrong(path, "is no position [longitude, latitude]");
    double const lon_deg = position[0].get<double>();
    double const lat_deg = position[1].get<double>();
    constexpr auto order = "GeoJSON writes longitude first: [longitude, latitude]";
    if (!(std::abs(lat_deg) <= 90.0)) return wrong(path, fmt::format("{} is no latitude", lat_deg), order);
    if (!(std::abs(lon_deg) <= 180.0)) return wrong(path, fmt::format("{} is no longitude", lon_deg), order);
    auto const place = geo::Wgs84::from_degrees(lat_deg, lon_deg, home_.alt_m);
    double const distance_m = geo::surface_distance_m(home_, place);
    if (distance_m > max_fence_distance_m)
      return wrong(path, fmt::format("is {:.0f} km away from home", distance_m / 1000.0), order);
    auto const local = frame_.ned_from(place);
    return LevelPoint{local.north, local.east};
  }

  Result<> circle(json const& position, json const& properties, std::string const& path, Zone& zone) {
    auto const radius = properties.find("radius_m");
    bool const has_radius = radius != properties.end() && radius->is_number();
    if (!has_radius || !(radius->get<double>() > 0.0) || !(radius->get<double>() <= max_fence_distance_m))
      return wrong(path, "a Point needs the property radius_m, a number of metres");
    auto const center = corner(position, path);
    if (!center) return std::unexpected(center.error());
    constexpr int corners = 180;
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      double const angle = 2.0 * std::numbers::pi * i / corners;
      ring.push_back({center->north_m + radius->get<double>() * std::cos(angle),
                      center->east_m + radius->get<double>() * std::sin(angle)});
    }
    corners_ += corners;
    zone.polygons.push_back({{std::move(ring)}});
    return {};
  }

  geo::Wgs84 home_;
  geo::LocalFrame frame_;
  Fence fence_;
  std::size_t corners_ = 0;
};

}  // namespace

Result<Fence> read_fence(std::string_view geojson, geo::Wgs84 home) {
  if (geojson.size() > max_fence_bytes) {
    return base::fail(ErrorKind::invalid_input, fmt::format("fence: {} MB is too large (limit {} MB)",
                                                            geojson.size() >> 20U, max_fence_bytes >> 20U));
  }
  json document;
  try {
    document = json::parse(geojson);
  } catch (json::parse_error const& error) {
    auto const read = geojson.substr(0, std::min(error.byte, geojson.size()));
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("fence: line {}: this is no JSON", 1 + std::ranges::count(read, '\n')));
  } catch (json::exception const& error) {  // a number beyond a double
    return base::fail(ErrorKind::invalid_input, fmt::format("fence: {}", error.what()));
  }
  return Reader(home).read(document);
}

}  // namespace lapwing::plan
