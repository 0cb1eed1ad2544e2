// Writes plans as KML 2.2, styled for Google Earth and QGIS.
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan::internal {
namespace {

using mavlink::MavFrame;

/// Colours are aabbggrr.
struct Style {
  char const* id;
  char const* line;
  char const* fill;
  char const* icon;
};
constexpr Style styles[] = {
    {"path", "ff00a5ff", "00ffffff", nullptr},
    {"item", "ff00a5ff", nullptr, "http://maps.google.com/mapfiles/kml/shapes/placemark_circle.png"},
    {"home", "ffffffff", nullptr, "http://maps.google.com/mapfiles/kml/shapes/homegardenbusiness.png"},
    {"rally", "ff00ff00", nullptr, "http://maps.google.com/mapfiles/kml/shapes/flag.png"},
    {"inclusion", "ff00c000", "3000c000", nullptr},
    {"exclusion", "ff0000ff", "400000ff", nullptr},
};

void add_styles(pugi::xml_node document) {
  for (auto const& style : styles) {
    auto node = document.append_child("Style");
    node.append_attribute("id") = style.id;
    if (style.icon) {
      auto icon = node.append_child("IconStyle");
      icon.append_child("color").text() = style.line;
      icon.append_child("Icon").append_child("href").text() = style.icon;
    }
    auto line = node.append_child("LineStyle");
    line.append_child("color").text() = style.line;
    line.append_child("width").text() = 2;
    if (style.fill) node.append_child("PolyStyle").append_child("color").text() = style.fill;
  }
}

char const* altitude_mode(MavFrame frame) {
  return frame == MavFrame::global ? "absolute" : "relativeToGround";  // KML knows no height above home
}

std::string coordinate(geo::Wgs84 const& place, bool has_height = true) {
  auto text = fmt::format("{},{}", file_degrees(place.lon_deg()), file_degrees(place.lat_deg()));
  return has_height ? fmt::format("{},{}", text, place.alt_m) : text;
}

/// A placemark with what it says beside its geometry.
class Placemark {
 public:
  Placemark(pugi::xml_node parent, std::string const& name, char const* style)
      : node_(parent.append_child("Placemark")) {
    node_.append_child("name").text() = name.c_str();
    node_.append_child("styleUrl").text() = fmt::format("#{}", style).c_str();
    data_ = node_.append_child("ExtendedData");
  }
  void say(char const* key, std::string const& value) {
    auto entry = data_.append_child("Data");
    entry.append_attribute("name") = key;
    entry.append_child("value").text() = value.c_str();
  }
  pugi::xml_node geometry(char const* kind, char const* mode) {
    auto geometry = node_.append_child(kind);
    geometry.append_child("altitudeMode").text() = mode;
    return geometry;
  }
  void point(geo::Wgs84 const& place, char const* mode) {
    geometry("Point", mode).append_child("coordinates").text() = coordinate(place).c_str();
  }

 private:
  pugi::xml_node node_;
  pugi::xml_node data_;
};

/// For whoever looks at it; our reader takes the items. Where heights count from different grounds it lies on it.
void add_path(std::vector<mavlink::MissionItem> const& items, pugi::xml_node folder) {
  std::string line;
  char const* mode = nullptr;
  bool is_mixed = false;
  std::size_t corners = 0;
  for (auto const& item : items) {
    if (!has_position(item)) continue;
    char const* const its = altitude_mode(item.frame);
    is_mixed = is_mixed || (mode && std::string_view(mode) != its);
    mode = its;
    line += coordinate(position_of(item)) + "\n";
    ++corners;
  }
  if (corners < 2) return;
  Placemark path(folder, "path", "path");
  path.say("role", "path");
  auto geometry = path.geometry("LineString", is_mixed ? "clampToGround" : mode);
  geometry.prepend_child("tessellate").text() = 1;
  geometry.append_child("coordinates").text() = line.c_str();
}

void add_item(mavlink::MissionItem const& item, std::size_t number, pugi::xml_node folder) {
  Placemark placemark(folder, fmt::format("{} {}", number, to_string(item.command)), "item");
  auto const values = from_item(item);
  placemark.say("command", fmt::format("{}", values.command));
  placemark.say("frame", fmt::format("{}", values.frame));
  for (std::size_t i = 0; i < item.params.size(); ++i) {
    if (values.params[i] == 0.0) continue;
    auto const key = fmt::format("param{}", i + 1);
    placemark.say(key.c_str(), fmt::format("{}", values.params[i]));
  }
  if (!item.autocontinue) placemark.say("autocontinue", "0");
  placemark.point(position_of(item), altitude_mode(item.frame));
}

void add_ring(GeoRing const& ring, pugi::xml_node boundary) {
  std::string corners;
  for (auto const& corner : ring) corners += coordinate(corner, false) + "\n";
  corners += coordinate(ring.front(), false);
  boundary.append_child("LinearRing").append_child("coordinates").text() = corners.c_str();
}

void add_polygon(GeoPolygon const& polygon, pugi::xml_node parent) {
  auto node = parent.append_child("Polygon");
  node.append_child("tessellate").text() = 1;
  for (std::size_t i = 0; i < polygon.rings.size(); ++i)
    add_ring(polygon.rings[i], node.append_child(i == 0 ? "outerBoundaryIs" : "innerBoundaryIs"));
}

void say_limit(std::string_view which, std::optional<HeightLimit> const& limit, Placemark& placemark) {
  if (!limit) return;
  auto const key = fmt::format("{}_{}", which, limit->is_above_sea ? "altitude_m" : "height_m");
  placemark.say(key.c_str(), fmt::format("{}", limit->height_m));
}

void add_zone(GeoZone const& zone, pugi::xml_node folder) {
  char const* const kind = zone.kind == Zone::Kind::inclusion ? "inclusion" : "exclusion";
  Placemark placemark(folder, zone.name, kind);
  placemark.say("fence", kind);
  say_limit("min", zone.lowest, placemark);
  say_limit("max", zone.highest, placemark);
  if (auto const* circle = std::get_if<GeoCircle>(&zone.area)) {
    placemark.say("radius_m", fmt::format("{}", circle->radius_m));
    placemark.point(circle->center, "clampToGround");
    return;
  }
  auto const& polygons = std::get<std::vector<GeoPolygon>>(zone.area);
  auto parent = folder.last_child();
  if (polygons.size() > 1) parent = parent.append_child("MultiGeometry");
  for (auto const& polygon : polygons) add_polygon(polygon, parent);
}

void add_mark(geo::Wgs84 const& place, char const* role, char const* style, MavFrame frame, pugi::xml_node folder) {
  Placemark placemark(folder, role, style);
  placemark.say("role", role);
  placemark.say("frame", fmt::format("{}", static_cast<int>(frame)));
  placemark.point(place, altitude_mode(frame));
}

}  // namespace

std::string write_kml(Plan const& plan) {
  pugi::xml_document xml;
  auto declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  auto kml = xml.append_child("kml");
  kml.append_attribute("xmlns") = "http://www.opengis.net/kml/2.2";
  auto document = kml.append_child("Document");
  document.append_child("name").text() = plan.mission.name.c_str();
  add_styles(document);
  auto const folder = [&](char const* name) {
    auto node = document.append_child("Folder");
    node.append_child("name").text() = name;
    return node;
  };
  auto const mission = folder("Mission");
  if (plan.mission.planned_home) add_mark(*plan.mission.planned_home, "home", "home", MavFrame::global, mission);
  add_path(plan.mission.items, mission);
  for (std::size_t i = 0; i < plan.mission.items.size(); ++i) add_item(plan.mission.items[i], i + 1, mission);
  auto const fence = folder("Fence");
  for (auto const& zone : plan.fence.zones) add_zone(zone, fence);
  if (plan.fence.breach_return)
    add_mark(*plan.fence.breach_return, "breach_return", "rally", MavFrame::global_relative_alt, fence);
  auto const rally = folder("Rally points");
  for (auto const& point : plan.rally) add_mark(point.place, "rally", "rally", point.frame, rally);
  std::ostringstream out;
  xml.save(out, "  ");
  return std::move(out).str();
}

}  // namespace lapwing::plan::internal
