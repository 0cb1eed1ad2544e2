// Reads plans and fences from GeoJSON (RFC 7946): longitude first.
#include <algorithm>
#include <array>
#include <cmath>

#include "plan/files/internal/json_node.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;

/// Fits messages on a line.
std::string shown(std::string text) {
  constexpr std::size_t longest = 40;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

struct Position {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  std::optional<double> alt_m;
};

Result<Position> read_position(Node const& node) {
  constexpr auto order = "GeoJSON writes longitude first: [longitude, latitude]";
  auto const& json = node.json();
  bool const is_position = json.is_array() && json.size() >= 2 &&
                           std::ranges::all_of(json, [](auto const& value) { return value.is_number(); });
  if (!is_position) return wrong(node.path(), "is no position [longitude, latitude]");
  Position const position{.lat_deg = json[1].get<double>(),
                          .lon_deg = json[0].get<double>(),
                          .alt_m = json.size() > 2 ? std::optional(json[2].get<double>()) : std::nullopt};
  if (!(std::abs(position.lat_deg) <= 90.0))
    return wrong(node.path(), fmt::format("{} is no latitude", position.lat_deg), order);
  if (!(std::abs(position.lon_deg) <= 180.0))
    return wrong(node.path(), fmt::format("{} is no longitude", position.lon_deg), order);
  return position;
}

Result<geo::Wgs84> read_place(Node const& node) {
  auto const position = read_position(node);
  if (!position) return std::unexpected(position.error());
  auto const place = to_place(position->lat_deg, position->lon_deg, position->alt_m.value_or(0.0));
  if (!place) return wrong(node.path(), place.error().message);
  return place;
}

class Reader {
 public:
  Reader(std::string_view file, PlanReadOptions const& options) : file_(file), options_(options) {}

  Result<PlanFile> read(Node const& document) {
    auto const type = document.text_or("type", "");
    Result<> done;
    if (type == "FeatureCollection") {
      done = collection(document);
    } else if (type == "Feature") {
      done = feature(document);
    } else {
      static Json const no_properties = Json::object();
      done = shape(document, Node(no_properties, document.path() + ".properties"));
    }
    if (done) done = check_jumps();
    if (!done) return std::unexpected(done.error());
    return std::move(read_);
  }

 private:
  Plan& plan() { return read_.plan; }

  Result<> collection(Node const& document) {
    auto const features = document.list("features");
    if (!features) return std::unexpected(features.error());
    if (auto done = settings(document); !done) return done;
    for (std::size_t i = 0; i < features->size(); ++i)
      if (auto done = feature(features->item(i)); !done) return done;
    return {};
  }

  Result<> settings(Node const& document) {
    auto const speed = [&](char const* key) {
      return document.has(key) ? std::optional(document.number_or(key, 0.0)) : std::nullopt;
    };
    constexpr double most_kinds = 255.0;
    plan().cruise_speed_m_s = speed("cruise_speed_m_s");
    plan().hover_speed_m_s = speed("hover_speed_m_s");
    plan().firmware_type = static_cast<int>(std::clamp(document.number_or("firmware_type", 0.0), 0.0, most_kinds));
    plan().vehicle_type = static_cast<int>(std::clamp(document.number_or("vehicle_type", 0.0), 0.0, most_kinds));
    return {};
  }

  Result<> feature(Node const& node) {
    if (node.text_or("type", "") != "Feature") return wrong(node.path(), "is no Feature");
    auto const geometry = node.member("geometry");
    if (!geometry) return wrong(node.path(), "has no geometry");
    static Json const none = Json::object();
    bool const has_properties = node.has("properties") && node.json()["properties"].is_object();
    Node const properties(has_properties ? node.json()["properties"] : none, node.path() + ".properties");
    if (properties.text_or("role", "") == "pattern") return pattern(properties);
    if (properties.has("command")) return item(*geometry, properties);
    return shape(*geometry, properties);
  }

  /// Whatever has no command of its own.
  Result<> shape(Node const& geometry, Node const& properties) {
    auto const role = properties.text_or("role", "");
    if (role == "path") return {};  // drawn from the items
    auto const type = geometry.text_or("type", "");
    if (type.empty()) return wrong(geometry.path(), "is no GeoJSON geometry");
    auto const coordinates = geometry.list("coordinates");
    if (!coordinates) return wrong(geometry.path() + ".coordinates", "an array is missing");
    if (type == "Polygon" || type == "MultiPolygon") return areas(*coordinates, type == "MultiPolygon", properties);
    if (type == "Point" && properties.has("radius_m")) return circle(*coordinates, properties);
    if (type == "Point" && !role.empty()) return marked(*coordinates, properties, role);
    if (type == "Point") return way_point(*coordinates, properties);
    if (type == "LineString" || type == "MultiPoint") {
      for (std::size_t i = 0; i < coordinates->size(); ++i)
        if (auto done = way_point(coordinates->item(i), properties); !done) return done;
      return {};
    }
    return wrong(geometry.path() + ".type", fmt::format("a {} is no part of a plan", shown(type)),
                 "plans are made of Point, LineString, Polygon and MultiPolygon");
  }

  Result<> marked(Node const& coordinates, Node const& properties, std::string const& role) {
    auto const place = read_place(coordinates);
    if (!place) return std::unexpected(place.error());
    if (role == "home") {
      plan().mission.planned_home = *place;
    } else if (role == "breach_return") {
      plan().fence.breach_return = *place;
    } else if (role == "rally") {
      if (plan().rally.size() >= max_mission_items)
        return wrong(coordinates.path(), "more rally points than a vehicle can hold");
      auto const frame = read_frame(properties, mavlink::MavFrame::global_relative_alt);
      if (!frame) return std::unexpected(frame.error());
      plan().rally.push_back({.place = *place, .frame = *frame});
    } else {
      return wrong(properties.path() + ".role", fmt::format("'{}' is no role of a point", shown(role)),
                   "roles are home, rally and breach_return");
    }
    return {};
  }

  static Result<mavlink::MavFrame> read_frame(Node const& properties, mavlink::MavFrame otherwise) {
    if (!properties.has("frame")) return otherwise;
    double const number = properties.number_or("frame", -1.0);
    auto const frame =
        static_cast<mavlink::MavFrame>(number >= 0.0 && number <= 255.0 ? static_cast<int>(number) : 255);
    if (!mavlink::is_global(frame))
      return wrong(properties.path() + ".frame", "heights count from the sea (0), home (3) or the terrain (10)");
    return frame;
  }

  Result<> way_point(Node const& coordinates, Node const& properties) {
    auto const position = read_position(coordinates);
    if (!position) return std::unexpected(position.error());
    auto const frame = read_frame(properties, mavlink::MavFrame::global);
    if (!frame) return std::unexpected(frame.error());
    auto const from = way_point_at(position->lat_deg, position->lon_deg, position->alt_m, *frame, options_);
    if (!from) return wrong(coordinates.path(), from.error().message, from.error().hint);
    return add(*from, coordinates.path());
  }

  Result<> add(FileItem const& from, std::string const& path) {
    auto& items = plan().mission.items;
    if (items.size() >= max_mission_items) return wrong(path, "more items than a mission can hold");
    auto const item = to_item(from);
    if (!item) return wrong(path, item.error().message, item.error().hint);
    items.push_back(*item);
    return {};
  }

  /// One item of a mission, with all that MAVLink has of it.
  Result<> item(Node const& geometry, Node const& properties) {
    FileItem from;
    auto const command = properties.number("command");
    auto const frame = properties.number("frame");
    auto const params = properties.numbers("params", from.params.size());
    if (!command) return std::unexpected(command.error());
    if (!frame) return std::unexpected(frame.error());
    if (!params) return std::unexpected(params.error());
    from.command = *command;
    from.frame = *frame;
    from.params.fill(unset);
    std::ranges::copy(*params, from.params.begin());
    from.autocontinue = properties.flag_or("autocontinue", true);
    if (geometry.json().is_null()) return add(from, properties.path());
    auto const coordinates = geometry.list("coordinates");
    if (geometry.text_or("type", "") != "Point" || !coordinates)
      return wrong(geometry.path(), "an item with a command is a Point, or has no geometry");
    auto const position = read_position(*coordinates);
    if (!position) return std::unexpected(position.error());
    if (!position->alt_m)
      return wrong(coordinates->path(), "an item with a command needs its height, the third number");
    from.params[4] = position->lat_deg;
    from.params[5] = position->lon_deg;
    from.params[6] = *position->alt_m;
    return add(from, geometry.path());
  }

  Result<> pattern(Node const& properties) {
    auto const first = properties.number("first");
    auto const count = properties.number("count");
    auto const source = properties.member("source");
    if (!first) return std::unexpected(first.error());
    if (!count) return std::unexpected(count.error());
    if (!source) return std::unexpected(source.error());
    auto const items = static_cast<double>(plan().mission.items.size());
    auto const begin = plan().patterns.empty() ? 0 : plan().patterns.back().first + plan().patterns.back().count;
    bool const fits = *first >= 1.0 && *count >= 0.0 && *first == std::floor(*first) && *count == std::floor(*count) &&
                      *first - 1.0 >= static_cast<double>(begin) && *first - 1.0 + *count <= items;
    if (!fits) return wrong(properties.path(), "the items of a pattern come before it, and belong to no other pattern");
    Pattern read{.first = static_cast<std::size_t>(*first) - 1, .count = static_cast<std::size_t>(*count), .json = {}};
    auto const stored = count_items(source->json(), source->path());
    if (!stored) return std::unexpected(stored.error());
    if (*stored != read.count) return wrong(source->path(), fmt::format("is made of {} items", *stored));
    read.json = source->json().dump();
    plan().patterns.push_back(std::move(read));
    return {};
  }

  Result<> check_jumps() {
    auto const& items = plan().mission.items;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].command != mavlink::MavCmd::do_jump) continue;
      auto const target = items[i].params[0];
      if (!(target >= 1.0F && target <= static_cast<float>(items.size())))
        return wrong(file_, fmt::format("item {}: the jump leads to item {}, which is not there", i + 1, target));
    }
    return {};
  }

  Result<GeoZone> zone_of(Node const& properties, std::string const& path) {
    if (auto fits = budget_.take_zone(path); !fits) return std::unexpected(fits.error());
    GeoZone zone{.name = properties.text_or("name", ""), .area = {}};
    auto const kind = properties.text_or("fence", "inclusion");
    if (kind != "inclusion" && kind != "exclusion") {
      return wrong(properties.path() + ".fence", fmt::format("'{}' is no kind of fence", shown(kind)),
                   "use inclusion (stay inside, the default) or exclusion (stay outside)");
    }
    zone.kind = kind == "inclusion" ? Zone::Kind::inclusion : Zone::Kind::exclusion;
    if (auto done = limit(properties, "min", zone.lowest); !done) return std::unexpected(done.error());
    if (auto done = limit(properties, "max", zone.highest); !done) return std::unexpected(done.error());
    bool const one_scale = zone.lowest && zone.highest && zone.lowest->is_above_sea == zone.highest->is_above_sea;
    if (one_scale && zone.lowest->height_m >= zone.highest->height_m)
      return wrong(properties.path(), "the lower limit of height is not below the upper one");
    return zone;
  }

  static Result<> limit(Node const& properties, std::string_view which, std::optional<HeightLimit>& limit) {
    for (auto const& [ending, is_above_sea] : {std::pair{"height_m", false}, std::pair{"altitude_m", true}}) {
      auto const key = fmt::format("{}_{}", which, ending);
      if (!properties.has(key.c_str()) || properties.json()[key].is_null()) continue;
      auto const place = fmt::format("{}.{}", properties.path(), key);
      if (!properties.json()[key].is_number()) return wrong(place, "is no number of metres");
      if (limit) return wrong(place, "says height and altitude: give one of them");
      limit = HeightLimit{properties.json()[key].get<double>(), is_above_sea};
    }
    return {};
  }

  Result<> areas(Node const& coordinates, bool are_many, Node const& properties) {
    auto zone = zone_of(properties, coordinates.path());
    if (!zone) return std::unexpected(zone.error());
    std::vector<GeoPolygon> polygons;
    for (std::size_t i = 0; i < (are_many ? coordinates.size() : 1); ++i) {
      auto polygon = read_polygon(are_many ? coordinates.item(i) : coordinates);
      if (!polygon) return std::unexpected(polygon.error());
      polygons.push_back(*std::move(polygon));
    }
    if (polygons.empty()) return wrong(coordinates.path(), "there is no polygon in it");
    zone->area = std::move(polygons);
    plan().fence.zones.push_back(*std::move(zone));
    return {};
  }

  Result<GeoPolygon> read_polygon(Node const& rings) {
    if (!rings.json().is_array() || rings.size() == 0) return wrong(rings.path(), "there is no ring in it");
    GeoPolygon polygon;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      auto ring = read_ring(rings.item(i));
      if (!ring) return std::unexpected(ring.error());
      polygon.rings.push_back(*std::move(ring));
    }
    return polygon;
  }

  Result<GeoRing> read_ring(Node const& positions) {
    if (!positions.json().is_array()) return wrong(positions.path(), "is no array of positions");
    if (auto fits = budget_.take_corners(positions.path(), positions.size()); !fits)
      return std::unexpected(fits.error());
    GeoRing ring;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      auto const corner = read_position(positions.item(i));
      if (!corner) return std::unexpected(corner.error());
      ring.push_back(geo::Wgs84::from_degrees(corner->lat_deg, corner->lon_deg));
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3) return wrong(positions.path(), "a ring needs at least three corners");
    return ring;
  }

  Result<> circle(Node const& position, Node const& properties) {
    auto zone = zone_of(properties, position.path());
    if (!zone) return std::unexpected(zone.error());
    double const radius_m = properties.number_or("radius_m", 0.0);
    if (!is_radius(radius_m)) return wrong(properties.path() + ".radius_m", "is no radius, a number of metres");
    auto const center = read_position(position);
    if (!center) return std::unexpected(center.error());
    zone->area = GeoCircle{geo::Wgs84::from_degrees(center->lat_deg, center->lon_deg), radius_m};
    plan().fence.zones.push_back(*std::move(zone));
    return {};
  }

  std::string file_;
  PlanReadOptions const& options_;
  PlanFile read_{.plan = {}};
  FenceBudget budget_;
};

}  // namespace

Result<PlanFile> read_geojson(std::string_view file, Json const& json, PlanReadOptions const& options) {
  return Reader(file, options).read(Node(json, fmt::format("{}: $", file)));
}

}  // namespace lapwing::plan::internal
