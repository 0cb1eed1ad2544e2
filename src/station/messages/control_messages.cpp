#include "station/messages/control_messages.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "station/messages/json_parts.hpp"

namespace lapwing::station {

using base::Result;
using internal::number_member;
using internal::parse_object;
using internal::text_member;
using internal::wrong;
using vehicle::VehicleId;

namespace {

using What = ChangeCommander::What;

constexpr std::array<std::pair<std::string_view, What>, 3> changes{
    {{"request_control", What::request}, {"yield_control", What::yield}, {"keep_control", What::keep}}};

Result<std::vector<VehicleId>> vehicles_from(Json const& object) {
  constexpr std::size_t most = 1000;
  auto const found = object.find("vehicles");
  if (found == object.end() || !found->is_array() || found->empty() || found->size() > most)
    return wrong("\"vehicles\" must be a list of vehicle ids.");
  std::vector<VehicleId> vehicles;
  for (auto const& id : *found) {
    if (!id.is_string()) return wrong("\"vehicles\" must be a list of vehicle ids.");
    vehicles.push_back({id.get<std::string>()});
  }
  return vehicles;
}

Result<std::optional<geo::Wgs84>> place_from(Json const& object) {
  auto const lat = number_member(object, "lat_deg");
  if (!lat) return std::unexpected(lat.error());
  auto const lon = number_member(object, "lon_deg");
  if (!lon) return std::unexpected(lon.error());
  if (!*lat && !*lon) return std::nullopt;
  if (!*lat || !*lon || std::abs(**lat) > 90.0 || std::abs(**lon) > 180.0)
    return wrong("\"lat_deg\" and \"lon_deg\" must be a place on Earth.");
  return geo::Wgs84::from_degrees(**lat, **lon, 0.0);
}

/// `"allow": {"rule": "reason"}`
Result<std::map<std::string, std::string>> allowances_from(Json const& object) {
  constexpr std::size_t most = 50;
  constexpr std::size_t longest = 500;
  std::map<std::string, std::string> allow;
  auto const found = object.find("allow");
  if (found == object.end()) return allow;
  if (!found->is_object() || found->size() > most) return wrong("\"allow\" must name rules with the reasons.");
  for (auto const& [rule, reason] : found->items()) {
    bool const is_reason = reason.is_string() && reason.get_ref<std::string const&>().size() <= longest;
    if (!is_reason) return wrong(fmt::format("\"allow\": the reason of \"{}\" must be a text.", rule));
    allow.emplace(rule, reason.get<std::string>());
  }
  return allow;
}

Result<CommandVehicles> command_from(Json const& object) {
  auto const word = text_member(object, "action", "");
  if (!word) return std::unexpected(word.error());
  auto const action = vehicle::action_from(*word);
  if (!action) return wrong(fmt::format("There is no action \"{}\".", *word));
  auto vehicles = vehicles_from(object);
  if (!vehicles) return std::unexpected(vehicles.error());
  auto const height_m = number_member(object, "height_m");
  if (!height_m) return std::unexpected(height_m.error());
  auto const place = place_from(object);
  if (!place) return std::unexpected(place.error());
  auto mode = text_member(object, "mode", "");
  if (!mode) return std::unexpected(mode.error());
  auto const take_over = object.find("take_over");
  if (take_over != object.end() && !take_over->is_boolean()) return wrong("\"take_over\" must be true or false.");
  auto allow = allowances_from(object);
  if (!allow) return std::unexpected(allow.error());
  return CommandVehicles{
      {.action = *action, .height_m = *height_m, .place = *place, .mode = std::move(*mode), .allow = *std::move(allow)},
      *std::move(vehicles),
      take_over != object.end() && take_over->get<bool>()};
}

Result<StopAll> stop_from(Json const& object) {
  auto const word = text_member(object, "action", "");
  if (!word) return std::unexpected(word.error());
  if (word->empty()) return StopAll{};
  auto const action = vehicle::stop_action_from(*word);
  if (!action) return wrong(fmt::format("An emergency stop cannot be \"{}\".", *word));
  return StopAll{action};
}

Json to_json(vehicle::CommandRecord const& record) {
  Json vehicles = Json::array();
  for (auto const& outcome : record.outcomes) {
    Json one{{"vehicle", outcome.vehicle.text}, {"state", vehicle::to_string(outcome.state)}};
    if (!outcome.reason.empty()) one["reason"] = outcome.reason;
    if (outcome.left_m) one["left_m"] = rounded(*outcome.left_m, 1);
    vehicles.push_back(std::move(one));
  }
  Json json{{"number", record.number},
            {"action", vehicle::to_string(record.command.action)},
            {"by", record.by},
            {"asked", internal::to_text(record.asked)},
            {"vehicles", std::move(vehicles)}};
  if (record.command.height_m) json["height_m"] = *record.command.height_m;
  if (record.command.place) json["place"] = position_json(*record.command.place);
  if (!record.command.mode.empty()) json["mode"] = record.command.mode;
  if (!record.command.allow.empty()) json["allow"] = record.command.allow;
  return json;
}

}  // namespace

bool is_control_request(std::string_view type) {
  return type == "command" || type == "emergency_stop" || type == "release_emergency_stop" ||
         std::ranges::any_of(changes, [type](auto const& entry) { return entry.first == type; });
}

Result<ControlRequest> parse_control_request(std::string_view type, std::string_view text) {
  auto const object = parse_object(text);
  if (!object) return std::unexpected(object.error());
  auto by = internal::operator_member(*object);
  if (!by) return std::unexpected(by.error());
  auto const with = [&](auto result) -> Result<ControlRequest> {
    if (!result) return std::unexpected(result.error());
    return ControlRequest{*std::move(result), *std::move(by)};
  };
  if (type == "command") return with(command_from(*object));
  if (type == "emergency_stop") return with(stop_from(*object));
  if (type == "release_emergency_stop") return ControlRequest{ReleaseStop{}, *std::move(by)};
  auto const change = std::ranges::find(changes, type, &std::pair<std::string_view, What>::first);
  if (change == changes.end()) return wrong(fmt::format("There is no request of type \"{}\".", type));
  auto id = text_member(*object, "vehicle", "");
  if (!id) return std::unexpected(id.error());
  if (id->empty()) return wrong("\"vehicle\", whose command changes, is missing.");
  return ControlRequest{ChangeCommander{change->second, {*std::move(id)}}, *std::move(by)};
}

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
    if (change.what == What::request) done = control->request_control(change.vehicle, std::move(by));
    if (change.what == What::yield) done = control->yield_control(change.vehicle, std::move(by));
    if (change.what == What::keep) done = control->keep_control(change.vehicle, std::move(by));
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
  if (!emergency.by.empty()) json["since"] = internal::to_text(emergency.since);
  return dump(json);
}

}  // namespace lapwing::station
