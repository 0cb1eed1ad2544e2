#include "plan/files/vehicle_plan.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan {

using base::ErrorKind;
using base::fail;
using base::Result;
using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;
using mavlink::MissionType;

namespace {

using Polygons = std::vector<GeoPolygon>;

std::string called(GeoZone const& zone, std::size_t index) {
  return zone.name.empty() ? fmt::format("fence zone {}", index + 1) : fmt::format("fence zone '{}'", zone.name);
}

/// Its polygons as zones of their own. Only inside-any-of cannot be said with several inclusions, which mean inside
/// all of them.
void add_polygons(GeoZone const& zone, std::string const& name, GeoFence& simple, std::vector<std::string>& lost) {
  auto const& polygons = std::get<Polygons>(zone.area);
  bool const is_inclusion = zone.kind == Zone::Kind::inclusion;
  if (polygons.size() > 1) {
    lost.push_back(fmt::format("{}: its {} polygons are one zone{}", name, polygons.size(),
                               is_inclusion ? ", which cannot be said" : "; they become several"));
    if (is_inclusion) return;
  }
  for (auto const& polygon : polygons) {
    simple.zones.push_back({.kind = zone.kind, .area = Polygons{{{polygon.rings[0]}}}});
    if (polygon.rings.size() == 1) continue;
    lost.push_back(fmt::format("{}: its holes {}", name, is_inclusion ? "become zones to stay out of" : "are filled"));
    if (!is_inclusion) continue;
    for (auto hole = polygon.rings.begin() + 1; hole != polygon.rings.end(); ++hole)
      simple.zones.push_back({.kind = Zone::Kind::exclusion, .area = Polygons{{{*hole}}}});
  }
}

MissionItem item_at(MavCmd command, geo::Wgs84 const& place, MissionType type, float param1 = 0.0F) {
  MissionItem item;
  item.command = command;
  item.params[0] = param1;
  item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
  item.type = type;
  return item;
}

void number(std::vector<MissionItem>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) items[i].seq = static_cast<std::uint16_t>(i);
}

void add_vertices(GeoZone const& zone, std::vector<MissionItem>& items) {
  auto const command = zone.kind == Zone::Kind::inclusion ? MavCmd::nav_fence_polygon_vertex_inclusion
                                                          : MavCmd::nav_fence_polygon_vertex_exclusion;
  auto const& ring = std::get<Polygons>(zone.area)[0].rings[0];
  for (auto const& corner : ring)
    items.push_back(item_at(command, corner, MissionType::fence, static_cast<float>(ring.size())));
}

std::unexpected<base::Error> wrong_item(std::size_t index, MissionItem const& item, std::string_view what) {
  return fail(ErrorKind::invalid_input, fmt::format("item {} ({}): {}", index, to_string(item.command), what));
}

geo::Wgs84 level_place(MissionItem const& item) {
  return {item.place.lat_rad, item.place.lon_rad, 0.0};
}

bool is_vertex(MavCmd command) {
  return command == MavCmd::nav_fence_polygon_vertex_inclusion || command == MavCmd::nav_fence_polygon_vertex_exclusion;
}

/// The polygon that begins at `index`, which moves behind it.
Result<GeoZone> polygon_from(std::span<MissionItem const> items, std::size_t& index) {
  auto const& first = items[index];
  auto const count = static_cast<double>(first.params[0]);
  if (!(count >= 3.0) || count > static_cast<double>(items.size() - index))
    return wrong_item(index, first, fmt::format("a polygon of {} corners is not there", count));
  GeoRing ring;
  for (auto const end = index + static_cast<std::size_t>(count); index < end; ++index) {
    auto const& item = items[index];
    if (item.command != first.command || item.params[0] != first.params[0])
      return wrong_item(index, item, "it interrupts a polygon");
    ring.push_back(level_place(item));
  }
  bool const is_inclusion = first.command == MavCmd::nav_fence_polygon_vertex_inclusion;
  return GeoZone{.kind = is_inclusion ? Zone::Kind::inclusion : Zone::Kind::exclusion,
                 .area = Polygons{{{std::move(ring)}}}};
}

}  // namespace

