// QGroundControl's plan files: JSON, described in its developer guide under "Plan file format".
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "plan/files/internal/json_node.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;
using mavlink::MavCmd;

/// Gathers the items, with the numbers by which jumps name them.
class Assembly {
 public:
  Result<> add(Node const& node, FileItem const& from) {
    if (items_.size() >= max_mission_items) return wrong(node.path(), "more items than a mission can hold");
    auto item = to_item(from);
    if (!item) return wrong(node.path(), item.error().message, item.error().hint);
    items_.push_back(*item);
    paths_.push_back(node.path());
    return {};
  }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  /// The item added next is the plan's number `id`.
  void number_next(double id) { numbers_.emplace(id, items_.size() + 1); }

  Result<std::vector<mavlink::MissionItem>> finish() {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      auto& item = items_[i];
      if (item.command != MavCmd::do_jump) continue;
      auto const target = numbers_.find(static_cast<double>(item.params[0]));
      if (target == numbers_.end())
        return wrong(paths_[i], fmt::format("the jump leads to item {}, which is not there", item.params[0]));
      item.params[0] = static_cast<float>(target->second);
    }
    return std::move(items_);
  }

 private:
  std::vector<mavlink::MissionItem> items_;
  std::vector<std::string> paths_;
  std::map<double, std::size_t> numbers_;
};

Result<FileItem> simple_item(Node const& node) {
  FileItem item;
  auto const command = node.number("command");
  if (!command) return std::unexpected(command.error());
  auto const frame = node.number("frame");
  if (!frame) return std::unexpected(frame.error());
  auto params = node.numbers("params", 7);
  if (!params) return std::unexpected(params.error());
  if (node.has("coordinate")) {  // version 1 of the format held the place apart
    auto const place = node.numbers("coordinate", 3);
    if (!place) return std::unexpected(place.error());
    params->resize(4, unset);
    params->insert(params->end(), place->begin(), place->end());
  }
  item.command = *command;
  item.frame = *frame;
  item.params.fill(unset);
  std::ranges::copy(*params, item.params.begin());
  item.autocontinue = node.flag_or("autoContinue", true);
  return item;
}

Result<> add_simple(Node const& node, Assembly& assembly) {
  auto const item = simple_item(node);
  if (!item) return std::unexpected(item.error());
  if (node.has("doJumpId")) {
    auto const id = node.number("doJumpId");
    if (!id) return std::unexpected(id.error());
    assembly.number_next(*id);
  }
  return assembly.add(node, *item);
}

Result<> add_stored_items(Node const& node, Assembly& assembly) {
  auto const transect = node.member("TransectStyleComplexItem");
  if (!transect) return std::unexpected(transect.error());
  auto const items = transect->list("Items");
  if (!items) return std::unexpected(items.error());
  for (std::size_t i = 0; i < items->size(); ++i) {
    if (auto added = add_simple(items->item(i), assembly); !added) return added;
  }
  return {};
}

FileItem placed(MavCmd command, double frame, geo::Wgs84 place, std::array<double, 4> p = {}) {
  return {.command = static_cast<double>(command),
          .frame = frame,
          .params = {p[0], p[1], p[2], p[3], place.lat_deg(), place.lon_deg(), place.alt_m}};
}

