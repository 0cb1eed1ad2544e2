#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "base/text/spelling.hpp"
#include "base/text/utc_text.hpp"
#include "map/features/feature_json.hpp"
#include "map/features/placement.hpp"

namespace lapwing::map {

namespace {

using base::Result;

/// Members that every feature has beside the properties of its layer.
constexpr std::array<std::string_view, 5> common_properties = {"site", "floor", "writer", "at", "held_over"};

/// What somebody wrote, short enough for a message and without what a terminal would obey.
std::string shown(std::string text) {
  constexpr std::size_t longest = 40;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return base::printable(std::move(text));
}

/// Sorted by key: one that keeps its order looks at all members before it adds another, and outsiders send many.
using Given = nlohmann::json;

std::string shown(Given const& json) {
  if (json.is_string()) return fmt::format("\"{}\"", shown(json.get_ref<std::string const&>()));
  if (json.is_structured()) return json.is_array() ? "a list" : "an object";
  return shown(json.dump());
}

std::unexpected<base::Error> wrong(std::string const& message, std::string hint = {}) {
  return base::fail(base::ErrorKind::invalid_input, message, std::move(hint));
}

/// A value with its place in the document: "features[3].geometry".
class Node {
 public:
  explicit Node(Given const& json, std::string path = {}) : json_(&json), path_(std::move(path)) {}

  [[nodiscard]] Given const& json() const { return *json_; }
  [[nodiscard]] std::size_t size() const { return json_->size(); }
  /// For messages: "features[3].geometry", "the document".
  [[nodiscard]] std::string name() const { return path_.empty() ? "the document" : path_; }

  [[nodiscard]] Node item(std::size_t i) const { return Node((*json_)[i], fmt::format("{}[{}]", path_, i)); }
  /// Nothing for one that is missing or null.
  [[nodiscard]] std::optional<Node> member(std::string const& key) const {
    if (!json_->is_object()) return std::nullopt;
    auto const found = json_->find(key);
    if (found == json_->end() || found->is_null()) return std::nullopt;
    return Node(*found, path_.empty() ? shown(key) : fmt::format("{}.{}", path_, shown(key)));
  }
  [[nodiscard]] Result<std::string> text_or(std::string const& key, std::string otherwise) const {
    auto const found = member(key);
    if (!found) return otherwise;
    if (!found->json().is_string())
      return wrong(fmt::format("{} is {}, not text", found->name(), shown(found->json())));
    return found->json().get<std::string>();
  }
  [[nodiscard]] Result<base::UtcTime> time_or(std::string const& key, base::UtcTime otherwise) const {
    auto const text = text_or(key, "");
    if (!text) return std::unexpected(text.error());
    if (text->empty()) return otherwise;
    auto const time = base::utc_from_text(*text);
    if (!time)
      return wrong(fmt::format("{} is \"{}\", not a time as 2026-11-21T10:12:52Z", member(key)->name(), shown(*text)));
    return *time;
  }

 private:
  Given const* json_;
  std::string path_;
};

Result<HeldOver> held_over_of(Node const& node) {
  auto property = node.text_or("property", "");
  auto writer = node.text_or("writer", "");
  auto const at = node.time_or("at", {});
  if (!property) return std::unexpected(property.error());
  if (!writer) return std::unexpected(writer.error());
  if (!at) return std::unexpected(at.error());
  return HeldOver{*std::move(property), {*std::move(writer), *at}};
}

Result<std::vector<HeldOver>> all_held_over_of(Node const& node) {
  constexpr std::size_t most = 20;
  if (!node.json().is_array() || node.size() > most)
    return wrong(fmt::format("{} is no list, or a long one", node.name()));
  std::vector<HeldOver> all;
  for (std::size_t i = 0; i < node.size(); ++i) {
    auto one = held_over_of(node.item(i));
    if (!one) return std::unexpected(one.error());
    all.push_back(*std::move(one));
  }
  return all;
}

/// The geometry of a feature in the frame of its site.
class GeometryReader {
 public:
  explicit GeometryReader(geo::Site const& site) : site_(site) {}

  Result<Geometry> read(Node const& node) const {
    auto const type = node.text_or("type", "");
    if (!type) return std::unexpected(type.error());
    auto coordinates = node.member("coordinates");
    if (!coordinates) return wrong(fmt::format("{} has no coordinates", node.name()));
    std::string_view kind = *type;
    if (kind.starts_with("Multi")) {
      if (!coordinates->json().is_array() || coordinates->size() != 1)
        return wrong(fmt::format("{} has several parts; a feature has one", node.name()), "make a feature of each");
      kind.remove_prefix(std::string_view("Multi").size());
      coordinates = coordinates->item(0);
    }
    if (kind == "Point") return as_geometry(point(*coordinates));
    if (kind == "LineString") return as_geometry(line(*coordinates));
    if (kind == "Polygon") return as_geometry(polygon(*coordinates));
    return wrong(fmt::format("{} is {}, not a Point, LineString or Polygon", node.name(), shown(Given(*type))));
  }

