#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "base/async/notifier.hpp"
#include "fleet/state/asked.hpp"
#include "fleet/state/heard.hpp"
#include "fleet/state/written_by.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/wire/system_name.hpp"
#include "vehicle/aged.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

// Who writes. Each stands in the file of its name; an action is one of actions/.
class Actions;
class FleetControl;
class FenceReading;
class HomeQuestion;
class MissionRun;
class Network;
class FleetParameters;
class Pilot;
class Questions;
class TestHand;
struct PayloadTaking;
struct TelemetryTaking;

/// What of ours runs on a vehicle.
struct Running {
  /// An upload was given up in the middle, when it had taken so many plans: until it takes a whole one or is cleared it
  /// holds perhaps a part of one plan and a part of another.
  std::optional<unsigned> parts_left_after;
  int loans = 0;  ///< changes of parameters under way by who commands it for their sake alone
};

/// One vehicle as the fleet needs it to fly missions, beyond what `vehicle::VehicleState` shows to everybody: what was
/// heard of it, what was asked of it, what runs on it. Everybody reads all of it; who writes which part stands here.
///
/// Mission runs wait on `changed`, which tells of every message from the vehicle and of its loss. Thread-bound; lives
/// as long as its fleet, so references to it may be kept.
struct MavlinkVehicle {
  MavlinkVehicle(mavlink::Connection& heard_on, vehicle::VehicleState& shown, std::string network_name = {},
                 mavlink::Address of = {})
      : connection(heard_on),
        state(shown),
        discovered(heard_on.loop().now()),
        network(std::move(network_name)),
        address(of),
        changed(heard_on.loop()) {}

  mavlink::Connection& connection;   ///< of its network
  vehicle::VehicleState& state;      ///< the registry's
  base::TimePoint const discovered;  ///< when it was first heard
  std::string const network;         ///< its name; empty: the one without
  mavlink::Address const address;
  base::Duration connection_timeout{};

  WrittenBy<Heard, Network, TelemetryTaking, PayloadTaking, FenceReading, TestHand> heard;
  WrittenBy<Asked, Network, Questions, HomeQuestion, PayloadTaking, Actions, FleetControl> asked;
  WrittenBy<Running, Pilot, MissionRun, FleetControl, FleetParameters> runs;

  base::Notifier changed;

  [[nodiscard]] vehicle::VehicleId const& id() const { return state.id; }
  [[nodiscard]] mavlink::SystemName name() const { return {network, address.system}; }
  /// What is not known is tried.
  [[nodiscard]] bool takes_command_int() const {
    constexpr std::uint64_t command_int = 8;  // MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    return !heard->capabilities || (*heard->capabilities & command_int) != 0;
  }
  [[nodiscard]] bool is_connected() const { return state.links.connection == vehicle::Connection::ok; }
  /// Whether it has told this since it was last silent, in conflict or restarted: what it did meanwhile nobody knows.
  template <typename T>
  [[nodiscard]] bool is_current(vehicle::Aged<T> const& told) const {
    return told.known() && told.heard >= heard->current_from;
  }
  [[nodiscard]] bool holds_parts() const {
    return runs->parts_left_after && *runs->parts_left_after == heard->plans_taken;
  }
};

}  // namespace lapwing::fleet