/// What QGroundControl makes of a landing pattern: the marker, the end of photos, the approach, the landing.
Result<> add_landing(Node const& node, MavCmd landing, Assembly& assembly) {
  auto const touch_down = node.place("landCoordinate");
  if (!touch_down) return std::unexpected(touch_down.error());
  auto const approach =
      node.place(node.has("landingApproachCoordinate") ? "landingApproachCoordinate" : "loiterCoordinate");
  if (!approach) return std::unexpected(approach.error());
  double constexpr above_sea = 0.0;
  double constexpr no_place = 2.0;
  double constexpr above_home = 3.0;
  double const frame = node.flag_or("altitudesAreRelative", true) ? above_home : above_sea;
  double const radius_m = node.number_or("loiterRadius", 0.0) * (node.flag_or("loiterClockwise", true) ? 1.0 : -1.0);
  std::vector<FileItem> items{{.command = static_cast<double>(MavCmd::do_land_start), .frame = no_place}};
  if (node.flag_or("stopTakingPhotos", false))
    items.push_back({.command = static_cast<double>(MavCmd::image_stop_capture), .frame = no_place});
  double constexpr leave_towards_the_next = 1.0;
  items.push_back(node.flag_or("useLoiterToAlt", true)
                      ? placed(MavCmd::nav_loiter_to_alt, frame, *approach,
                               {leave_towards_the_next, radius_m, 0.0, leave_towards_the_next})
                      : placed(MavCmd::nav_waypoint, frame, *approach));
  items.push_back(placed(landing, frame, *touch_down));
  for (auto const& item : items) {
    if (auto added = assembly.add(node, item); !added) return added;
  }
  return {};
}

Result<> add_complex(Node const& node, Assembly& assembly) {
  auto const kind = node.text_or("complexItemType", "");
  if (node.has("TransectStyleComplexItem")) return add_stored_items(node, assembly);
  if (kind == "fwLandingPattern") return add_landing(node, MavCmd::nav_land, assembly);
  if (kind == "vtolLandingPattern") return add_landing(node, MavCmd::nav_vtol_land, assembly);
  return {};  // kept, not flown
}

/// Keys of a simple item whose meaning is in its other keys.
bool is_plain(Json const& item) {
  constexpr std::array known{
      "AMSLAltAboveTerrain", "Altitude", "AltitudeMode", "MISSION_ITEM_ID", "autoContinue", "command",
      "coordinate",          "doJumpId", "frame",        "params",          "type"};
  constexpr int computed_above_terrain = 3;
  bool const all_known = std::ranges::all_of(
      item.items(), [&](auto const& entry) { return std::ranges::find(known, entry.key()) != known.end(); });
  return all_known && item.value("AltitudeMode", Json(0)) != computed_above_terrain;
}

Result<> add_item(Node const& node, Assembly& assembly, std::vector<Pattern>& patterns) {
  auto const type = node.text_or("type", "");
  auto const first = assembly.size();
  Result<> added;
  bool is_pattern = true;
  if (type == "SimpleItem") {
    is_pattern = !is_plain(node.json());
    added = add_simple(node, assembly);
  } else if (type == "ComplexItem") {
    added = add_complex(node, assembly);
  } else {
    return wrong(node.path(), fmt::format("an item's type is SimpleItem or ComplexItem, not '{}'", type));
  }
  if (added && is_pattern)
    patterns.push_back({.first = first, .count = assembly.size() - first, .json = node.json().dump()});
  return added;
}

Result<> read_mission(Node const& mission, Plan& plan) {
  if (mission.has("plannedHomePosition")) {
    auto const home = mission.place("plannedHomePosition");
    if (!home) return std::unexpected(home.error());
    if (home->lat_rad != 0.0 || home->lon_rad != 0.0) plan.mission.planned_home = *home;
  }
  auto const speed = [&](char const* key) {
    return mission.has(key) ? std::optional(mission.number_or(key, 0.0)) : std::nullopt;
  };
  constexpr double most_kinds = 255.0;
  plan.cruise_speed_m_s = speed("cruiseSpeed");
  plan.hover_speed_m_s = speed("hoverSpeed");
  plan.firmware_type = static_cast<int>(std::clamp(mission.number_or("firmwareType", 0.0), 0.0, most_kinds));
  plan.vehicle_type = static_cast<int>(std::clamp(mission.number_or("vehicleType", 0.0), 0.0, most_kinds));
  auto const items = mission.list("items");
  if (!items) return std::unexpected(items.error());
  Assembly assembly;
  for (std::size_t i = 0; i < items->size(); ++i) {
    if (auto added = add_item(items->item(i), assembly, plan.patterns); !added) return added;
  }
  auto finished = assembly.finish();
  if (!finished) return std::unexpected(finished.error());
  plan.mission.items = *std::move(finished);
  return {};
}

