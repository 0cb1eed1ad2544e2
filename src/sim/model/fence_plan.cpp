#include "sim/model/fence_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim {

using mavlink::MavCmd;
using mavlink::MavMissionResult;

namespace {

bool is_vertex(MavCmd command) {
  return command == MavCmd::nav_fence_polygon_vertex_inclusion || command == MavCmd::nav_fence_polygon_vertex_exclusion;
}

bool belongs(mavlink::MissionItem const& item) {
  if (item.type == mavlink::MissionType::rally) return item.command == MavCmd::nav_rally_point;
  return is_vertex(item.command) || item.command == MavCmd::nav_fence_circle_inclusion ||
         item.command == MavCmd::nav_fence_circle_exclusion || item.command == MavCmd::nav_fence_return_point;
}

}  // namespace

MavMissionResult zone_refusal(mavlink::MissionItem const& item) {
  if (!belongs(item)) return MavMissionResult::unsupported;
  if (!mavlink::is_global(item.frame)) return MavMissionResult::unsupported_frame;
  if (!(std::abs(item.place.lat_rad) <= std::numbers::pi / 2.0)) return MavMissionResult::invalid_param5_x;
  if (!(std::abs(item.place.lon_rad) <= std::numbers::pi)) return MavMissionResult::invalid_param6_y;
  return MavMissionResult::accepted;
}

mavlink::MissionItem normalised_zone(mavlink::MissionItem item) {
  item.current = 0;
  item.autocontinue = false;
  item.target = {};
  item.form = mavlink::ItemForm::integer;
  return item;
}

std::optional<std::string> fence_problem(MissionPlan const& fence) {
  for (std::size_t i = 0; i < fence.size();) {
    if (!is_vertex(fence[i].command)) {
      ++i;
      continue;
    }
    auto const count = static_cast<int>(fence[i].params[0]);
    if (count < 3) return fmt::format("Invalid vertex count ({})", count);
    for (int k = 0; k < count; ++k, ++i) {
      bool const same = i < fence.size() && fence[i].command == fence[i - static_cast<std::size_t>(k)].command &&
                        static_cast<int>(fence[i].params[0]) == count;
      if (!same) return "Incorrect vertex count";
    }
  }
  return std::nullopt;
}

std::vector<FenceArea> fence_areas(MissionPlan const& fence, Site const& site) {
  std::vector<FenceArea> areas;
  auto const level = [&](mavlink::MissionItem const& item) {
    auto const point = site.ned_from({item.place.lat_rad, item.place.lon_rad, site.anchor().alt_m});
    return plan::LevelPoint{point.north, point.east};
  };
  for (std::size_t i = 0; i < fence.size();) {
    auto const& item = fence[i];
    bool const circle =
        item.command == MavCmd::nav_fence_circle_inclusion || item.command == MavCmd::nav_fence_circle_exclusion;
    FenceArea area{.includes = item.command == MavCmd::nav_fence_polygon_vertex_inclusion ||
                               item.command == MavCmd::nav_fence_circle_inclusion};
    std::size_t used = 1;
    if (circle) {
      area.center = level(item);
      area.radius_m = item.params[0];
      areas.push_back(std::move(area));
    } else if (is_vertex(item.command)) {
      used = std::min(static_cast<std::size_t>(item.params[0]), fence.size() - i);
      plan::Ring ring;
      for (std::size_t k = 0; k < used; ++k) ring.push_back(level(fence[i + k]));
      area.polygon.rings.push_back(std::move(ring));
      areas.push_back(std::move(area));
    }
    i += used;
  }
  return areas;
}

bool contains(FenceArea const& area, geo::Ned point) {
  if (!area.polygon.rings.empty()) return geo::contains(area.polygon, {point.north, point.east});
  return std::hypot(point.north - area.center.x(), point.east - area.center.y()) <= area.radius_m;
}

double distance_to_edge_m(FenceArea const& area, geo::Ned point) {
  if (!area.polygon.rings.empty()) return geo::distance_to_edge_m(area.polygon, {point.north, point.east});
  double const off_m = std::hypot(point.north - area.center.x(), point.east - area.center.y());
  return std::abs(off_m - area.radius_m);
}

}  // namespace lapwing::sim
