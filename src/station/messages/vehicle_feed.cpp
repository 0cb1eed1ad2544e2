#include "station/messages/vehicle_feed.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "station/messages/json.hpp"

namespace lapwing::station {
namespace {

using vehicle::VehicleState;

/// One key of a vehicle's JSON object. Null as a value: never heard, not part of the message.
struct Field {
  Json value;
  std::optional<base::TimePoint> heard;  ///< nothing for what has no age
  bool operator==(Field const&) const = default;
};
using Fields = std::map<std::string, Field>;

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

/// The vehicle's object with those fields that differ from `before`; with nothing but the id when none does.
Json changes(std::string const& id, Fields const& now_known, Fields const& before, base::TimePoint now) {
  Json object{{"id", id}};
  Json ages = Json::object();
  for (auto const& [key, field] : now_known) {
    auto const old = before.find(key);
    if (old != before.end() && old->second == field) continue;
    if (old == before.end() || old->second.value != field.value) object[key] = field.value;
    if (field.heard) ages[key] = rounded(base::to_seconds(now - *field.heard), 3);
  }
  if (!ages.empty()) object["age_s"] = std::move(ages);
  return object;
}

std::string vehicles_text(Json vehicles, bool is_full, base::TimePoint now) {
  return dump({{"type", "vehicles"},
               {"time_s", rounded(base::to_seconds(now.time_since_epoch()), 3)},
               {"full", is_full},
               {"vehicles", std::move(vehicles)}});
}

std::string plan_text(VehicleState const& state) {
  Json path = Json::array();
  for (auto const& place : state.planned_path) path.push_back(position_json(place));
  return dump({{"type", "plan"}, {"vehicle", state.id.text}, {"path", std::move(path)}});
}

/// The pictures behind that number; `full` when the client is to forget those that it has.
std::string pictures_text(VehicleState const& state, int behind, bool is_full) {
  Json list = Json::array();
  for (auto const& picture : state.pictures.value->recent) {
    if (picture.number <= behind) continue;
    auto json = position_json(picture.position);
    json["number"] = picture.number;
    json["relative_alt_m"] = rounded(picture.relative_alt_m, 1);
    list.push_back(std::move(json));
  }
  return dump({{"type", "pictures"}, {"vehicle", state.id.text}, {"full", is_full}, {"pictures", std::move(list)}});
}

int newest_picture(VehicleState const& state) {
  auto const& pictures = state.pictures.value;
  return pictures && !pictures->recent.empty() ? pictures->recent.back().number : 0;
}

}  // namespace

struct VehicleFeed::Sent {
  struct Vehicle {
    unsigned long long revision = 0;
    Fields fields;
    std::vector<geo::Wgs84> plan;
    int picture = 0;  ///< the newest
  };
  std::map<vehicle::VehicleId, Vehicle> vehicles;
};

VehicleFeed::VehicleFeed(vehicle::Registry const& registry) : registry_(registry), sent_(std::make_unique<Sent>()) {}
VehicleFeed::~VehicleFeed() = default;

std::string VehicleFeed::vehicles_message(base::TimePoint now) const {
  Json vehicles = Json::array();
  for (auto const* state : registry_.all()) vehicles.push_back(changes(state->id.text, fields_of(*state), {}, now));
  return vehicles_text(std::move(vehicles), true, now);
}

std::vector<std::string> VehicleFeed::snapshot(base::TimePoint now) const {
  std::vector<std::string> messages{vehicles_message(now)};
  // A vehicle without a plan says so too: the client may hold an old one from before it lost the station.
  for (auto const* state : registry_.all()) {
    messages.push_back(plan_text(*state));
    if (newest_picture(*state) > 0) messages.push_back(pictures_text(*state, 0, true));
  }
  return messages;
}

std::vector<std::string> VehicleFeed::news(base::TimePoint now) {
  Json vehicles = Json::array();
  std::vector<std::string> others;
  for (auto const* state : registry_.all()) {
    auto& before = sent_->vehicles[state->id];
    auto const revision = registry_.revision(state->id);
    if (revision == before.revision) continue;
    before.revision = revision;
    auto fields = fields_of(*state);
    auto object = changes(state->id.text, fields, before.fields, now);
    before.fields = std::move(fields);
    if (object.size() > 1) vehicles.push_back(std::move(object));
    if (before.plan != state->planned_path) {
      before.plan = state->planned_path;
      others.push_back(plan_text(*state));
    }
    if (auto const newest = newest_picture(*state); newest > before.picture)
      others.push_back(pictures_text(*state, std::exchange(before.picture, newest), false));
  }
  std::vector<std::string> messages;
  if (!vehicles.empty()) messages.push_back(vehicles_text(std::move(vehicles), false, now));
  messages.insert(messages.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  return messages;
}

}  // namespace lapwing::station
