#include "dryrun/flight_json.hpp"

#include <cstdlib>

#include "base/text/json.hpp"
#include "dryrun/missions.hpp"
#include "geo/position_json.hpp"

namespace lapwing::dryrun {

using base::to_seconds;
using geo::Json;
using geo::rounded;

namespace {

Json seconds(base::Duration time) {
  return rounded(to_seconds(time), 3);
}

/// Tracks are local: shown as places on Earth.
class Places {
 public:
  explicit Places(geo::Wgs84 home) : home_(home) {}
  [[nodiscard]] Json at(geo::Ned offset) const { return geo::position_json(geo::displaced(home_, offset)); }
  [[nodiscard]] Json row(geo::Ned offset) const {
    auto const place = geo::displaced(home_, offset);
    return {rounded(place.lat_deg(), 7), rounded(place.lon_deg(), 7), rounded(place.alt_m, 2)};
  }

 private:
  geo::Wgs84 home_;
};

void add(Json& json, Figures const& sums) {
  json["track_m"] = rounded(sums.path_m, 2);
  json["highest_m"] = rounded(sums.highest_m, 2);
  json["battery_used"] = rounded(sums.battery_used, 4);
  json["energy_wh"] = rounded(sums.energy_wh, 3);
}

Json mission_json(VehicleRecord const& vehicle, TaskSpan const& span) {
  Json json{{"name", span.name},
            {"outcome", to_string(span.ending)},
            {"error", span.reason},
            {"begin_s", seconds(span.begin)},
            {"end_s", seconds(span.end)}};
  add(json, figures(vehicle, span.begin, span.end));
  if (!span.flown) return json;
  json["estimate_s"] = seconds(span.flown->estimate.duration);
  json["actual_s"] = seconds(span.flown->duration);
  json["estimate_m"] = rounded(span.flown->estimate.path_m, 2);
  json["actual_m"] = rounded(span.flown->path_m, 2);
  return json;
}

Json vehicle_json(VehicleRecord const& vehicle, Figures const& sums, Places const& places) {
  Json json{{"id", vehicle.id},
            {"system_id", std::atoi(vehicle.id.c_str())},
            {"name", vehicle.name},
            {"type", to_string(vehicle.family)}};
  add(json, sums);
  json["under_way_s"] = seconds(vehicle.under_way);
  json["ends_in_the_air"] = vehicle.ends_in_the_air;
  auto& missions = json["missions"] = Json::array();
  for (auto const& span : vehicle.tasks) missions.push_back(mission_json(vehicle, span));
  auto& modes = json["modes"] = Json::array();
  for (auto const& change : vehicle.modes) modes.push_back({{"t_s", seconds(change.time)}, {"mode", change.mode}});
  auto& track = json["track"] = Json::array();
  for (std::size_t i = 0; i < vehicle.track.size(); ++i) {
    Json row{seconds(vehicle.track[i].time)};
    for (auto const& value : places.row(vehicle.track[i].place_m)) row.push_back(value);
    row.push_back(rounded(static_cast<double>(vehicle.charge[i].remaining), 4));
    track.push_back(std::move(row));
  }
  return json;
}

Json item_table(FlightRecord const& record) {
  auto all = Json::array();
  for (auto const& mission : missions_of(record)) {
    Json json{{"name", mission.name}, {"allocation", mission.allocation}};
    auto& items = json["items"] = Json::array();
    for (std::size_t i = 0; i < mission.items.size(); ++i) {
      auto const& item = mission.items[i];
      Json row{{"command", item.command}, {"params", mission.mission->items[i].params}};
      if (item.place) {
        row["lat_deg"] = rounded(item.place->lat_deg(), 7);
        row["lon_deg"] = rounded(item.place->lon_deg(), 7);
        row["alt_m"] = rounded(item.place->alt_m, 2);
      }
      items.push_back(std::move(row));
    }
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace

std::string to_json(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence) {
  Places const places(record.home);
  Json json{{"script", record.script},
            {"outcome", record.outcome},
            {"error", record.reason},
            {"duration_s", seconds(record.duration)},
            {"home", places.at({})},
            {"wind_m_s", {record.wind_m_s.north, record.wind_m_s.east}},
            {"gust_m_s", record.gust_m_s},
            {"seed", record.seed},
            {"sample_period_s", seconds(record.sample_period)}};
  auto& vehicles = json["vehicles"] = Json::array();
  for (std::size_t i = 0; i < record.vehicles.size(); ++i)
    vehicles.push_back(vehicle_json(record.vehicles[i], analysis.vehicles[i], places));
  json["missions"] = item_table(record);
  auto& approaches = json["approaches"] = Json::array();
  for (auto const& [first, second, approach] : analysis.pairs) {
    approaches.push_back({{"vehicles", {record.vehicles[first].id, record.vehicles[second].id}},
                          {"t_s", seconds(approach.time)},
                          {"distance_m", rounded(approach.distance_m, 3)},
                          {"level_m", rounded(approach.level_m, 3)},
                          {"places", {places.at(approach.first_m), places.at(approach.second_m)}}});
  }
  json["fence_zones"] = fence.zones.size();
  auto& breaches = json["breaches"] = Json::array();
  for (auto const& [vehicle, breach] : analysis.breaches) {
    breaches.push_back({{"vehicle", record.vehicles[vehicle].id},
                        {"zone", breach.zone},
                        {"fence", breach.kind == plan::Zone::Kind::inclusion ? "inclusion" : "exclusion"},
                        {"begin_s", seconds(breach.begin)},
                        {"end_s", seconds(breach.end)},
                        {"depth_m", rounded(breach.depth_m, 3)},
                        {"by_height", breach.by_height},
                        {"worst_s", seconds(breach.worst.time)},
                        {"worst", places.at(breach.worst.place_m)}});
  }
  auto& remarks = json["remarks"] = Json::array();
  for (auto const& remark : record.remarks) remarks.push_back({{"t_s", seconds(remark.time)}, {"text", remark.text}});
  return base::to_text(json) + "\n";
}

}  // namespace lapwing::dryrun
