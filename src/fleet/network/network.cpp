#include "fleet/network/network.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "fleet/actions/vehicle_actions.hpp"
#include "fleet/network/vehicle_kind.hpp"
#include "fleet/state/arming_reasons.hpp"
#include "fleet/state/payload.hpp"
#include "fleet/state/telemetry.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Duration;
using base::TimePoint;
using vehicle::Connection;
using vehicle::VehicleId;

namespace {

constexpr std::string_view camera = "Camera";  // the language's name for it (specification, REC-44)
constexpr Duration watch_period = 250ms;
constexpr Duration heartbeat_period = 1s;
constexpr unsigned links_noted_every = 4;  // turns of the watch
// Telemetry may arrive out of order; a clock that goes back further than that began anew.
constexpr Duration clock_slack = 3s;
// The other of two links may be a slow radio with a full queue.
constexpr Duration clock_slack_between_links = 10s;

std::string vehicle_name(vehicle::Family family, std::uint8_t system_id) {
  if (family == vehicle::Family::unknown) return fmt::format("vehicle {}", system_id);
  return fmt::format("{} {}", vehicle::to_string(family), system_id);
}

void set_kind(MavlinkVehicle& craft, Heard& heard, VehicleKind const& kind, mavlink::MavAutopilot autopilot) {
  craft.state.family = kind.family;
  craft.state.autopilot = kind.autopilot;
  heard.type = kind.type;
  heard.mav_autopilot = autopilot;
}

/// It speaks from a new place on the same link, and that is not known to be another way to the same vehicle.
bool has_moved(mavlink::Connection const& connection, MavlinkVehicle const& craft, mavlink::Received const& received) {
  return received.from != craft.heard->from && received.from.link == craft.heard->from.link &&
         !connection.are_one(received.source.system, received.from, craft.heard->from);
}

/// An autopilot on the same link that speaks from a new place and has lost its arming or mode has restarted. (That its
/// clock began anew shows only once telemetry flows again.)
bool heartbeat_tells_restart(MavlinkVehicle const& craft, bool has_moved, mavlink::Heartbeat const& heartbeat) {
  auto const status = heartbeat.system_status;
  if (status == mavlink::MavState::uninit || status == mavlink::MavState::boot)
    return craft.heard->is_armed;  // nobody boots armed
  return has_moved &&
         ((craft.heard->is_armed && !heartbeat.armed()) || craft.heard->custom_mode != heartbeat.custom_mode);
}

/// Over a thin or bad link there is little more than a heartbeat a second; that some of those get lost is no silence.
bool speaks_rarely(vehicle::VehicleState const& state) {
  constexpr double few = 4.0;
  double messages_per_s = 0.0;
  for (auto const& link : state.links.all) messages_per_s += link.messages_per_s;
  return messages_per_s < few;
}

void write(base::Logger const& log, std::string const& name, vehicle::StatusText const& text) {
  auto line = fmt::format("{}: {}", name, text.text);
  constexpr int error = 3;
  constexpr int notice = 5;
  if (text.severity <= error) return log.error(std::move(line));
  if (text.severity < notice) return log.warn(std::move(line));
  log.info(std::move(line));
}

}  // namespace

Network::Network(mavlink::Connection& connection, vehicle::Registry& registry, Options options, base::Logger log)
    : connection_(connection),
      registry_(registry),
      options_(std::move(options)),
      log_(std::move(log)),
      subscription_(connection.subscribe([this](mavlink::Received const& received) { take(received); })),
      scope_(connection.loop()) {
  scope_.spawn(watch());
}

std::string Network::in_network(std::string text) const {
  return options_.name.empty() ? text : fmt::format("{}/{}", options_.name, text);
}

MavlinkVehicle* Network::find(std::uint8_t system_id) const {
  auto const found = crafts_.find(system_id);
  return found == crafts_.end() ? nullptr : found->second.get();
}

MavlinkVehicle* Network::find(VehicleId const& id) const {
  auto const found = std::ranges::find_if(crafts_, [&](auto const& entry) { return entry.second->id() == id; });
  return found == crafts_.end() ? nullptr : found->second.get();
}