 private:
  template <class Shape>
  static Result<Geometry> as_geometry(Result<Shape> shape) {
    if (!shape) return std::unexpected(std::move(shape.error()));
    return Geometry(*std::move(shape));
  }

  static Result<double> degrees(Node const& node, double most, std::string_view what) {
    if (!node.json().is_number()) return wrong(fmt::format("{} is {}, not a number", node.name(), shown(node.json())));
    auto const value = node.json().get<double>();
    if (std::abs(value) <= most) return value;
    return wrong(fmt::format("{} is {}, not a {}", node.name(), shown(node.json()), what),
                 "GeoJSON writes longitude first: [longitude, latitude]");
  }

  Result<SitePoint> point(Node const& node) const {
    constexpr double most_lon_deg = 360.0;  // a line across the antimeridian goes on in the next turn
    constexpr double most_lat_deg = 90.0;
    if (!node.json().is_array() || node.size() < 2)
      return wrong(fmt::format("{} is {}, not [longitude, latitude]", node.name(), shown(node.json())));
    auto const lon_deg = degrees(node.item(0), most_lon_deg, "longitude");
    if (!lon_deg) return std::unexpected(lon_deg.error());
    auto const lat_deg = degrees(node.item(1), most_lat_deg, "latitude");
    if (!lat_deg) return std::unexpected(lat_deg.error());
    constexpr double rad = std::numbers::pi / 180.0;
    return point_of(site_, *lon_deg * rad, *lat_deg * rad);
  }

  Result<std::vector<SitePoint>> points(Node const& node, std::size_t most) const {
    if (!node.json().is_array())
      return wrong(fmt::format("{} is {}, not a list of positions", node.name(), shown(node.json())));
    if (node.size() > most)
      return wrong(fmt::format("{} has {} points; at most {} are taken", node.name(), node.size(), most));
    std::vector<SitePoint> points;
    points.reserve(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) {
      auto const one = point(node.item(i));
      if (!one) return std::unexpected(one.error());
      points.push_back(*one);
    }
    return points;
  }

  Result<LineString> line(Node const& node) const {
    auto all = points(node, most_points);
    if (!all) return std::unexpected(all.error());
    return LineString{*std::move(all)};
  }

  Result<SitePolygon> polygon(Node const& node) const {
    if (!node.json().is_array() || node.size() > most_corners)
      return wrong(fmt::format("{} is no list of rings, or one of too many", node.name()));
    SitePolygon polygon;
    for (std::size_t i = 0; i < node.size(); ++i) {
      auto const ring = node.item(i);
      constexpr std::size_t fewest = 4;
      if (ring.json().is_array() && (ring.size() < fewest || ring.json().front() != ring.json().back()))
        return wrong(fmt::format("{} is not closed", ring.name()), "the last position of a ring is its first again");
      auto corners = points(ring, most_corners + 1);
      if (!corners) return std::unexpected(corners.error());
      corners->pop_back();
      polygon.rings.push_back(*std::move(corners));
    }
    return polygon;
  }

  geo::Site const& site_;
};

class FeatureReader {
 public:
  FeatureReader(LayerKind layer, FindSite const& find_site, FeatureDefaults const& defaults)
      : layer_(layer), find_site_(find_site), defaults_(defaults) {}

  Result<std::vector<Feature>> read(Node const& document) const {
    auto const type = document.text_or("type", "");
    if (!type) return std::unexpected(type.error());
    std::vector<Feature> features;
    if (*type != "FeatureCollection") {
      auto one = feature(document);
      if (!one) return std::unexpected(one.error());
      features.push_back(*std::move(one));
      return features;
    }
    auto const list = document.member("features");
    if (!list || !list->json().is_array()) return wrong("the FeatureCollection has no list of features");
    if (list->size() > most_json_features)
      return wrong(fmt::format("there are {} features; at most {} are taken at once", list->size(), most_json_features),
                   "send them in several pieces");
    for (std::size_t i = 0; i < list->size(); ++i) {
      auto one = feature(list->item(i));
      if (!one) return std::unexpected(one.error());
      features.push_back(*std::move(one));
    }
    return features;
  }

 private:
  Result<Feature> feature(Node const& node) const {
    if (node.text_or("type", "").value_or("") != "Feature")
      return wrong(fmt::format("{} is no GeoJSON Feature", node.name()));
    static Given const none = Given::object();
    auto const properties = node.member("properties").value_or(Node(none, node.name() + ".properties"));
    if (!properties.json().is_object())
      return wrong(fmt::format("{} is {}, not an object", properties.name(), shown(properties.json())));
    auto feature = identity(node, properties);
    if (!feature) return feature;
    auto content = this->content(node, *feature);
    if (!content) return std::unexpected(content.error());
    feature->content = *std::move(content);
    if (auto const set = set_properties(feature->content, properties); !set) return std::unexpected(set.error());
    if (auto const fault = feature_fault(*feature)) return wrong(fmt::format("{}: {}", node.name(), *fault));
    return feature;
  }

