#include "station/messages/client_request.hpp"

#include <cmath>

#include <fmt/format.h>

#include "station/messages/request_reader.hpp"

namespace lapwing::station {

using internal::RequestReader;

namespace {

StartScript start_from(RequestReader& request) {
  if (!request.find("source")) request.refuse("\"source\", the script's text, is missing.");
  auto source = request.text("source");
  return {request.text("name", StartScript{}.name), std::move(source)};
}

/// `"feeds": ["vehicles"], "run": "4f1c", "revisions": {"vehicles": 12}`
Subscribe subscribe_from(RequestReader& request) {
  constexpr std::size_t most = 100;
  constexpr std::size_t longest = 100;
  Subscribe wanted{request.texts("feeds", most, longest, "\"feeds\" must be a list of feeds' names.")};
  wanted.run = request.text("run");
  auto const* const revisions = request.find("revisions");
  if (!revisions) return wanted;
  auto const refuse = [&] { request.refuse("\"revisions\" must give a number for each feed that it names."); };
  if (!revisions->is_object() || revisions->size() > most) return refuse(), wanted;
  for (auto const& [name, revision] : revisions->items()) {
    if (!revision.is_number_unsigned()) return refuse(), wanted;
    wanted.revisions.emplace(name, revision.get<std::uint64_t>());
  }
  return wanted;
}

std::vector<vehicle::VehicleId> vehicles_from(RequestReader& request) {
  constexpr std::size_t most = 1000;
  constexpr std::size_t longest = 1000;
  constexpr auto must = "\"vehicles\" must be a list of vehicle ids.";
  std::vector<vehicle::VehicleId> vehicles;
  for (auto& id : request.texts("vehicles", most, longest, must)) vehicles.push_back({std::move(id)});
  if (vehicles.empty()) request.refuse(must);
  return vehicles;
}

std::optional<geo::Wgs84> place_from(RequestReader& request) {
  auto const lat = request.number("lat_deg");
  auto const lon = request.number("lon_deg");
  if (!lat && !lon) return std::nullopt;
  bool const is_on_earth = lat && lon && std::abs(*lat) <= 90.0 && std::abs(*lon) <= 180.0;
  if (is_on_earth) return geo::Wgs84::from_degrees(*lat, *lon, 0.0);
  request.refuse("\"lat_deg\" and \"lon_deg\" must be a place on Earth.");
  return std::nullopt;
}

/// `"allow": {"rule": "reason"}`
std::map<std::string, std::string> allowances_from(RequestReader& request) {
  constexpr std::size_t most = 50;
  constexpr std::size_t longest = 500;
  std::map<std::string, std::string> allow;
  auto const* const found = request.find("allow");
  if (!found) return allow;
  if (!found->is_object() || found->size() > most)
    return request.refuse("\"allow\" must name rules with the reasons."), allow;
  for (auto const& [rule, reason] : found->items()) {
    bool const is_reason = reason.is_string() && reason.get_ref<std::string const&>().size() <= longest;
    if (!is_reason) request.refuse(fmt::format("\"allow\": the reason of \"{}\" must be a text.", rule));
    if (is_reason) allow.emplace(rule, reason.get<std::string>());
  }
  return allow;
}

CommandVehicles command_from(RequestReader& request) {
  auto const word = request.text("action");
  auto const action = vehicle::action_from(word);
  if (!action) request.refuse(fmt::format("There is no action \"{}\".", word));
  auto vehicles = vehicles_from(request);
  vehicle::VehicleCommand command{.action = action.value_or(vehicle::Action::hold),
                                  .height_m = request.number("height_m"),
                                  .place = place_from(request),
                                  .mode = request.text("mode"),
                                  .allow = allowances_from(request)};
  return {std::move(command), std::move(vehicles), request.flag("take_over")};
}

StopAll stop_from(RequestReader& request) {
  auto const word = request.text("action");
  if (word.empty()) return {};
  auto const action = vehicle::stop_action_from(word);
  if (!action) request.refuse(fmt::format("An emergency stop cannot be \"{}\".", word));
  return {action};
}

ChangeCommander change_from(RequestReader& request, ChangeCommander::What what) {
  auto id = request.text("vehicle");
  if (id.empty()) request.refuse("\"vehicle\", whose command changes, is missing.");
  return {what, {std::move(id)}};
}

AcknowledgeAlarms acknowledge_from(RequestReader& request) {
  constexpr std::size_t most = 10'000;
  constexpr auto must = "\"numbers\" must be a list of alarms' numbers.";
  auto by = request.operator_name();
  auto numbers = request.naturals("numbers", most, must);
  if (numbers.empty()) request.refuse(must);
  return {std::move(numbers), std::move(by)};
}

ClientRequest::What what_from(std::string_view type, RequestReader& request) {
  using Change = ChangeCommander::What;
  auto const control = [&](auto read) {
    auto by = request.operator_name();
    return ControlRequest{read(), std::move(by)};
  };
  if (type == "ping") return Ping{};
  if (type == "start_script") return start_from(request);
  if (type == "stop_script") return StopScript{};
  if (type == "subscribe") return subscribe_from(request);
  if (type == "acknowledge_alarms") return acknowledge_from(request);
  if (type == "command") return control([&] { return command_from(request); });
  if (type == "emergency_stop") return control([&] { return stop_from(request); });
  if (type == "release_emergency_stop") return control([] { return ReleaseStop{}; });
  if (type == "request_control") return control([&] { return change_from(request, Change::request); });
  if (type == "yield_control") return control([&] { return change_from(request, Change::yield); });
  if (type == "keep_control") return control([&] { return change_from(request, Change::keep); });
  request.refuse(fmt::format("There is no request of type \"{}\".", type));
  return Ping{};
}

}  // namespace

base::Result<ClientRequest> parse_client_request(std::string_view text) {
  RequestReader request(text);
  auto id = request.text("id");
  auto what = what_from(request.text("type"), request);
  return request.result(ClientRequest{std::move(id), std::move(what)});
}

base::Result<ClientRequest::What> parse_request_body(std::string_view type, std::string_view body) {
  RequestReader request(body);
  return request.result(what_from(type, request));
}

}  // namespace lapwing::station