std::vector<MavlinkVehicle*> Network::all() const {
  std::vector<MavlinkVehicle*> crafts;
  for (auto const& [system_id, craft] : crafts_) crafts.push_back(craft.get());
  return crafts;
}

void Network::take(mavlink::Received const& received) {
  if (auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message)) take_heartbeat(received, *heartbeat);
  if (auto const* radio = std::get_if<mavlink::RadioStatus>(&received.message)) take_radio_of_link(received, *radio);
  auto const found = crafts_.find(received.source.system);
  if (found == crafts_.end()) return;
  if (received.source.component == mavlink::autopilot_component) {
    note_heard(*found->second, received.at);
    return take_from_autopilot(*found->second, received);
  }
  take_from_component(*found->second, received);
}

/// A radio speaks for itself, under a system id of its own: what it says concerns every vehicle behind it.
void Network::take_radio_of_link(mavlink::Received const& received, mavlink::RadioStatus const& radio) {
  for (auto& [system_id, craft] : crafts_) {
    if (craft->heard->from != received.from) continue;
    take_radio(*craft, radio, received.at);
    registry_.touch(craft->id());
  }
}

void Network::take_from_component(MavlinkVehicle& craft, mavlink::Received const& received) {
  auto const component = received.source.component;
  if (auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message))
    take_component_heartbeat(craft, received.source, *heartbeat, received.at);
  if (auto const* chunk = std::get_if<mavlink::StatusText>(&received.message))
    tell(craft, take_text(craft, component, *chunk, received.at));
  if (auto const id = id_of(received.message); id && craft.asked->rates) asked_of(craft).rates->arrived(*id);
  (void)take_payload(craft, component, received.message, received.at);
  registry_.touch(craft.id());
  craft.changed.notify_all();
}

void Network::tell(MavlinkVehicle const& craft, std::vector<vehicle::StatusText> const& texts) {
  for (auto const& text : texts) write(log_, craft.state.name, text);
}

/// What nothing but time changes: texts whose end was lost, reasons that were not repeated.
void Network::let_age(MavlinkVehicle& craft) {
  auto const now = loop().now();
  auto const texts = take_overdue_texts(craft, now);
  tell(craft, texts);
  bool const forgot = forget_old_arming_reasons(craft.state.arming.reasons, now);
  if (forgot || !texts.empty()) registry_.touch(craft.id());
}

void Network::take_heartbeat(mavlink::Received const& received, mavlink::Heartbeat const& heartbeat) {
  if (heartbeat.type == mavlink::MavType::gcs && received.source != connection_.self())
    other_ground_heard_[received.from] = received.at;
  if (is_camera(received.source, heartbeat)) note_camera(received.source.system);
  auto const kind = kind_of(received.source, heartbeat);
  if (!kind) return;
  auto const found = crafts_.find(received.source.system);
  bool const is_new = found == crafts_.end();
  auto& craft = is_new ? discover(received) : *found->second;
  auto& heard = heard_of(craft);
  auto& asked = asked_of(craft);
  set_kind(craft, heard, *kind, heartbeat.autopilot);
  craft.state.name = in_network(vehicle_name(kind->family, craft.address.system));
  bool const is_restarted = heartbeat_tells_restart(craft, has_moved(connection_, craft, received), heartbeat);
  if (!is_new && is_restarted) note_restart(craft, received.at);
  // A vehicle sends each link what was asked for over that link.
  if (!is_new && received.from != heard.from && asked.rates) asked.rates->restart(received.at);

  heard.from = received.from;
  if (heard.custom_mode != heartbeat.custom_mode) heard.mode_changed = received.at;
  heard.custom_mode = heartbeat.custom_mode;
  if (heard.is_armed != heartbeat.armed()) heard.armed_changed = received.at;
  heard.is_armed = heartbeat.armed();
  if (in_mission_mode(craft)) asked.mission_mode_pending = false;
  auto& state = craft.state;
  state.links.heartbeat_heard = received.at;
  state.arming.is_in_trouble =
      heartbeat.system_status == mavlink::MavState::critical || heartbeat.system_status == mavlink::MavState::emergency;
  state.mode.set(name_of_mode(craft, heartbeat.type, heartbeat.custom_mode), received.at);
  for (auto& component : state.payload.components)
    if (component.id == received.source.component) component.heard = received.at;  // it speaks for what is wired to it
  state.arming.armed.set(heartbeat.armed(), received.at);
  if (heartbeat.armed()) state.arming.reasons.clear();
  state.links.used = connection_.whereabouts(received.source.system).value_or("");
  if (is_new) {
    // Whatever is streamed or asked for regularly takes seconds; people look for the vehicle on the map now.
    ask(craft, {mavlink::MessageId::global_position_int, craft.address.component});
    ask_for_payload(craft);
    log_.info(fmt::format("{} found at {}", state.name, state.links.used));
    registry_.touch_membership(craft.id());
  }
  check_connection(craft);
}

