#include "apps/vehicles/mission/plan_summary.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/text/json.hpp"
#include "geo/position_json.hpp"
#include "plan/estimate.hpp"

namespace lapwing::apps {

namespace {

using geo::Json;
using mavlink::MavFrame;
using mavlink::MissionItem;

std::string_view height_words(MavFrame frame) {
  switch (frame) {
    case MavFrame::global:
    case MavFrame::global_int: return "above sea level";
    case MavFrame::global_terrain_alt:
    case MavFrame::global_terrain_alt_int: return "above the terrain";
    default: return "above home";
  }
}

bool is_placed(MissionItem const& item) {
  return mavlink::has_place(item.command) && mavlink::is_global(item.frame);
}

std::string line_of(MissionItem const& item, std::size_t number) {
  auto line = fmt::format("  {:>4}  {:<28}", number, to_string(item.command));
  if (is_placed(item)) {
    auto const place = plan::position_of(item);
    line += fmt::format(" {:.7f} {:.7f} {:.1f} m {}", place.lat_deg(), place.lon_deg(), place.alt_m,
                        height_words(item.frame));
  }
  for (std::size_t i = 0; i < item.params.size(); ++i)
    if (item.params[i] != 0.0F && !std::isnan(item.params[i])) line += fmt::format("  p{} {}", i + 1, item.params[i]);
  return line + "\n";
}

std::string line_of(plan::GeoZone const& zone) {
  auto const* const kind = zone.kind == plan::Zone::Kind::inclusion ? "stay in" : "stay out of";
  auto const name = zone.name.empty() ? "" : fmt::format(" '{}'", zone.name);
  if (auto const* circle = std::get_if<plan::GeoCircle>(&zone.area))
    return fmt::format("        {}{}: a circle of {} m round {:.7f} {:.7f}\n", kind, name, circle->radius_m,
                       circle->center.lat_deg(), circle->center.lon_deg());
  auto const& polygons = std::get<std::vector<plan::GeoPolygon>>(zone.area);
  std::size_t corners = 0;
  std::size_t holes = 0;
  for (auto const& polygon : polygons) {
    corners += polygon.rings.front().size();
    holes += polygon.rings.size() - 1;
  }
  return fmt::format("        {}{}: {} of {} corners{}\n", kind, name,
                     polygons.size() == 1 ? "a polygon" : fmt::format("{} polygons", polygons.size()), corners,
                     holes > 0 ? fmt::format(", {} holes", holes) : "");
}

Json item_json(MissionItem const& item) {
  Json json{{"command", static_cast<int>(item.command)},
            {"name", to_string(item.command)},
            {"frame", static_cast<int>(item.frame)},
            {"params", Json::array()}};
  for (float const param : item.params) json["params"].push_back(std::isfinite(param) ? Json(param) : Json(nullptr));
  if (is_placed(item)) json["position"] = geo::position_json(plan::position_of(item));
  return json;
}

Json report_json(ListReport const& report) {
  Json json{{"type", to_string(report.type)}, {"items", report.items}, {"outcome", report.outcome}};
  if (report.outcome == "uploaded" || report.outcome == "unchanged" || report.replacement.written > 0) {
    json["written"] = report.replacement.written;
    json["upload_s"] = geo::rounded(base::to_seconds(report.replacement.upload_time), 3);
  }
  if (!report.error.empty()) {
    json["error"] = report.error;
    json["state"] = mavlink::to_string(report.replacement.left);
  }
  if (report.replacement.held.opaque_id != 0) json["opaque_id"] = report.replacement.held.opaque_id;
  return json;
}

}  // namespace

std::string to_text(plan::Plan const& plan) {
  std::string text;
  auto const out = std::back_inserter(text);
  auto const& mission = plan.mission;
  if (mission.planned_home)
    fmt::format_to(out, "home    {:.7f} {:.7f} {:.1f} m\n", mission.planned_home->lat_deg(),
                   mission.planned_home->lon_deg(), mission.planned_home->alt_m);
  fmt::format_to(out, "mission {} items", mission.items.size());
  auto const estimate = plan::estimate(mission, mission.planned_home);
  if (!mission.items.empty())
    fmt::format_to(out, ", {:.0f} m{}", estimate.path_m, estimate.is_endless ? " until it goes on without end" : "");
  text += '\n';
  for (std::size_t i = 0; i < mission.items.size(); ++i) text += line_of(mission.items[i], i + 1);
  fmt::format_to(out, "fence   {} zones\n", plan.fence.zones.size());
  for (auto const& zone : plan.fence.zones) text += line_of(zone);
  fmt::format_to(out, "rally   {} points\n", plan.rally.size());
  for (auto const& point : plan.rally)
    fmt::format_to(out, "        {:.7f} {:.7f} {:.1f} m {}\n", point.place.lat_deg(), point.place.lon_deg(),
                   point.place.alt_m, height_words(point.frame));
  return text;
}

std::string to_text(fleet::MavlinkVehicle const& craft, ListReport const& report) {
  auto const& replacement = report.replacement;
  auto text =
      fmt::format("{}: {}: {} items {}", craft.state.name, to_string(report.type), report.items, report.outcome);
  if (report.outcome == "uploaded" && replacement.written < report.items)
    text += fmt::format(", {} of them written", replacement.written);
  if (report.outcome == "uploaded")
    text += fmt::format(" in {:.1f} s and read back", base::to_seconds(replacement.upload_time));
  if (report.outcome == "cleared" || report.outcome == "not supported")
    text = fmt::format("{}: {}: {}", craft.state.name, to_string(report.type), report.outcome);
  return text + "\n";
}

std::string to_json(fleet::MavlinkVehicle const* craft, std::vector<ListReport> const& reports,
                    plan::Plan const& plan) {
  Json json;
  if (craft) {
    json["vehicle"] = craft->state.system_id;
    if (!craft->network.empty()) json["network"] = craft->network;
    json["plans"] = Json::array();
    for (auto const& report : reports) json["plans"].push_back(report_json(report));
  }
  auto& items = json["items"] = Json::array();
  for (auto const& item : plan.mission.items) items.push_back(item_json(item));
  json["planned_home"] = plan.mission.planned_home ? geo::position_json(*plan.mission.planned_home) : Json(nullptr);
  json["fence_zones"] = plan.fence.zones.size();
  json["rally_points"] = plan.rally.size();
  json["estimate_m"] = geo::rounded(plan::estimate(plan.mission, plan.mission.planned_home).path_m, 1);
  return base::to_text(json, 1);
}

}  // namespace lapwing::apps