  /// All but the content.
  Result<Feature> identity(Node const& node, Node const& properties) const {
    Feature feature;
    auto const id = node.member("id");
    if (id && !id->json().is_string() && !id->json().is_number_integer())
      return wrong(fmt::format("{} is {}, not text", id->name(), shown(id->json())));
    feature.id = !id ? defaults_.id : id->json().is_string() ? id->json().get<std::string>() : id->json().dump();
    using Member = std::pair<char const*, std::pair<std::string*, std::string const*>>;
    for (auto const& [key, into] :
         {Member{"site", {&feature.site, &defaults_.site}}, Member{"floor", {&feature.floor, &defaults_.floor}},
          Member{"writer", {&feature.account.writer, &defaults_.account.writer}}}) {
      auto text = properties.text_or(key, *into.second);
      if (!text) return std::unexpected(text.error());
      *into.first = *std::move(text);
    }
    auto const at = properties.time_or("at", defaults_.account.at);
    if (!at) return std::unexpected(at.error());
    feature.account.at = *at;
    if (auto const held = properties.member("held_over")) {
      auto all = all_held_over_of(*held);
      if (!all) return std::unexpected(all.error());
      feature.held_over = *std::move(all);
    }
    return feature;
  }

  Result<Content> content(Node const& node, Feature const& feature) const {
    auto const* site = find_site_(feature.site);
    if (!site)
      return base::fail(base::ErrorKind::not_found,
                        fmt::format("{}: there is no site \"{}\"", node.name(), shown(feature.site)));
    auto const geometry_node = node.member("geometry");
    if (!geometry_node) return wrong(fmt::format("{} has no geometry", node.name()));
    auto geometry = GeometryReader(*site).read(*geometry_node);
    if (!geometry) return std::unexpected(geometry.error());
    // Before anything is done with it: whatever looks at a polygon takes it to be one.
    if (auto const fault = geometry_fault(*geometry))
      return wrong(fmt::format("{}: {}", geometry_node->name(), *fault));
    auto content = content_at(layer_, *std::move(geometry));
    if (!content) content.error().message = fmt::format("{}: {}", geometry_node->name(), content.error().message);
    return content;
  }

  Result<> set_properties(Content& content, Node const& properties) const {
    for (auto const& [key, json] : properties.json().items()) {
      if (std::ranges::find(common_properties, key) != common_properties.end()) continue;
      auto const* property = property_named(layer_, key);
      if (!property) return unknown(properties, key);
      auto const node = properties.member(key);
      auto const value = node ? value_of(*property, *node) : PropertyValue();  // null: it does not have it
      if (!value) return std::unexpected(value.error());
      if (auto const set = property->set(content, *value); !set)
        return wrong(fmt::format("{} {}", node ? node->name() : key, set.error().message));
    }
    return {};
  }

  Result<> unknown(Node const& properties, std::string const& key) const {
    std::vector<std::string_view> names(common_properties.begin(), common_properties.end());
    for (auto const& property : properties_of(layer_)) names.push_back(property.name);
    return wrong(fmt::format("{}: the layer {} has no property \"{}\"", properties.name(), name_of(layer_), shown(key)),
                 base::did_you_mean(key, names));
  }

  static Result<PropertyValue> value_of(Property const& property, Node const& node) {
    auto const& json = node.json();
    if (property.kind == PropertyKind::time && json.is_string()) {
      auto const time = base::utc_from_text(json.get_ref<std::string const&>());
      if (!time) return wrong(fmt::format("{} is {}, not a time as 2026-11-21T10:12:52Z", node.name(), shown(json)));
      return *time;
    }
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX) return json.get<double>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    return wrong(fmt::format("{} is {}, not a plain value", node.name(), shown(json)));
  }

  LayerKind layer_;
  FindSite const& find_site_;
  FeatureDefaults const& defaults_;
};

/// Nothing for what is no JSON, or is nested deeper than any feature.
std::optional<Given> parsed(std::string_view text) {
  constexpr int deepest = 12;
  bool is_too_deep = false;
  auto const look = [&](int depth, Given::parse_event_t, Given const&) {
    is_too_deep = is_too_deep || depth > deepest;
    return !is_too_deep;
  };
  auto json = Given::parse(text.begin(), text.end(), look, false);
  return is_too_deep || json.is_discarded() ? std::nullopt : std::optional(std::move(json));
}

}  // namespace

base::Result<std::vector<Feature>> read_features(std::string_view text, LayerKind layer, FindSite const& find_site,
                                                 FeatureDefaults const& defaults) {
  if (text.size() > most_json_bytes)
    return wrong(fmt::format("it has {} bytes; at most {} are taken at once", text.size(), most_json_bytes),
                 "send it in several pieces");
  auto const json = parsed(text);
  if (!json) return wrong("this is no JSON");
  return FeatureReader(layer, find_site, defaults).read(Node(*json));
}

base::Result<std::vector<HeldOver>> held_over_of(std::string_view text) {
  if (text.empty()) return std::vector<HeldOver>();
  auto const json = parsed(text.substr(0, most_json_bytes));
  if (!json) return wrong("held_over is no JSON");
  return all_held_over_of(Node(*json, "held_over"));
}

}  // namespace lapwing::map
