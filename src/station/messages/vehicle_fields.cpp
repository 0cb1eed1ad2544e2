#include "station/messages/vehicle_fields.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace lapwing::station::internal {
namespace {

using vehicle::VehicleState;

template <class T, class ToJson>
void add(Fields& fields, char const* key, vehicle::Aged<T> const& aged, ToJson to_json) {
  if (aged.known()) fields[key] = {to_json(*aged.value), aged.heard};
}

template <class T>
void add(Fields& fields, char const* key, vehicle::Aged<T> const& aged) {
  add(fields, key, aged, [](T const& value) { return Json(value); });
}

Json to_json(geo::Ned const& v) {
  return {{"north", rounded(v.north, 2)}, {"east", rounded(v.east, 2)}, {"down", rounded(v.down, 2)}};
}

Json to_json(vehicle::Attitude const& a) {
  return {{"roll", rounded(a.roll_rad, 3)}, {"pitch", rounded(a.pitch_rad, 3)}, {"yaw", rounded(a.yaw_rad, 3)}};
}

/// In steps of 10 s: it is no more exact than that, and every change is sent.
Json rounded_time(base::Duration time) {
  return 10.0 * std::round(base::to_seconds(time) / 10.0);
}

Json to_json(vehicle::Battery const& battery) {
  Json json{{"remaining", rounded(battery.remaining, 3)}};
  if (battery.voltage_v) json["voltage_v"] = rounded(*battery.voltage_v, 2);
  if (battery.current_a) json["current_a"] = rounded(*battery.current_a, 2);
  if (battery.consumed_ah) json["consumed_ah"] = rounded(*battery.consumed_ah, 3);
  if (battery.time_left) json["time_left_s"] = rounded_time(*battery.time_left);
  if (battery.time_left_is_estimate) json["time_left_is_estimate"] = true;
  if (battery.time_left_is_estimate) json["time_left_error_s"] = rounded_time(battery.time_left_error);
  if (battery.in_flight) json["in_flight_s"] = rounded_time(battery.in_flight->time);
  if (battery.in_flight) json["in_flight_error_s"] = rounded_time(battery.in_flight->error);
  return json;
}

Json to_json(vehicle::Gps const& gps) {
  Json json{{"fix", vehicle::gps_fix_name(gps.fix)}};
  if (gps.satellites) json["satellites"] = *gps.satellites;
  if (gps.hdop) json["hdop"] = rounded(*gps.hdop, 2);
  return json;
}

/// A key for what is known.
void put(Json& json, char const* key, std::optional<double> value, int decimals) {
  if (value) json[key] = rounded(*value, decimals);
}

Json to_json(vehicle::Estimator const& e) {
  Json json = Json::object();
  put(json, "velocity", e.velocity, 2);
  put(json, "position_horizontal", e.position_horizontal, 2);
  put(json, "position_vertical", e.position_vertical, 2);
  put(json, "compass", e.compass, 2);
  return json;
}

Json to_json(vehicle::RemoteControl const& remote) {
  Json json{{"lost", remote.is_lost}, {"channels", remote.channels}};
  if (remote.rssi) json["rssi"] = rounded(*remote.rssi, 2);
  auto const shown = std::min<std::size_t>(remote.pulses_us.size(), static_cast<std::size_t>(remote.channels));
  json["pulses_us"] = Json::array();
  for (auto const& pulse : std::span(remote.pulses_us).first(shown))
    json["pulses_us"].push_back(pulse ? Json(*pulse) : Json());
  return json;
}

Json to_json(vehicle::Radio const& radio) {
  Json json{{"receive_errors", radio.receive_errors}};
  put(json, "buffer_free", radio.transmit_buffer_free, 2);
  if (radio.noise) json["noise"] = *radio.noise;
  if (radio.remote_noise) json["remote_noise"] = *radio.remote_noise;
  if (radio.rssi) json["rssi"] = *radio.rssi;
  if (radio.remote_rssi) json["remote_rssi"] = *radio.remote_rssi;
  return json;
}

Json to_json(vehicle::Hud const& hud) {
  Json json = Json::object();
  put(json, "airspeed_m_s", hud.airspeed_m_s, 1);
  put(json, "climb_m_s", hud.climb_m_s, 1);
  put(json, "throttle", hud.throttle, 2);
  return json;
}

Json to_json(vehicle::Wind const& wind) {
  return {{"from_rad", rounded(wind.from_rad, 2)}, {"speed_m_s", rounded(wind.speed_m_s, 1)}};
}

Json to_json(vehicle::Fence const& fence) {
  Json json{{"breached", fence.is_breached}, {"breaches", fence.breaches}};
  if (!fence.type.empty()) json["type"] = fence.type;
  return json;
}

Json to_json(vehicle::MissionProgress const& mission) {
  Json json{{"current", mission.current_seq}, {"total", mission.total}, {"complete", mission.complete}};
  if (!mission.state.empty()) json["state"] = mission.state;
  return json;
}

Json to_json(vehicle::Gimbal const& gimbal) {
  return {{"roll_rad", rounded(gimbal.roll_rad, 3)},
          {"pitch_rad", rounded(gimbal.pitch_rad, 3)},
          {"yaw_rad", rounded(gimbal.yaw_rad, 3)},
          {"yaw_is_from_north", gimbal.yaw_is_from_north}};
}

Json to_json(vehicle::Pictures const& pictures) {
  return {{"taken", pictures.taken}, {"lost", pictures.lost}};
}

/// Rounded so that what hardly changes is not sent again and again. What is lost of nothing is not known.
Json links_json(std::vector<vehicle::LinkQuality> const& links, bool is_heard) {
  Json list = Json::array();
  for (auto const& link : links) {
    Json json{{"name", link.name},
              {"messages_per_s", rounded(link.messages_per_s, 0)},
              {"bytes_per_s", rounded(link.bytes_per_s, -1)},
              {"alive", link.is_alive},
              {"used", link.is_used}};
    if (is_heard && link.is_alive) json["loss"] = rounded(link.loss, 2);
    if (link.round_trip) json["round_trip_s"] = rounded(base::to_seconds(*link.round_trip), 2);
    list.push_back(std::move(json));
  }
  return list;
}

void add_texts(Fields& fields, char const* key, std::vector<vehicle::StatusText> const& texts) {
  if (texts.empty()) return;
  Json list = Json::array();
  for (auto const& text : texts) {
    list.push_back({{"severity", text.severity}, {"text", text.text}});
    if (text.component != 1) list.back()["component"] = text.component;
  }
  fields[key] = {std::move(list), texts.back().heard};
}

/// An empty list, too, when there was one before: a reason that is gone must go.
void add_arming_reasons(Fields& fields, VehicleState const& state) {
  Json list = Json::array();
  for (auto const& reason : state.arming_reasons) list.push_back(reason.text);
  fields["arming_reasons"] = {std::move(list), {}};
  if (!state.arming_reasons.empty()) fields["arming_reasons"].heard = state.arming_reasons.back().heard;
}

/// As old as the oldest of them.
void add_further_batteries(Fields& fields, VehicleState const& state) {
  if (state.further_batteries.empty()) return;
  Json list = Json::array();
  auto heard = base::TimePoint::max();
  for (auto const& battery : state.further_batteries) {
    list.push_back(to_json(*battery.value));
    list.back()["id"] = battery.value->id;
    heard = std::min(heard, battery.heard);
  }
  fields["further_batteries"] = {std::move(list), heard};
}

/// The list itself has no age; each component has, under a key of its own.
void add_components(Fields& fields, VehicleState const& state) {
  if (state.components.empty()) return;
  Json list = Json::array();
  for (auto const& component : state.components) {
    Json json{{"id", component.id}, {"kind", component.kind}};
    if (!component.state.empty()) json["state"] = component.state;
    if (!component.model.empty()) json["model"] = component.model;
    fields[fmt::format("component_{}", component.id)] = {true, component.heard};
    list.push_back(std::move(json));
  }
  fields["components"] = {std::move(list), {}};
}

/// The same clock as the message's `time_s`.
void add_control(Fields& fields, vehicle::ControlState const& control) {
  Json json{{"commander", control.commander}};
  if (!control.asked_for_by.empty()) {
    json["asked_for_by"] = control.asked_for_by;
    json["granted_at_s"] = rounded(base::to_seconds(control.granted_at.time_since_epoch()), 3);
  }
  fields["control"] = {std::move(json), {}};
}

void add_identity(Fields& fields, VehicleState const& state) {
  fields["system_id"] = {state.system_id, {}};
  fields["name"] = {state.name, {}};
  fields["family"] = {vehicle::to_string(state.family), {}};
  fields["autopilot"] = {vehicle::to_string(state.autopilot), {}};
  fields["connection"] = {vehicle::to_string(state.connection), {}};
  fields["link"] = {state.link, {}};
  bool const is_heard = !state.is_silent && state.connection != vehicle::Connection::lost;
  if (!state.links.empty()) fields["links"] = {links_json(state.links, is_heard), {}};
  fields["payload"] = {state.payload, {}};
  fields["track_m"] = {rounded(state.track_m, 1), {}};
  fields["heartbeat"] = {true, state.heartbeat_heard};
  // Its age is that of the silence. Only then: it would be news with every message.
  fields["silent"] = {state.is_silent, state.is_silent ? std::optional(state.heard) : std::nullopt};
}

}  // namespace

