#include "fleet/network/other_stations.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fleet/actions/vehicle_actions.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using mavlink::Address;
using mavlink::MavCmd;

namespace {

constexpr base::Duration asked_recently = 15s;  // a mode that was commanded may take that long to show
constexpr base::Duration station_is_here = 10s;
constexpr base::Duration same_again = 10s;
constexpr std::size_t most_told = 16;  // of what counts as the same again

std::string name_of(Address station) {
  return fmt::format("station {}/{}", station.system, station.component);
}

/// Commands that change nothing about a vehicle but what it sends.
bool only_asks(MavCmd command) {
  constexpr std::array asking{
      MavCmd::set_message_interval,     MavCmd::get_message_interval,           MavCmd::request_message,
      MavCmd::request_protocol_version, MavCmd::request_autopilot_capabilities, MavCmd::get_home_position};
  return std::ranges::find(asking, command) != asking.end();
}

std::string_view plan_word(mavlink::MissionType type) {
  switch (type) {
    case mavlink::MissionType::fence: return "fence";
    case mavlink::MissionType::rally: return "rally points";
    default: return "mission";
  }
}

/// What follows by itself: the mode after a mission, or after a take-off (PX4). A copter stays in AUTO to the end.
bool is_its_own_sequel(MavlinkVehicle const& craft, std::uint32_t before) {
  if (mode_name(craft, before) == "AUTO.TAKEOFF") return true;
  auto const& mission = craft.state.mission.progress.value;
  if (!mission || before != mavlink::mode_for(craft.state.autopilot, craft.state.family, mavlink::ModeRole::mission))
    return false;
  bool const is_at_last_item = mission->current_seq + 1 >= mission->total;
  return mission->complete || (is_at_last_item && craft.state.family != vehicle::Family::copter);
}

}  // namespace

OtherStations::OtherStations(Fleet& fleet, base::Logger log)
    : fleet_(fleet),
      log_(std::move(log)),
      subscription_(
          fleet.subscribe([this](Network& network, mavlink::Received const& received) { take(network, received); })) {}

void OtherStations::take(Network& network, mavlink::Received const& received) {
  if (auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message))
    return take_heartbeat(network, received, *heartbeat);
  if (auto const* command = std::get_if<mavlink::CommandLong>(&received.message))
    return note_command(network, received.source, command->target, command->command, "");
  if (auto const* command = std::get_if<mavlink::CommandInt>(&received.message))
    return note_command(network, received.source, command->target, command->command, "");
  take_answer(network, received);
}

void OtherStations::take_heartbeat(Network& network, mavlink::Received const& received,
                                   mavlink::Heartbeat const& heartbeat) {
  if (heartbeat.type == mavlink::MavType::gcs) {
    bool const is_new = !stations_.contains(received.source);
    stations_[received.source] = received.at;
    if (is_new) log_.info(fmt::format("another ground station is on the link: {}", name_of(received.source)));
    if (is_new && received.source == network.connection().self())
      log_.warn(
          "that is this station's id, too: what vehicles answer to one, both take for theirs; give the other "
          "one another id (QGroundControl: Application Settings, Telemetry, Ground Station)");
    return;
  }
  if (received.source.component != mavlink::autopilot_component) return;
  auto* const craft = network.find(received.source.system);
  if (!craft) return;
  auto const [entry, is_first] = modes_.try_emplace(craft->id(), heartbeat.custom_mode);
  auto const before = std::exchange(entry->second, heartbeat.custom_mode);
  if (!is_first && before != heartbeat.custom_mode) note_mode(*craft, before);
}

/// What a vehicle answers to somebody else.
void OtherStations::take_answer(Network& network, mavlink::Received const& received) {
  auto const target = mavlink::target_of(received.message);
  if (!target || target->system == 0 || mavlink::addresses(*target, network.connection().self())) return;
  if (auto const* ack = std::get_if<mavlink::CommandAck>(&received.message)) {
    if (ack->result == mavlink::MavResult::in_progress) return;
    return note_command(network, *target, received.source, ack->command, mavlink::to_string(ack->result));
  }
  auto const* ack = std::get_if<mavlink::MissionAck>(&received.message);
  auto* const craft = network.find(received.source.system);
  if (!ack || !craft || ack->result != mavlink::MavMissionResult::accepted) return;
  tell(*craft, fmt::format("{} changed or read its {}", name_of(*target), plan_word(ack->type)));
}

void OtherStations::note_command(Network& network, Address by, Address target, MavCmd command,
                                 std::string_view outcome) {
  auto* const craft = network.find(target.system);
  if (!craft || only_asks(command)) return;
  tell(*craft,
       fmt::format("{} commanded {}{}{}", name_of(by), to_string(command), outcome.empty() ? "" : ": ", outcome));
}

/// A mode that this station did not ask for: a failsafe, the end of a mission, a pilot's switch, another station.
void OtherStations::note_mode(MavlinkVehicle& craft, std::uint32_t before) {
  auto const now = fleet_.loop().now();
  bool const is_ours =
      craft.asked->mode == std::as_const(modes_).at(craft.id()) && now - craft.asked->mode_asked <= asked_recently;
  bool const has_just_booted = mode_name(craft, before) == "INITIALISING";
  craft.state.foreign_mode.value.reset();
  fleet_.registry().touch(craft.id());
  if (is_ours || has_just_booted) return;
  if (!is_its_own_sequel(craft, before))
    craft.state.foreign_mode.set(
        fmt::format("{} to {}", mode_name(craft, before), mode_name(craft, modes_.at(craft.id()))), now);
  tell(craft, fmt::format("{} to {}, not asked for here{}", mode_name(craft, before),
                          mode_name(craft, modes_.at(craft.id())), suspects()));
}

std::string OtherStations::suspects() const {
  std::vector<std::string> here;
  for (auto const& [station, heard] : stations_)
    if (fleet_.loop().now() - heard <= station_is_here) here.push_back(name_of(station));
  return here.empty() ? "" : fmt::format("; {} is on the link", fmt::join(here, ", "));
}

void OtherStations::tell(MavlinkVehicle& craft, std::string what) {
  auto const now = fleet_.loop().now();
  auto& lately = told_[craft.id()];
  std::erase_if(lately, [now](Told const& told) { return now - told.at >= same_again; });
  if (std::ranges::find(lately, what, &Told::what) != lately.end()) return;
  if (lately.size() == most_told) lately.pop_front();
  lately.push_back({what, now});
  log_.info(fmt::format("{}: {}", craft.state.name, what));
  craft.state.foreign_change.set(std::move(what), now);
  fleet_.registry().touch(craft.id());
}

}  // namespace lapwing::fleet
