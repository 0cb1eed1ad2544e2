#include "fleet/control/emergency.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "fleet/actions/operator_actions.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using vehicle::Commander;
using vehicle::StopAction;
using vehicle::StopOutcome;

namespace {

constexpr base::Duration pause = 500ms;            // between two tries
constexpr base::Duration late_commands_end = 10s;  // what leaves the stop within that obeys an older command

/// What the vehicle shows in the state in which it was stopped.
struct Rest {
  std::uint32_t custom_mode;
  bool is_armed;
};

bool has_left(Rest const& rest, MavlinkVehicle const& craft) {
  if (craft.heard->is_armed && !rest.is_armed) return true;
  return craft.heard->is_armed && craft.heard->custom_mode != rest.custom_mode;
}

/// Heard from two places: perhaps two vehicles, and what the one shows says nothing of the other.
bool may_be_two(MavlinkVehicle const& craft) {
  auto const system = craft.address.system;
  return craft.connection.is_contested(system) || craft.connection.conflict(system).has_value();
}

/// Neither can be told apart from the other, so both are stopped, whatever kind of stop it is.
void hold_all(MavlinkVehicle& craft) {
  auto const send = [&craft](mavlink::Command const& command) {
    craft.connection.send_to_all(
        mavlink::CommandLong{.target = craft.address, .command = command.id, .params = command.params});
  };
  auto const hold = mavlink::mode_for(craft.state.autopilot, craft.state.family, mavlink::ModeRole::hold);
  if (hold) return send(mavlink::set_mode(craft.heard->mav_autopilot, *hold));
  auto const stops = stops_without_mode(OnStop::loiter);
  send(stops[0]);  // those that hold it; the further ones would take each other's place
  send(stops[1]);
}

std::string posture(MavlinkVehicle const& craft) {
  return fmt::format("{}, {}", mode_name(craft, craft.heard->custom_mode),
                     craft.heard->is_armed ? "armed" : "disarmed");
}

}  // namespace

Emergency::Emergency(Fleet& fleet, std::function<void()> changed, base::Logger log)
    : fleet_(fleet), changed_(std::move(changed)), log_(std::move(log)) {
  fleet_.set_send_guard([this](MavlinkVehicle const& craft, mavlink::Message const& message) -> base::Result<> {
    if (!state_.is_latched || passes_stop(craft, message)) return {};
    return base::fail(base::ErrorKind::refused, fmt::format("emergency stop by {}", state_.by),
                      "release the emergency stop first");
  });
}

Emergency::~Emergency() {
  fleet_.set_send_guard({});
}

void Emergency::latch(StopAction action, Commander by) {
  log_.error(fmt::format("EMERGENCY STOP ({}) by {}: latched until an operator releases it", to_string(action), by));
  bool const goes_on = state_.is_latched;
  if (!goes_on) state_ = {.is_latched = true, .since = base::wall_now()};
  state_.action = action;
  state_.by = std::move(by);
  state_.vehicles.clear();
  pursuits_.clear();
  for (auto* craft : fleet_.all()) join(*craft);
  if (!goes_on) {
    welcome_ = welcome();
    welcome_.start();
  }
  changed_();
}

void Emergency::release(Commander const& by) {
  if (!std::exchange(state_.is_latched, false)) return;
  pursuits_.clear();
  welcome_ = {};
  log_.warn(fmt::format("emergency stop released by {}: vehicles stay as they are until somebody commands them", by));
  changed_();
}

void Emergency::leave_to_operator(vehicle::VehicleId const& id) {
  auto const found = pursuits_.find(id);
  if (!state_.is_latched || found == pursuits_.end()) return;
  if (!found->second.is_left_to_pilot) pursuits_.erase(found);
  auto const* craft = fleet_.find(id);
  tell(*craft, "left to the operator's command");
}

void Emergency::resume(MavlinkVehicle& craft) {
  if (!state_.is_latched || pursuits_.contains(craft.id())) return;
  outcome(craft).is_confirmed = false;
  tell(craft, "the operator's command came to nothing: stopped again");
  begin_pursuit(craft);
}

void Emergency::join(MavlinkVehicle& craft) {
  state_.vehicles.push_back({.vehicle = craft.id()});
  begin_pursuit(craft);
}

void Emergency::begin_pursuit(MavlinkVehicle& craft) {
  auto& pursuit = pursuits_[craft.id()] = {.task = pursue(craft)};
  pursuit.task.start();
}

base::Task<> Emergency::welcome() {
  for (;;) {
    co_await fleet_.registry().membership_changed().wait();
    for (auto* craft : fleet_.all()) {
      bool const is_known =
          std::ranges::find(state_.vehicles, craft->id(), &StopOutcome::vehicle) != state_.vehicles.end();
      bool const are_two = craft->state.links.connection == vehicle::Connection::conflict;
      if (is_known && are_two && is_left(*craft)) begin_pursuit(*craft);
      if (is_known) continue;
      join(*craft);
      changed_();
    }
  }
}

bool Emergency::is_left(MavlinkVehicle const& craft) const {
  auto const found = pursuits_.find(craft.id());
  return found == pursuits_.end() || found->second.is_left_to_pilot;
}

base::Task<bool> Emergency::stop_once(MavlinkVehicle& craft) {
  ++outcome(craft).tries;
  if (may_be_two(craft)) hold_all(craft);
  std::function<void()> const on_accepted = [this, &craft] {
    outcome(craft).is_acknowledged = true;
    changed_();
  };
  auto const stopped = co_await stop_at_once(craft.connection, craft, state_.action, on_accepted);
  if (stopped && !may_be_two(craft)) co_return true;
  tell(craft,
       stopped ? "heard from two places: stopped again until it is known to be one vehicle" : stopped.error().message);
  co_return false;
}

base::Task<> Emergency::pursue(MavlinkVehicle& craft) {
  auto& loop = fleet_.loop();
  for (;;) {
    bool const stopped = co_await stop_once(craft);
    if (!stopped) {
      co_await loop.sleep(pause);
      continue;
    }
    outcome(craft).is_confirmed = true;
    tell(craft, posture(craft));
    Rest const rest{craft.heard->custom_mode, craft.heard->is_armed};
    auto const since = loop.now();
    while (!has_left(rest, craft) && !may_be_two(craft)) co_await craft.changed.wait();
    outcome(craft).is_confirmed = false;
    if (may_be_two(craft)) continue;
    tell(craft, fmt::format("left its stop: {}", posture(craft)));
    if (loop.now() - since <= late_commands_end) continue;
    pursuits_[craft.id()].is_left_to_pilot = true;
    co_return;
  }
}

StopOutcome& Emergency::outcome(MavlinkVehicle const& craft) {
  return *std::ranges::find(state_.vehicles, craft.id(), &StopOutcome::vehicle);
}

void Emergency::tell(MavlinkVehicle const& craft, std::string detail) {
  auto& shown = outcome(craft);
  if (shown.detail == detail) return;
  auto line = fmt::format("{}: {}", craft.state.name, detail);
  shown.is_confirmed ? log_.warn("stopped: " + line) : log_.error("not stopped yet: " + line);
  shown.detail = std::move(detail);
  changed_();
}

}  // namespace lapwing::fleet