Fields fields_of(VehicleState const& state) {
  Fields fields;
  add_identity(fields, state);
  auto const place = [](geo::Wgs84 const& p) { return position_json(p); };
  auto const json = [](auto const& value) { return to_json(value); };
  add(fields, "mode", state.mode);
  add(fields, "armed", state.armed);
  add(fields, "landed", state.landed);
  add(fields, "position", state.position, place);
  add(fields, "relative_alt_m", state.relative_alt_m, [](double m) { return Json(rounded(m, 2)); });
  add(fields, "velocity_m_s", state.velocity_m_s, json);
  add(fields, "attitude_rad", state.attitude, json);
  add(fields, "heading_rad", state.heading_rad, [](double rad) { return Json(rounded(rad, 3)); });
  add(fields, "battery", state.battery, json);
  add_further_batteries(fields, state);
  add(fields, "gps", state.gps, json);
  add(fields, "estimator", state.estimator, json);
  add(fields, "unhealthy", state.unhealthy);
  add_arming_reasons(fields, state);
  add(fields, "remote_control", state.remote_control, json);
  add(fields, "radio", state.radio, json);
  add(fields, "hud", state.hud, json);
  add(fields, "wind", state.wind, json);
  add(fields, "fence", state.fence, json);
  add(fields, "health", state.health,
      [](vehicle::Health const& h) { return Json{{"position_ok", h.position_ok}, {"prearm_ok", h.prearm_ok}}; });
  add(fields, "home", state.home, place);
  add(fields, "mission", state.mission, json);
  add(fields, "waypoint_distance_m", state.waypoint_distance_m, [](double m) { return Json(rounded(m, 0)); });
  add(fields, "gimbal", state.gimbal, json);
  add_components(fields, state);
  add(fields, "pictures", state.pictures, json);
  add_texts(fields, "texts", state.recent_texts);
  add_control(fields, state.control);
  add(fields, "foreign_change", state.foreign_change);
  return fields;
}

}  // namespace lapwing::station::internal
