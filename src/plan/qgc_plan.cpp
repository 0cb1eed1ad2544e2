// QGroundControl's plan files: JSON, described in its developer guide under "Plan file format".
#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "plan/internal/plan_reader.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;
using mavlink::MavCmd;
using nlohmann::json;

constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// A value with its path for messages: "a.plan: mission.items[3]".
class Node {
 public:
  Node(json const& value, std::string path, bool is_root = false)
      : value_(&value), path_(std::move(path)), is_root_(is_root) {}

  [[nodiscard]] std::string const& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return value_->size(); }
  [[nodiscard]] bool has(char const* key) const { return value_->is_object() && value_->contains(key); }
  [[nodiscard]] Node item(std::size_t index) const { return {(*value_)[index], fmt::format("{}[{}]", path_, index)}; }
  [[nodiscard]] Result<Node> member(char const* key) const {
    if (!value_->is_object()) return wrong(path_, "an object { ... } was expected");
    auto const found = value_->find(key);
    if (found == value_->end()) return wrong(path_, fmt::format("\"{}\" is missing", key));
    return Node(*found, join(key));
  }
  [[nodiscard]] Result<Node> list(char const* key) const {
    auto found = member(key);
    if (found && !found->value_->is_array()) return wrong(found->path_, "a list [ ... ] was expected");
    return found;
  }
  [[nodiscard]] Result<double> number(char const* key) const {
    auto const found = member(key);
    if (!found) return std::unexpected(found.error());
    if (!found->value_->is_number()) return wrong(found->path_, "a number was expected");
    return found->value_->get<double>();
  }
  [[nodiscard]] double number_or(char const* key, double otherwise) const {
    return has(key) && (*value_)[key].is_number() ? (*value_)[key].get<double>() : otherwise;
  }
  [[nodiscard]] bool flag_or(char const* key, bool otherwise) const {
    return has(key) && (*value_)[key].is_boolean() ? (*value_)[key].get<bool>() : otherwise;
  }
  [[nodiscard]] std::string text_or(char const* key, std::string otherwise) const {
    return has(key) && (*value_)[key].is_string() ? (*value_)[key].get<std::string>() : std::move(otherwise);
  }
  /// A list of numbers; null stands for NaN.
  [[nodiscard]] Result<std::vector<double>> numbers(char const* key, std::size_t most) const {
    auto const found = list(key);
    if (!found) return std::unexpected(found.error());
    if (found->size() > most) return wrong(found->path_, fmt::format("at most {} numbers were expected", most));
    std::vector<double> values;
    for (std::size_t i = 0; i < found->size(); ++i) {
      auto const& value = (*found->value_)[i];
      if (!value.is_number() && !value.is_null()) return wrong(found->item(i).path_, "a number was expected");
      values.push_back(value.is_null() ? unset : value.get<double>());
    }
    return values;
  }
  /// Latitude, longitude and height.
  [[nodiscard]] Result<geo::Wgs84> place(char const* key) const {
    auto const values = numbers(key, 3);
    if (!values) return std::unexpected(values.error());
    if (values->size() < 2) return wrong(join(key), "latitude, longitude and height were expected");
    auto const place = to_place((*values)[0], (*values)[1], values->size() == 3 ? (*values)[2] : 0.0);
    if (!place) return wrong(join(key), place.error().message);
    return place;
  }

 private:
  [[nodiscard]] std::string join(char const* key) const {
    return fmt::format("{}{}{}", path_, is_root_ ? ": " : ".", key);
  }
  json const* value_;
  std::string path_;
  bool is_root_;
};

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
  if (node.has("doJumpId")) assembly.number_next(node.number_or("doJumpId", unset));
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
  return wrong(node.path(), fmt::format("a complex item of type '{}' holds no items to fly", kind),
               "save the mission as way points (\"QGC WPL 110\"), or draw this part with a survey");
}

Result<> add_item(Node const& node, Assembly& assembly) {
  auto const type = node.text_or("type", "");
  if (type == "SimpleItem") return add_simple(node, assembly);
  if (type == "ComplexItem") return add_complex(node, assembly);
  return wrong(node.path(), fmt::format("an item's type is SimpleItem or ComplexItem, not '{}'", type));
}

std::size_t count_of(json const& plan, char const* part, char const* list) {
  auto const found = plan.find(part);
  if (found == plan.end() || !found->is_object()) return 0;
  auto const items = found->find(list);
  return items != found->end() && items->is_array() ? items->size() : 0;
}

std::vector<std::string> notes_on(json const& plan) {
  std::vector<std::string> notes;
  auto const zones = count_of(plan, "geoFence", "polygons") + count_of(plan, "geoFence", "circles");
  auto const points = count_of(plan, "rallyPoints", "points");
  if (zones > 0) notes.push_back(fmt::format("its geofence ({} polygons and circles) is not uploaded", zones));
  if (points > 0) notes.push_back(fmt::format("its {} rally points are not uploaded", points));
  return notes;
}

/// "line 3, column 7", from the number of bytes read.
std::string position_in(std::string_view text, std::size_t bytes) {
  auto const read = text.substr(0, bytes > 0 ? bytes - 1 : 0);
  auto const line_begin = read.rfind('\n');
  return fmt::format("{}:{}", 1 + std::ranges::count(read, '\n'),
                     read.size() - (line_begin == std::string_view::npos ? 0 : line_begin + 1) + 1);
}

Result<json> parse(std::string_view file, std::string_view text) {
  // The library reports errors by exceptions; they end here.
  try {
    return json::parse(text);
  } catch (json::parse_error const& error) {
    return wrong(fmt::format("{}:{}", file, position_in(text, error.byte)), "this is no JSON",
                 "a plan is a file of QGroundControl (.plan), or of way points beginning with QGC WPL 110");
  } catch (json::exception const&) {
    return wrong(file, "a number in it is too large");
  }
}

}  // namespace

Result<PlanFile> read_qgc_plan(std::string_view file, std::string_view text) {
  auto const parsed = parse(file, text);
  if (!parsed) return std::unexpected(parsed.error());
  Node const root(*parsed, std::string(file), true);
  if (root.text_or("fileType", "") != "Plan")
    return wrong(file, "this is no plan: \"fileType\" is not \"Plan\"", "save it with QGroundControl's plan view");
  auto const mission = root.member("mission");
  if (!mission) return std::unexpected(mission.error());
  PlanFile plan{.mission = {}, .notes = notes_on(*parsed)};
  if (mission->has("plannedHomePosition")) {
    auto const home = mission->place("plannedHomePosition");
    if (!home) return std::unexpected(home.error());
    plan.mission.planned_home = *home;
  }
  auto const items = mission->list("items");
  if (!items) return std::unexpected(items.error());
  Assembly assembly;
  for (std::size_t i = 0; i < items->size(); ++i) {
    if (auto added = add_item(items->item(i), assembly); !added) return std::unexpected(added.error());
  }
  auto finished = assembly.finish();
  if (!finished) return std::unexpected(finished.error());
  plan.mission.items = *std::move(finished);
  return plan;
}

}  // namespace lapwing::plan::internal
