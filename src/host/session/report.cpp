#include "host/session/report.hpp"

#include <nlohmann/json.hpp>

#include "base/text/json.hpp"
#include "base/text/utc_text.hpp"

namespace lapwing::host {

using nlohmann::json;

namespace {

json to_json_value(tasks::TaskView const& view) {
  json value{{"id", view.id},
             {"kind", view.kind},
             {"label", view.label},
             {"line", view.line},
             {"state", to_string(view.state)},
             {"detail", view.detail},
             {"vehicle", view.vehicle ? json(view.vehicle->text) : json(nullptr)}};
  auto& children = value["children"] = json::array();
  for (auto const& child : view.children) children.push_back(to_json_value(child));
  return value;
}

json to_json_value(RobotReport const& robot) {
  auto drives = json::array();
  for (auto const& drive : robot.drives) {
    drives.push_back({{"name", drive.name}, {"outcome", drive.outcome}, {"error", drive.error}});
    if (!drive.remark.empty()) drives.back()["remark"] = drive.remark;
  }
  json value{{"coverage", robot.coverage},  {"free_m2", robot.free_m2}, {"closures", robot.closures},
             {"doors", robot.signs.size()}, {"signs", robot.signs},     {"drives", std::move(drives)}};
  if (robot.collisions) value["collisions"] = *robot.collisions;
  return value;
}

json to_json_value(VehicleReport const& vehicle) {
  auto missions = json::array();
  for (auto const& mission : vehicle.missions) {
    json value{{"name", mission.name},
               {"items", mission.items},
               {"upload_s", mission.upload_s},
               {"outcome", mission.outcome},
               {"error", mission.error}};
    if (mission.flown) {
      value["estimate_s"] = base::to_seconds(mission.flown->estimate.duration);
      value["actual_s"] = base::to_seconds(mission.flown->duration);
      value["estimate_m"] = mission.flown->estimate.path_m;
      value["actual_m"] = mission.flown->path_m;
      value["estimate_is_endless"] = mission.flown->estimate.is_endless;
    }
    missions.push_back(std::move(value));
  }
  json value{{"id", vehicle.id},           {"system_id", vehicle.system_id}, {"type", vehicle.type},
             {"track_m", vehicle.track_m}, {"pictures", vehicle.pictures},   {"missions", std::move(missions)}};
  if (vehicle.robot) value["robot"] = to_json_value(*vehicle.robot);
  return value;
}

json to_json_value(CarParkReport const& report) {
  json value{{"pictures", report.pictures},
             {"coverage", report.coverage},
             {"free", report.free},
             {"taken", report.taken},
             {"unknown", report.unknown}};
  if (auto const& score = report.score)
    value["score"] = {{"true_slots", score->true_slots}, {"found", score->found},       {"told", score->told},
                      {"right", score->right},           {"invented", score->invented}, {"off_m", score->off_m}};
  return value;
}

}  // namespace

std::string to_json(RunReport const& report) {
  json value{{"script", report.script},
             {"outcome", report.outcome},
             {"started", base::to_iso8601(report.started)},
             {"ended", base::to_iso8601(report.ended)}};
  auto& vehicles = value["vehicles"] = json::array();
  for (auto const& vehicle : report.vehicles) vehicles.push_back(to_json_value(vehicle));
  if (report.car_park) value["car_park"] = to_json_value(*report.car_park);
  auto& tasks = value["tasks"] = json::array();
  for (auto const& task : report.tasks) tasks.push_back(to_json_value(task));
  auto& errors = value["errors"] = json::array();
  for (auto const& error : report.errors) {
    errors.push_back({{"file", error.file}, {"line", error.line}, {"message", error.message}});
  }
  return base::to_text(value, 2) + "\n";
}

}  // namespace lapwing::host
