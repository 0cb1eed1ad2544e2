#include "station/operator/control_routes.hpp"

#include <utility>

#include <fmt/format.h>

#include "station/messages/control_messages.hpp"

namespace lapwing::station {

namespace {

using vehicle::VehicleControl;

/// Reads the body as a request of that type and does it; `answer` is the body after that.
template <class Answer>
HttpResponse obey_post(VehicleControl* control, base::Logger const& log, std::string_view type,
                       HttpRequest const& request, Answer answer) {
  auto asked = parse_request_body(type, request.body);
  if (!asked) return problem(asked.error());
  log.warn(fmt::format("{} asked for over HTTP", type));
  auto const done = obey(control, std::get<ControlRequest>(*std::move(asked)), unnamed_client);
  if (!done) return problem(done.error());
  return {.status = 202, .body = answer()};
}

std::string all_commands(VehicleControl const* control) {
  return commands_message(control ? control->commands() : std::deque<vehicle::CommandRecord>());
}

std::string emergency(VehicleControl const* control) {
  return emergency_message(control ? control->emergency() : vehicle::EmergencyStop());
}

}  // namespace

void add_control_routes(Router& router, VehicleControl* control, base::Logger const& log) {
  auto const post = [&router, control, &log](std::string path, std::string type, auto answer) {
    router.add("POST", std::move(path), [control, &log, type = std::move(type), answer](HttpRequest const& request) {
      return obey_post(control, log, type, request, answer);
    });
  };
  router.add("GET", "/api/v1/commands",
             [control](HttpRequest const&) { return HttpResponse{.body = all_commands(control)}; });
  post("/api/v1/commands", "command", [control] { return command_body(control->commands().back()); });
  router.add("GET", "/api/v1/emergency-stop",
             [control](HttpRequest const&) { return HttpResponse{.body = emergency(control)}; });
  post("/api/v1/emergency-stop", "emergency_stop", [control] { return emergency(control); });
  post("/api/v1/emergency-stop/release", "release_emergency_stop", [control] { return emergency(control); });
  auto const nothing = [] { return std::string("{}"); };
  post("/api/v1/control/request", "request_control", nothing);
  post("/api/v1/control/yield", "yield_control", nothing);
  post("/api/v1/control/keep", "keep_control", nothing);
}

}  // namespace lapwing::station
