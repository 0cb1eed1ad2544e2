// Writes QGroundControl's plan files (version 1, mission version 2).
#include "plan/files/internal/json_node.hpp"

namespace lapwing::plan::internal {
namespace {

Json place_json(geo::Wgs84 const& place, bool has_height) {
  auto json = Json::array({file_degrees(place.lat_deg()), file_degrees(place.lon_deg())});
  if (has_height) json.push_back(base::json_number<Json>(place.alt_m));
  return json;
}

/// Into a simple item that may hold more.
void write_item(mavlink::MissionItem const& item, std::size_t number, Json& into) {
  auto const values = from_item(item);
  into["type"] = "SimpleItem";
  into["command"] = static_cast<int>(values.command);
  into["frame"] = static_cast<int>(values.frame);
  into["autoContinue"] = values.autocontinue;
  into["doJumpId"] = number;
  into.erase("coordinate");
  auto& params = into["params"] = Json::array();
  for (double const value : values.params) params.push_back(base::json_number<Json>(value));
}

Json items_json(Plan const& plan) {
  auto json = Json::array();
  auto pattern = plan.patterns.begin();
  for (std::size_t i = 0; i <= plan.mission.items.size();) {
    if (pattern != plan.patterns.end() && pattern->first == i) {
      json.push_back(pattern_json(plan, *pattern));
      i += pattern->count;
      ++pattern;
    } else if (i < plan.mission.items.size()) {
      auto& item = json.emplace_back(Json::object());
      write_item(plan.mission.items[i], i + 1, item);
      ++i;
    } else {
      break;
    }
  }
  return json;
}

Json mission_json(Plan const& plan) {
  constexpr int above_home = 1;
  Json json{{"version", 2},
            {"firmwareType", plan.firmware_type},
            {"vehicleType", plan.vehicle_type},
            {"globalPlanAltitudeMode", above_home},
            {"plannedHomePosition", place_json(plan.mission.planned_home.value_or(geo::Wgs84{}), true)},
            {"items", items_json(plan)}};
  if (plan.cruise_speed_m_s) json["cruiseSpeed"] = base::json_number<Json>(*plan.cruise_speed_m_s);
  if (plan.hover_speed_m_s) json["hoverSpeed"] = base::json_number<Json>(*plan.hover_speed_m_s);
  return json;
}

Json fence_json(GeoFence const& fence) {
  auto polygons = Json::array();
  auto circles = Json::array();
  for (auto const& zone : fence.zones) {
    bool const is_inclusion = zone.kind == Zone::Kind::inclusion;
    if (auto const* circle = std::get_if<GeoCircle>(&zone.area)) {
      circles.push_back(
          {{"circle",
            {{"center", place_json(circle->center, false)}, {"radius", base::json_number<Json>(circle->radius_m)}}},
           {"inclusion", is_inclusion},
           {"version", 1}});
      continue;
    }
    auto corners = Json::array();
    for (auto const& corner : std::get<std::vector<GeoPolygon>>(zone.area)[0].rings[0])
      corners.push_back(place_json(corner, false));
    polygons.push_back({{"polygon", std::move(corners)}, {"inclusion", is_inclusion}, {"version", 1}});
  }
  Json json{{"version", 2}, {"polygons", std::move(polygons)}, {"circles", std::move(circles)}};
  if (fence.breach_return) json["breachReturn"] = place_json(*fence.breach_return, true);
  return json;
}

}  // namespace

Json pattern_json(Plan const& plan, Pattern const& pattern) {
  auto json = Json::parse(pattern.json, nullptr, false);  // it was read by us; text of another kind is written as null
  auto const& items = plan.mission.items;
  if (json.value("type", Json()) == "SimpleItem") {
    write_item(items[pattern.first], pattern.first + 1, json);
  } else if (json.contains("TransectStyleComplexItem")) {
    auto& stored = json["TransectStyleComplexItem"]["Items"];
    for (std::size_t i = 0; i < pattern.count; ++i)
      write_item(items[pattern.first + i], pattern.first + i + 1, stored[i]);
  }
  return json;
}

std::string write_qgc_plan(Plan const& plan) {
  auto points = Json::array();
  for (auto const& point : plan.rally) points.push_back(place_json(point.place, true));
  Json const json{{"fileType", "Plan"},
                  {"version", 1},
                  {"groundStation", "Lapwing"},
                  {"mission", mission_json(plan)},
                  {"geoFence", fence_json(plan.fence)},
                  {"rallyPoints", {{"version", 2}, {"points", std::move(points)}}}};
  return json.dump(4) + "\n";
}

}  // namespace lapwing::plan::internal
