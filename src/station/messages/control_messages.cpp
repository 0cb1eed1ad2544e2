#include "station/messages/control_messages.hpp"

#include <utility>

#include "base/text/utc_text.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

using base::Result;

namespace {

Json to_json(vehicle::CommandRecord const& record) {
  Json vehicles = Json::array();
  for (auto const& outcome : record.outcomes) {
    Json one{{"vehicle", outcome.vehicle.text}, {"state", vehicle::to_string(outcome.state)}};
    if (!outcome.reason.empty()) one["reason"] = outcome.reason;
    if (outcome.left_m) one["left_m"] = rounded(*outcome.left_m, 1);
    if (!outcome.rule.empty()) one["rule"] = outcome.rule;
    vehicles.push_back(std::move(one));
  }
  Json json{{"number", record.number},
            {"action", vehicle::to_string(record.command.action)},
            {"by", record.by},
            {"asked", base::to_iso8601(record.asked)},
            {"vehicles", std::move(vehicles)}};
  if (record.command.height_m) json["height_m"] = *record.command.height_m;
  if (record.command.place) json["place"] = position_json(*record.command.place);
  if (!record.command.mode.empty()) json["mode"] = record.command.mode;
  if (!record.command.allow.empty()) json["allow"] = record.command.allow;
  return json;
}

}  // namespace

Result<std::uint64_t> obey(vehicle::VehicleControl* control, ControlRequest request, vehicle::Commander by) {
  if (!control)
    return base::fail(base::ErrorKind::refused, "These vehicles cannot be commanded.", "They are a recording.");
  if (!request.by.empty()) by = std::move(request.by);
  if (auto* const command = std::get_if<CommandVehicles>(&request.what))
    return control->command(std::move(command->command), command->vehicles, std::move(by), command->takes_over);
  Result<> done;
  if (auto const* stop = std::get_if<StopAll>(&request.what)) {
    control->emergency_stop(stop->action, std::move(by));
  } else if (std::holds_alternative<ReleaseStop>(request.what)) {
    control->release_emergency_stop(std::move(by));
  } else {
    auto const& change = std::get<ChangeCommander>(request.what);
    switch (change.what) {
      case ChangeCommander::What::request: done = control->request_control(change.vehicle, std::move(by)); break;
      case ChangeCommander::What::yield: done = control->yield_control(change.vehicle, std::move(by)); break;
      case ChangeCommander::What::keep: done = control->keep_control(change.vehicle, std::move(by)); break;
    }
  }
  if (!done) return std::unexpected(done.error());
  return std::uint64_t{0};
}

std::string commands_message(std::deque<vehicle::CommandRecord> const& commands) {
  Json list = Json::array();
  for (auto const& record : commands) list.push_back(to_json(record));
  return dump({{"type", "commands"}, {"commands", std::move(list)}});
}

std::string command_body(vehicle::CommandRecord const& command) {
  return dump(to_json(command));
}

std::string emergency_message(vehicle::EmergencyStop const& emergency) {
  Json vehicles = Json::array();
  for (auto const& stopped : emergency.vehicles)
    vehicles.push_back({{"vehicle", stopped.vehicle.text},
                        {"acknowledged", stopped.is_acknowledged},
                        {"confirmed", stopped.is_confirmed},
                        {"tries", stopped.tries},
                        {"detail", stopped.detail}});
  Json json{{"type", "emergency"},
            {"latched", emergency.is_latched},
            {"action", vehicle::to_string(emergency.action)},
            {"by", emergency.by},
            {"vehicles", std::move(vehicles)}};
  if (!emergency.by.empty()) json["since"] = base::to_iso8601(emergency.since);
  return dump(json);
}

}  // namespace lapwing::station
