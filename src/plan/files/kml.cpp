// Reads plans from KML 2.2 (OGC 07-147r2): placemarks, wherever in the document. XML by pugixml, which expands no
// entities but the five of XML itself and loads nothing from elsewhere.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;
using mavlink::MavFrame;

constexpr int deepest = 64;  // folders in folders

/// Without the prefix of its namespace.
std::string_view local_name(pugi::xml_node node) {
  std::string_view const name = node.name();
  auto const colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child(pugi::xml_node node, std::string_view name) {
  return node.find_child([name](pugi::xml_node one) { return local_name(one) == name; });
}

std::string_view text_of(pugi::xml_node node, std::string_view name) {
  std::string_view text = child(node, name).text().get();
  constexpr std::string_view blanks = " \t\r\n";
  auto const begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

struct Coordinate {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  std::optional<double> alt_m;
};

/// What a placemark says beside its geometry: <Data name="command"><value>16</value></Data>.
using Data = std::map<std::string, std::string, std::less<>>;

Data data_of(pugi::xml_node placemark) {
  Data data;
  for (auto const& entry : child(placemark, "ExtendedData").children())
    if (local_name(entry) == "Data") data.emplace(entry.attribute("name").value(), text_of(entry, "value"));
  return data;
}

class Reader {
 public:
  Reader(std::string_view file, std::string_view text, PlanReadOptions const& options)
      : file_(file), text_(text), options_(options) {}

  Result<PlanFile> read(pugi::xml_node root) {
    if (local_name(root) != "kml") return fail_at(root, fmt::format("<{}> is no KML", root.name()));
    if (auto done = features(root, false, 0); !done) return std::unexpected(done.error());
    return std::move(read_);
  }
  [[nodiscard]] std::unexpected<base::Error> fail_at(std::ptrdiff_t offset, std::string_view what,
                                                     std::string_view hint = {}) const {
    auto const read = text_.substr(0, std::clamp<std::size_t>(static_cast<std::size_t>(offset), 0, text_.size()));
    return wrong(fmt::format("{}:{}", file_, 1 + std::ranges::count(read, '\n')), what, hint);
  }

 private:
  [[nodiscard]] std::unexpected<base::Error> fail_at(pugi::xml_node node, std::string_view what,
                                                     std::string_view hint = {}) const {
    return fail_at(std::max<std::ptrdiff_t>(node.offset_debug(), 0), what, hint);
  }
  Plan& plan() { return read_.plan; }

  /// `among_rally`: a folder round it is called after rally points.
  Result<> features(pugi::xml_node parent, bool among_rally, int depth) {
    if (depth > deepest) return fail_at(parent, fmt::format("folders are nested deeper than {}", deepest));
    for (auto const& node : parent.children()) {
      auto const name = local_name(node);
      Result<> done;
      if (name == "Placemark")
        done = placemark(node, among_rally);
      else if (name == "Document" || name == "Folder")
        done = features(node, among_rally || lower(text_of(node, "name")).contains("rally"), depth + 1);
      else if (name == "NetworkLink" || name == "GroundOverlay")
        note(node, fmt::format("a {} is not read", name));
      if (!done) return done;
    }
    return {};
  }

  void note(pugi::xml_node node, std::string what) {
    constexpr std::size_t most = 100;
    if (read_.notes.size() >= most) return;  // to count lines takes as long as the file is
    auto const line =
        1 + std::ranges::count(
                text_.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0))), '\n');
    read_.notes.push_back(fmt::format("line {}: {}", line, what));
  }

  Result<> placemark(pugi::xml_node node, bool among_rally) {
    auto const data = data_of(node);
    if (said(data, "role") == "path") return {};  // drawn from the items
    return geometries(node, node, data, among_rally, 0);
  }

  Result<> geometries(pugi::xml_node parent, pugi::xml_node placemark, Data const& data, bool among_rally, int depth) {
    if (depth > deepest) return fail_at(parent, fmt::format("geometries are nested deeper than {}", deepest));
    for (auto const& node : parent.children()) {
      auto const name = local_name(node);
      Result<> done;
      if (name == "MultiGeometry")
        done = geometries(node, placemark, data, among_rally, depth + 1);
      else if (name == "Point")
        done = point(node, placemark, data, among_rally);
      else if (name == "LineString" || name == "LinearRing")
        done = line(node);
      else if (name == "Polygon")
        done = polygon(node, placemark, data);
      else if (name == "Model" || name == "Track" || name == "MultiTrack")
        note(node, fmt::format("a {} is not read", name));
      if (!done) return done;
    }
    return {};
  }

  static std::string_view said(Data const& data, std::string_view key) {
    auto const found = data.find(key);
    return found == data.end() ? std::string_view{} : std::string_view(found->second);
  }

  Result<std::optional<double>> number(pugi::xml_node node, Data const& data, std::string_view key) const {
    auto const text = said(data, key);
    if (text.empty()) return std::optional<double>();
    auto const value = number_in(text);
    if (!value) return fail_at(node, fmt::format("{}: '{}' is no number", key, text.substr(0, 40)));
    return value;
  }

  Result<std::vector<Coordinate>> coordinates(pugi::xml_node geometry) const {
    auto const node = child(geometry, "coordinates");
    std::string_view rest = node.text().get();
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<Coordinate> all;
    for (auto begin = rest.find_first_not_of(blanks); begin != std::string_view::npos;
         begin = rest.find_first_not_of(blanks)) {
      rest.remove_prefix(begin);
      auto const tuple = rest.substr(0, rest.find_first_of(blanks));
      rest.remove_prefix(tuple.size());
      auto const one = coordinate(tuple);
      if (!one)
        return fail_at(geometry, fmt::format("'{}' is no coordinate", tuple.substr(0, 40)),
                       "KML writes longitude,latitude,height without blanks");
      all.push_back(*one);
      if (all.size() > max_mission_items) return fail_at(geometry, "more coordinates than a mission can hold");
    }
    if (all.empty()) return fail_at(geometry, "there are no coordinates in it");
    return all;
  }

  static std::optional<Coordinate> coordinate(std::string_view tuple) {
    std::vector<double> values;
    for (std::size_t at = 0; at <= tuple.size();) {
      auto const comma = std::min(tuple.find(',', at), tuple.size());
      auto const value = number_in(tuple.substr(at, comma - at));
      if (!value || values.size() == 3) return std::nullopt;
      values.push_back(*value);
      at = comma + 1;
    }
    if (values.size() < 2) return std::nullopt;
    return Coordinate{.lat_deg = values[1],
                      .lon_deg = values[0],
                      .alt_m = values.size() == 3 ? std::optional(values[2]) : std::nullopt};
  }

  /// What its heights count from; nothing on the ground.
  static std::optional<MavFrame> frame_of(pugi::xml_node geometry) {
    auto const mode = text_of(geometry, "altitudeMode");
    if (mode == "absolute") return MavFrame::global;
    if (mode == "relativeToGround") return MavFrame::global_terrain_alt;
    return std::nullopt;
  }

  Result<> add(pugi::xml_node node, FileItem const& from) {
    auto& items = plan().mission.items;
    if (items.size() >= max_mission_items) return fail_at(node, "more items than a mission can hold");
    auto const item = to_item(from);
    if (!item) return fail_at(node, item.error().message, item.error().hint);
    items.push_back(*item);
    return {};
  }

  Result<> way_point(pugi::xml_node geometry, Coordinate const& at) {
    auto const frame = frame_of(geometry);
    auto const from = way_point_at(at.lat_deg, at.lon_deg, frame ? at.alt_m : std::nullopt,
                                   frame.value_or(MavFrame::global), options_);
    if (!from) return fail_at(geometry, "this lies on the ground (altitudeMode clampToGround)", from.error().hint);
    return add(geometry, *from);
  }

  Result<> line(pugi::xml_node geometry) {
    auto const all = coordinates(geometry);
    if (!all) return std::unexpected(all.error());
    for (auto const& one : *all)
      if (auto done = way_point(geometry, one); !done) return done;
    return {};
  }

  Result<> point(pugi::xml_node geometry, pugi::xml_node placemark, Data const& data, bool among_rally) {
    auto const all = coordinates(geometry);
    if (!all) return std::unexpected(all.error());
    auto const& at = all->front();
    auto const role = said(data, "role");
    if (data.contains("command")) return item(geometry, data, at);
    if (data.contains("radius_m")) return circle(geometry, placemark, data, at);
    if (role.empty() && !among_rally) return way_point(geometry, at);
    return marked(geometry, data, role.empty() ? "rally" : role, at);
  }

  Result<> marked(pugi::xml_node geometry, Data const& data, std::string_view role, Coordinate const& at) {
    auto const place = to_place(at.lat_deg, at.lon_deg, at.alt_m.value_or(0.0));
    if (!place) return fail_at(geometry, place.error().message);
    if (role == "home") {
      plan().mission.planned_home = *place;
    } else if (role == "breach_return") {
      plan().fence.breach_return = *place;
    } else if (role == "rally") {
      auto const frame = number(geometry, data, "frame");
      if (!frame) return std::unexpected(frame.error());
      auto const mode = frame_of(geometry);
      if (!*frame && !mode && !options_.altitude_m)
        return fail_at(geometry, "this rally point lies on the ground (altitudeMode clampToGround)",
                       "say a height: --altitude METRES above home");
      RallyPoint rally{.place = *place};
      if (*frame)
        rally.frame =
            **frame >= 0.0 && **frame <= 255.0 ? static_cast<MavFrame>(static_cast<int>(**frame)) : MavFrame{255};
      else if (mode)
        rally.frame = *mode;
      else
        rally.place.alt_m = *options_.altitude_m;
      if (!mavlink::is_global(rally.frame))
        return fail_at(geometry, "frame: heights count from the sea (0), home (3) or the terrain (10)");
      if (plan().rally.size() >= max_mission_items)
        return fail_at(geometry, "more rally points than a vehicle can hold");
      plan().rally.push_back(rally);
    } else {
      return fail_at(geometry, fmt::format("role: '{}' is no role of a point", role.substr(0, 40)),
                     "roles are home, rally and breach_return");
    }
    return {};
  }

  /// One item of a mission, with all that MAVLink has of it.
  Result<> item(pugi::xml_node geometry, Data const& data, Coordinate const& at) {
    FileItem from;
    auto const take = [&](std::string_view key, double& into) -> Result<> {
      auto const value = number(geometry, data, key);
      if (!value) return std::unexpected(value.error());
      if (*value) into = **value;
      return {};
    };
    constexpr std::size_t free_params = 4;
    from.params.fill(0.0);
    for (std::size_t i = 0; i < free_params; ++i)
      if (auto done = take(fmt::format("param{}", i + 1), from.params[i]); !done) return done;
    if (auto done = take("command", from.command); !done) return done;
    if (auto done = take("frame", from.frame); !done) return done;
    if (!at.alt_m) return fail_at(geometry, "an item with a command needs its height, the third number");
    from.autocontinue = said(data, "autocontinue") != "0";
    from.params[4] = at.lat_deg;
    from.params[5] = at.lon_deg;
    from.params[6] = *at.alt_m;
    return add(geometry, from);
  }

  Result<GeoZone> zone_of(pugi::xml_node node, pugi::xml_node placemark, Data const& data) {
    if (auto fits = budget_.take_zone(file_); !fits) return std::unexpected(fits.error());
    GeoZone zone{.name = std::string(text_of(placemark, "name")), .area = {}};
    auto const kind = said(data, "fence");
    if (!kind.empty() && kind != "inclusion" && kind != "exclusion")
      return fail_at(node, fmt::format("fence: '{}' is no kind of fence", kind.substr(0, 40)),
                     "use inclusion (stay inside, the default) or exclusion (stay outside)");
    zone.kind = kind == "exclusion" ? Zone::Kind::exclusion : Zone::Kind::inclusion;
    if (kind.empty()) note(node, fmt::format("the area '{}' is taken as one to stay in", zone.name.substr(0, 40)));
    for (auto const& [key, limit, is_above_sea] :
         {std::tuple{"min_height_m", &zone.lowest, false}, std::tuple{"max_height_m", &zone.highest, false},
          std::tuple{"min_altitude_m", &zone.lowest, true}, std::tuple{"max_altitude_m", &zone.highest, true}}) {
      auto const value = number(node, data, key);
      if (!value) return std::unexpected(value.error());
      if (*value && !std::isfinite(**value)) return fail_at(node, fmt::format("{}: is no number of metres", key));
      if (*value) *limit = HeightLimit{**value, is_above_sea};
    }
    return zone;
  }

  Result<> circle(pugi::xml_node node, pugi::xml_node placemark, Data const& data, Coordinate const& at) {
    auto zone = zone_of(node, placemark, data);
    if (!zone) return std::unexpected(zone.error());
    auto const radius_m = number(node, data, "radius_m");
    if (!radius_m) return std::unexpected(radius_m.error());
    double const radius = radius_m->value_or(0.0);
    if (!is_radius(radius)) return fail_at(node, "radius_m: is no radius, a number of metres");
    auto const center = to_place(at.lat_deg, at.lon_deg, 0.0);
    if (!center) return fail_at(node, center.error().message);
    zone->area = GeoCircle{*center, radius};
    plan().fence.zones.push_back(*std::move(zone));
    return {};
  }

  Result<> polygon(pugi::xml_node node, pugi::xml_node placemark, Data const& data) {
    auto zone = zone_of(node, placemark, data);
    if (!zone) return std::unexpected(zone.error());
    GeoPolygon polygon;
    if (auto done = add_ring(child(node, "outerBoundaryIs"), node, polygon); !done) return done;
    for (auto const& boundary : node.children()) {
      if (local_name(boundary) != "innerBoundaryIs") continue;
      if (auto done = add_ring(boundary, node, polygon); !done) return done;
    }
    // Several in one placemark are one zone.
    auto& zones = plan().fence.zones;
    auto* const last = zones.empty() ? nullptr : std::get_if<std::vector<GeoPolygon>>(&zones.back().area);
    if (last && placemark == polygons_of_) {
      last->push_back(std::move(polygon));
    } else {
      zone->area = std::vector{std::move(polygon)};
      zones.push_back(*std::move(zone));
    }
    polygons_of_ = placemark;
    return {};
  }

  Result<> add_ring(pugi::xml_node boundary, pugi::xml_node node, GeoPolygon& polygon) {
    auto const ring = child(boundary, "LinearRing");
    if (!ring) return fail_at(node, "a Polygon needs its outerBoundaryIs with a LinearRing");
    auto const all = coordinates(ring);
    if (!all) return std::unexpected(all.error());
    if (auto fits = budget_.take_corners(file_, all->size()); !fits) return fits;
    GeoRing corners;
    for (auto const& one : *all) {
      auto const corner = to_place(one.lat_deg, one.lon_deg, 0.0);
      if (!corner) return fail_at(ring, corner.error().message);
      corners.push_back(*corner);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) return fail_at(ring, "a ring needs at least three corners");
    polygon.rings.push_back(std::move(corners));
    return {};
  }

  std::string_view file_;
  std::string_view text_;
  PlanReadOptions const& options_;
  PlanFile read_{.plan = {}};
  FenceBudget budget_;
  pugi::xml_node polygons_of_;
};

}  // namespace

Result<PlanFile> read_kml(std::string_view file, std::string_view text, PlanReadOptions const& options) {
  pugi::xml_document document;
  auto const parsed = document.load_buffer(text.data(), text.size());
  Reader reader(file, text, options);
  if (!parsed) return reader.fail_at(parsed.offset, fmt::format("this is no XML: {}", parsed.description()));
  return reader.read(document.document_element());
}

}  // namespace lapwing::plan::internal