MavlinkVehicle& Network::discover(mavlink::Received const& received) {
  auto const system_id = received.source.system;
  mavlink::SystemName const name{options_.name, system_id};
  auto& state = registry_.edit(VehicleId{to_string(name)});
  state.system_id = system_id;
  auto made = std::make_unique<MavlinkVehicle>(connection_, state, name.network, received.source);
  auto& craft = *crafts_.emplace(system_id, std::move(made)).first->second;
  craft.connection_timeout = options_.connection_timeout;
  heard_of(craft).from = received.from;
  if (auto const names = options_.payload.find(name); names != options_.payload.end())
    state.payload.names = names->second;
  if (cameras_.contains(system_id)) note_camera(system_id);
  return craft;
}

void Network::note_camera(std::uint8_t system_id) {
  cameras_.insert(system_id);
  auto const found = crafts_.find(system_id);
  if (found == crafts_.end()) return;
  auto& payload = found->second->state.payload.names;
  if (std::ranges::find(payload, camera) == payload.end()) payload.emplace_back(camera);
}

void Network::note_restart(MavlinkVehicle& craft, TimePoint now) {
  auto& heard = heard_of(craft);
  auto& asked = asked_of(craft);
  ++heard.boots;
  heard.current_from = now;
  heard.since_boot.reset();
  heard.fix.reset();
  heard.trace = {};
  heard.prearm_ok.reset();
  heard.pictures.restart();
  heard.fence.forget();
  heard.modes.clear();
  asked.mission_mode_pending = false;
  asked.has_asked_for_modes = false;
  asked.questions.clear();
  craft.state.arming.health.value.reset();
  craft.state.arming.reasons.clear();
  ask_for_payload(craft);
  if (asked.rates) asked.rates->restart(now);
  log_.warn(fmt::format("{} restarted", craft.state.name));
}

void Network::take_from_autopilot(MavlinkVehicle& craft, mavlink::Received const& received) {
  auto& heard = heard_of(craft);
  if (auto const clock = boot_time(received.message)) {
    // Two vehicles under one id have two clocks.
    bool const is_one = craft.state.links.connection != Connection::conflict;
    auto const slack = received.from == heard.clock_from ? clock_slack : clock_slack_between_links;
    if (is_one && heard.since_boot && *clock + slack < *heard.since_boot) note_restart(craft, received.at);
    heard.since_boot = clock;
    heard.clock_from = received.from;
  }
  if (auto const id = id_of(received.message); id && craft.asked->rates) asked_of(craft).rates->arrived(*id);
  if (auto const* chunk = std::get_if<mavlink::StatusText>(&received.message))
    tell(craft, take_text(craft, received.source.component, *chunk, received.at));
  if (auto const* version = std::get_if<mavlink::AutopilotVersion>(&received.message))
    heard.capabilities = version->capabilities;
  // Whoever has sent it: the vehicle has taken a whole plan, or was cleared.
  if (auto const* ack = std::get_if<mavlink::MissionAck>(&received.message);
      ack && ack->result == mavlink::MavMissionResult::accepted && ack->type == mavlink::MissionType::mission)
    ++heard.plans_taken;
  heard.fence.note(received.message, craft.state.autopilot, received.at);
  if (!take_telemetry(craft, received.message, received.at))
    (void)take_payload(craft, received.source.component, received.message, received.at);
  registry_.touch(craft.id());
  craft.changed.notify_all();
}

