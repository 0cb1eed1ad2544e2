#include "station/messages/health_messages.hpp"

#include <utility>

#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

Json to_json(vehicle::ModuleError const& error) {
  return {{"code", error.code},
          {"severity", vehicle::to_string(error.severity)},
          {"meaning", error.meaning},
          {"what_to_do", error.what_to_do}};
}

Json to_json(vehicle::ModuleView const& module) {
  Json json{{"module", module.short_name},
            {"name", module.name},
            {"required", module.is_required},
            {"state", vehicle::to_string(module.state)}};
  if (module.error) json["error"] = to_json(*module.error);
  if (module.memory_bytes) json["memory_bytes"] = *module.memory_bytes;
  if (module.cpu_share) json["cpu_share"] = rounded(*module.cpu_share, 3);
  if (!module.since_heard) return json;
  json["rate_hz"] = rounded(module.reports_per_s, 1);
  json["age_s"] = rounded(base::to_seconds(*module.since_heard), 3);
  return json;
}

Json to_json(vehicle::ModulesOfVehicle const& vehicle) {
  Json json{{"id", vehicle.vehicle.text},
            {"name", vehicle.name},
            {"may_move", vehicle.may_move},
            {"needs_restart", vehicle.needs_restart},
            {"modules", Json::array()}};
  if (!vehicle.who.empty()) json["who"] = vehicle.who;
  if (!vehicle.reason.empty()) json["reason"] = vehicle.reason;
  if (!vehicle.what_to_do.empty()) json["what_to_do"] = vehicle.what_to_do;
  for (auto const& module : vehicle.modules) json["modules"].push_back(to_json(module));
  return json;
}

}  // namespace

std::string health_message(std::vector<vehicle::ModulesOfVehicle> const& vehicles) {
  Json list = Json::array();
  for (auto const& vehicle : vehicles) list.push_back(to_json(vehicle));
  return dump({{"type", "health"}, {"vehicles", std::move(list)}});
}

void add_health_route(Router& router, vehicle::VehicleModules const* modules, base::Loop const& loop) {
  router.add("GET", "/api/v1/health", [modules, &loop](HttpRequest const&) {
    return HttpResponse{
        .body = health_message(modules ? modules->modules(loop.now()) : std::vector<vehicle::ModulesOfVehicle>())};
  });
}

}  // namespace lapwing::station
