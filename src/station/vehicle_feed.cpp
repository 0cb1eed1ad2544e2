#include "station/vehicle_feed.hpp"

#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "station/json.hpp"

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

Json to_json(vehicle::Battery const& battery) {
  Json json{{"remaining", rounded(battery.remaining, 3)}};
  if (battery.voltage_v) json["voltage_v"] = rounded(*battery.voltage_v, 2);
  if (battery.current_a) json["current_a"] = rounded(*battery.current_a, 2);
  return json;
}

void add_texts(Fields& fields, std::vector<vehicle::StatusText> const& texts) {
  if (texts.empty()) return;
  Json list = Json::array();
  for (auto const& text : texts) list.push_back({{"severity", text.severity}, {"text", text.text}});
  fields["texts"] = {std::move(list), texts.back().heard};
}

void add_identity(Fields& fields, VehicleState const& state) {
  fields["system_id"] = {state.system_id, {}};
  fields["name"] = {state.name, {}};
  fields["family"] = {vehicle::to_string(state.family), {}};
  fields["autopilot"] = {vehicle::to_string(state.autopilot), {}};
  fields["connection"] = {vehicle::to_string(state.connection), {}};
  fields["link"] = {state.link, {}};
  fields["payload"] = {state.payload, {}};
  fields["track_m"] = {rounded(state.track_m, 1), {}};
  fields["heartbeat"] = {true, state.heartbeat_heard};  // its age is the link's age
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
  add(fields, "health", state.health,
      [](vehicle::Health const& h) { return Json{{"position_ok", h.position_ok}, {"prearm_ok", h.prearm_ok}}; });
  add(fields, "home", state.home, place);
  add(fields, "mission", state.mission, [](vehicle::MissionProgress const& m) {
    return Json{{"current", m.current_seq}, {"total", m.total}, {"complete", m.complete}};
  });
  add_texts(fields, state.recent_texts);
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

}  // namespace

struct VehicleFeed::Sent {
  struct Vehicle {
    unsigned long long revision = 0;
    Fields fields;
    std::vector<geo::Wgs84> plan;
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
  for (auto const* state : registry_.all()) messages.push_back(plan_text(*state));
  return messages;
}

std::vector<std::string> VehicleFeed::news(base::TimePoint now) {
  Json vehicles = Json::array();
  std::vector<std::string> plans;
  for (auto const* state : registry_.all()) {
    auto& before = sent_->vehicles[state->id];
    auto const revision = registry_.revision(state->id);
    if (revision == before.revision) continue;
    before.revision = revision;
    auto fields = fields_of(*state);
    auto object = changes(state->id.text, fields, before.fields, now);
    before.fields = std::move(fields);
    if (object.size() > 1) vehicles.push_back(std::move(object));
    if (before.plan == state->planned_path) continue;
    before.plan = state->planned_path;
    plans.push_back(plan_text(*state));
  }
  std::vector<std::string> messages;
  if (!vehicles.empty()) messages.push_back(vehicles_text(std::move(vehicles), false, now));
  messages.insert(messages.end(), std::make_move_iterator(plans.begin()), std::make_move_iterator(plans.end()));
  return messages;
}

}  // namespace lapwing::station