/// Lost, back, in conflict: looked at with every heartbeat and, for silence, now and then.
void Network::check_connection(MavlinkVehicle& craft) {
  auto const conflict = connection_.conflict(craft.address.system);
  auto const silence = loop().now() - craft.state.links.heartbeat_heard;
  auto const now = conflict                             ? Connection::conflict
                   : silence > craft.connection_timeout ? Connection::lost
                                                        : Connection::ok;
  auto const before = std::exchange(craft.state.links.connection, now);
  if (now == before) return;
  craft.state.links.conflict =
      conflict ? fmt::format(
                     "two vehicles use system id {}: {} and {}; give one of them another id, until then neither is "
                     "commanded",
                     craft.address.system, conflict->first, conflict->second)
               : "";
  if (before == Connection::conflict) heard_of(craft).current_from = loop().now();
  registry_.touch_membership(craft.id());
  craft.changed.notify_all();
}

void Network::note_heard(MavlinkVehicle& craft, TimePoint at) {
  craft.state.links.heard = at;
  if (!std::exchange(craft.state.links.is_silent, false)) return;
  heard_of(craft).current_from = at;
  registry_.touch_membership(craft.id());
}

/// Any message counts, and several kinds come each second: one that is silent by this has said nothing at all. Of two
/// vehicles with one id nobody can tell which is.
void Network::check_silence(MavlinkVehicle& craft) {
  auto const silence = loop().now() - craft.state.links.heard;
  auto const limit = speaks_rarely(craft.state) ? options_.silence + heartbeat_period : options_.silence;
  if (craft.state.links.is_silent || silence <= limit || craft.state.links.connection == Connection::conflict) return;
  craft.state.links.is_silent = true;
  registry_.touch_membership(craft.id());
}

/// How the links of each vehicle's autopilot do.
void Network::note_links() {
  std::map<std::uint8_t, std::vector<vehicle::LinkQuality>> links;
  for (auto const& link : connection_.report())
    for (auto const& source : link.sources)
      if (source.source.component == mavlink::autopilot_component && crafts_.contains(source.source.system))
        links[source.source.system].push_back({.name = fmt::format("{} from {}", link.name, source.address),
                                               .loss = source.loss,
                                               .messages_per_s = source.messages_per_s,
                                               .bytes_per_s = source.bytes_per_s,
                                               .round_trip = source.round_trip,
                                               .is_alive = source.is_alive,
                                               .is_used = source.is_route});
  for (auto& [system_id, craft] : crafts_) {
    if (craft->state.links.all == links[system_id]) continue;
    craft->state.links.all = std::move(links[system_id]);
    registry_.touch(craft->id());
  }
}

bool Network::may_be_asked(MavlinkVehicle const& craft) const {
  return craft.is_connected() && !connection_.is_contested(craft.address.system);
}

base::Task<> Network::watch() {
  for (unsigned turn = 0;; ++turn) {
    auto const due = loop().now() + watch_period;
    co_await loop().sleep_until(due);
    // Who was kept from listening cannot tell who was silent meanwhile: what has come waits to be read.
    bool const was_listening = loop().now() - due < options_.silence / 5;
    if (turn % links_noted_every == 0) note_links();
    for (auto& [system_id, craft] : crafts_) {
      check_connection(*craft);
      if (was_listening) check_silence(*craft);
      let_age(*craft);
      if (options_.asks_for_messages && may_be_asked(*craft)) ask_what_is_due(*craft);
    }
  }
}

void Network::ask_what_is_due(MavlinkVehicle& craft) {
  auto& asked = asked_of(craft);
  if (!asked.questions.empty() && !asked.is_questioning) scope_.spawn(ask_questions(craft));
  if (asked.is_asking || is_giving_back_) return;
  if (!asked.rates) asked.rates.emplace(wanted_messages(craft.state.autopilot), loop().now());
  spare_slow_link(craft);
  auto wanted = asked.rates->due(loop().now());
  if (!wanted.empty()) scope_.spawn(ask_for_messages(craft, std::move(wanted)));
}

}  // namespace lapwing::fleet