Zone::Kind kind_of(Node const& node) {
  return node.flag_or("inclusion", true) ? Zone::Kind::inclusion : Zone::Kind::exclusion;
}

Result<> read_polygon(Node const& node, GeoFence& fence, FenceBudget& budget) {
  auto const corners = node.list("polygon");
  if (!corners) return std::unexpected(corners.error());
  if (auto fits = budget.take_corners(corners->path(), corners->size()); !fits) return fits;
  GeoRing ring;
  for (std::size_t i = 0; i < corners->size(); ++i) {
    auto const corner = corners->item(i).place();
    if (!corner) return std::unexpected(corner.error());
    ring.push_back({corner->lat_rad, corner->lon_rad, 0.0});
  }
  if (ring.size() < 3) return wrong(corners->path(), "a polygon needs at least three corners");
  fence.zones.push_back({.kind = kind_of(node), .area = std::vector<GeoPolygon>{{{std::move(ring)}}}});
  return {};
}

Result<> read_circle(Node const& node, GeoFence& fence) {
  auto const circle = node.member("circle");
  if (!circle) return std::unexpected(circle.error());
  auto const center = circle->place("center");
  if (!center) return std::unexpected(center.error());
  auto const radius_m = circle->number("radius");
  if (!radius_m) return std::unexpected(radius_m.error());
  if (!is_radius(*radius_m)) return wrong(circle->path(), fmt::format("{} m is no radius", *radius_m));
  fence.zones.push_back({.kind = kind_of(node), .area = GeoCircle{{center->lat_rad, center->lon_rad, 0.0}, *radius_m}});
  return {};
}

Result<> read_fence(Node const& node, GeoFence& fence) {
  FenceBudget budget;
  auto const polygons = node.list_or_none("polygons");
  if (!polygons) return std::unexpected(polygons.error());
  for (std::size_t i = 0; i < polygons->size(); ++i) {
    if (auto fits = budget.take_zone(polygons->path()); !fits) return fits;
    if (auto read = read_polygon(polygons->item(i), fence, budget); !read) return read;
  }
  auto const circles = node.list_or_none("circles");
  if (!circles) return std::unexpected(circles.error());
  for (std::size_t i = 0; i < circles->size(); ++i) {
    if (auto fits = budget.take_zone(circles->path()); !fits) return fits;
    if (auto read = read_circle(circles->item(i), fence); !read) return read;
  }
  if (!node.has("breachReturn")) return {};
  auto const place = node.place("breachReturn");
  if (!place) return std::unexpected(place.error());
  fence.breach_return = *place;
  return {};
}

Result<> read_rally(Node const& node, std::vector<RallyPoint>& rally) {
  auto const points = node.list_or_none("points");
  if (!points) return std::unexpected(points.error());
  if (points->size() > max_mission_items) return wrong(points->path(), "more rally points than a vehicle can hold");
  for (std::size_t i = 0; i < points->size(); ++i) {
    auto const place = points->item(i).place();
    if (!place) return std::unexpected(place.error());
    rally.push_back({.place = *place});
  }
  return {};
}

}  // namespace

Result<std::size_t> count_items(Json const& item, std::string const& path) {
  Assembly assembly;
  std::vector<Pattern> patterns;
  if (auto added = add_item(Node(item, path), assembly, patterns); !added) return std::unexpected(added.error());
  return assembly.size();
}

Result<PlanFile> read_qgc_plan(std::string_view file, Json const& json) {
  Node const root(json, std::string(file), true);
  auto const mission = root.member("mission");
  if (!mission) return std::unexpected(mission.error());
  PlanFile read{.plan = {}};
  if (auto done = read_mission(*mission, read.plan); !done) return std::unexpected(done.error());
  if (root.has("geoFence")) {
    if (auto done = read_fence(*root.member("geoFence"), read.plan.fence); !done) return std::unexpected(done.error());
  }
  if (root.has("rallyPoints")) {
    if (auto done = read_rally(*root.member("rallyPoints"), read.plan.rally); !done)
      return std::unexpected(done.error());
  }
  return read;
}

}  // namespace lapwing::plan::internal