GeoFence simple_fence(GeoFence const& fence, std::vector<std::string>& lost) {
  GeoFence simple{.zones = {}, .breach_return = fence.breach_return};
  for (std::size_t i = 0; i < fence.zones.size(); ++i) {
    auto const& zone = fence.zones[i];
    auto const name = called(zone, i);
    if (!zone.name.empty()) lost.push_back(fmt::format("{}: its name", name));
    if (zone.lowest || zone.highest) lost.push_back(fmt::format("{}: its limits of height", name));
    if (auto const* circle = std::get_if<GeoCircle>(&zone.area))
      simple.zones.push_back({.kind = zone.kind, .area = *circle});
    else
      add_polygons(zone, name, simple, lost);
  }
  return simple;
}

std::vector<MissionItem> fence_items(GeoFence const& simple) {
  std::vector<MissionItem> items;
  for (auto const& zone : simple.zones) {
    if (auto const* circle = std::get_if<GeoCircle>(&zone.area)) {
      auto const command =
          zone.kind == Zone::Kind::inclusion ? MavCmd::nav_fence_circle_inclusion : MavCmd::nav_fence_circle_exclusion;
      items.push_back(item_at(command, circle->center, MissionType::fence, static_cast<float>(circle->radius_m)));
    } else {
      add_vertices(zone, items);
    }
  }
  if (simple.breach_return) {
    items.push_back(item_at(MavCmd::nav_fence_return_point, *simple.breach_return, MissionType::fence));
    items.back().frame = MavFrame::global_relative_alt;
  }
  number(items);
  return items;
}

std::vector<MissionItem> rally_items(std::span<RallyPoint const> rally) {
  std::vector<MissionItem> items;
  for (auto const& point : rally) {
    items.push_back(item_at(MavCmd::nav_rally_point, point.place, MissionType::rally));
    items.back().frame = point.frame;
  }
  number(items);
  return items;
}

Mission mission_from(std::span<MissionItem const> items, vehicle::Autopilot autopilot) {
  Mission mission;
  bool const has_home = autopilot == vehicle::Autopilot::ardupilot && !items.empty();
  if (has_home) {
    auto const home = position_of(items[0]);
    if (home.lat_rad != 0.0 || home.lon_rad != 0.0) mission.planned_home = home;
    items = items.subspan(1);
  }
  mission.items.assign(items.begin(), items.end());
  for (auto& item : mission.items) {
    if (!has_home && item.command == MavCmd::do_jump) item.params[0] += 1.0F;
    item.target = {};
    item.current = 0;
  }
  number(mission.items);
  return mission;
}

Result<GeoFence> fence_from(std::span<MissionItem const> items) {
  GeoFence fence;
  for (std::size_t i = 0; i < items.size();) {
    auto const& item = items[i];
    if (!mavlink::is_global(item.frame)) return wrong_item(i, item, "its place is not on Earth");
    if (is_vertex(item.command)) {
      auto zone = polygon_from(items, i);
      if (!zone) return std::unexpected(zone.error());
      fence.zones.push_back(*std::move(zone));
      continue;
    }
    if (item.command == MavCmd::nav_fence_return_point) {
      fence.breach_return = position_of(item);
    } else if (item.command == MavCmd::nav_fence_circle_inclusion ||
               item.command == MavCmd::nav_fence_circle_exclusion) {
      if (!internal::is_radius(static_cast<double>(item.params[0])))
        return wrong_item(i, item, fmt::format("{} m is no radius", item.params[0]));
      bool const is_inclusion = item.command == MavCmd::nav_fence_circle_inclusion;
      fence.zones.push_back({.kind = is_inclusion ? Zone::Kind::inclusion : Zone::Kind::exclusion,
                             .area = GeoCircle{level_place(item), static_cast<double>(item.params[0])}});
    } else {
      return wrong_item(i, item, "this belongs to no fence");
    }
    ++i;
  }
  return fence;
}

Result<std::vector<RallyPoint>> rally_from(std::span<MissionItem const> items) {
  std::vector<RallyPoint> rally;
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto const& item = items[i];
    if (item.command != MavCmd::nav_rally_point) return wrong_item(i, item, "this is no rally point");
    if (!mavlink::is_global(item.frame)) return wrong_item(i, item, "its place is not on Earth");
    rally.push_back({.place = position_of(item), .frame = item.frame});
  }
  return rally;
}

MissionType list_of(MavCmd command) {
  if (command == MavCmd::nav_rally_point) return MissionType::rally;
  bool const is_fence = is_vertex(command) || command == MavCmd::nav_fence_circle_inclusion ||
                        command == MavCmd::nav_fence_circle_exclusion || command == MavCmd::nav_fence_return_point;
  return is_fence ? MissionType::fence : MissionType::mission;
}

}  // namespace lapwing::plan
