#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/wire/system_name.hpp"
#include "vehicle/alarm.hpp"
#include "vehicle/connection_timeout.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::fleet {

/// One MAVLink network, with system ids of its own: every vehicle that is heard on its connection, kept up to date in
/// the registry.
///
/// A vehicle appears with the first heartbeat of its autopilot and never goes away: silent for longer than its
/// connection time-out it is lost, with the next heartbeat it is back. Long before that it is shown as silent.
/// Telemetry that does not come by itself is asked for. Thread-bound.
class Network {
 public:
  struct Options {
    base::Duration connection_timeout =
        vehicle::default_connection_timeout;  ///< of a vehicle for which nobody set another one
    /// After which a vehicle counts as silent: telemetry comes several times a second.
    base::Duration silence = std::chrono::milliseconds(2500);
    vehicle::BatteryLimits battery_limits = {};  ///< of alarms
    /// Names of a vehicle's equipment, as scripts ask for them. May speak of vehicles of other networks, too.
    std::map<mavlink::SystemName, std::vector<std::string>> payload = {};
    bool asks_for_messages = true;  ///< false: only listen
    /// Goes before ids and names, where there are several networks: "north/1", "north/copter 1".
    std::string name = {};
  };

  Network(mavlink::Connection& connection, vehicle::Registry& registry, Options options, base::Logger log);
  Network(Network const&) = delete;
  Network& operator=(Network const&) = delete;

  /// Null when it was never heard.
  [[nodiscard]] MavlinkVehicle* find(std::uint8_t system_id) const;
  [[nodiscard]] MavlinkVehicle* find(vehicle::VehicleId const& id) const;
  /// Lost ones included, by system id.
  [[nodiscard]] std::vector<MavlinkVehicle*> all() const;

  /// Gives the message rates that were changed back to every connected vehicle, and asks for none any more. For the end
  /// of a program; takes three seconds at most.
  ///
  /// A rate is given back when it is known what it was before, when it still is as we set it, and when no other ground
  /// station was heard over the vehicle's link lately, which might have come to depend on it.
  base::Task<> give_back_rates();

  [[nodiscard]] mavlink::Connection& connection() const { return connection_; }
  [[nodiscard]] base::Loop& loop() const { return connection_.loop(); }

 private:
  /// What this class writes of a vehicle.
  static Heard& heard_of(MavlinkVehicle& craft) { return craft.heard.write(As<Network>()); }
  static Asked& asked_of(MavlinkVehicle& craft) { return craft.asked.write(As<Network>()); }

  void take(mavlink::Received const& received);
  void take_heartbeat(mavlink::Received const& received, mavlink::Heartbeat const& heartbeat);
  void take_from_autopilot(MavlinkVehicle& craft, mavlink::Received const& received);
  void take_from_component(MavlinkVehicle& craft, mavlink::Received const& received);
  void take_radio_of_link(mavlink::Received const& received, mavlink::RadioStatus const& radio);
  void tell(MavlinkVehicle const& craft, std::vector<vehicle::StatusText> const& texts);
  void let_age(MavlinkVehicle& craft);
  MavlinkVehicle& discover(mavlink::Received const& received);
  void note_restart(MavlinkVehicle& craft, base::TimePoint now);
  void note_camera(std::uint8_t system_id);
  void check_connection(MavlinkVehicle& craft);
  void check_silence(MavlinkVehicle& craft);
  void note_heard(MavlinkVehicle& craft, base::TimePoint at);
  [[nodiscard]] std::string in_network(std::string text) const;
  void note_links();
  base::Task<> watch();
  void ask_what_is_due(MavlinkVehicle& craft);
  /// It is heard, and is not perhaps two vehicles.
  [[nodiscard]] bool may_be_asked(MavlinkVehicle const& craft) const;
  base::Task<> ask_questions(MavlinkVehicle& craft);
  base::Task<> ask_for_picture(MavlinkVehicle& craft, Question question);
  base::Task<> ask_for_modes(MavlinkVehicle& craft, Question question);
  void spare_slow_link(MavlinkVehicle& craft);
  base::Task<> ask_for_messages(MavlinkVehicle& craft, std::vector<WantedMessage> wanted);
  base::Task<bool> ask_for_message(MavlinkVehicle& craft, WantedMessage message);
  base::Task<> give_back_rates_of(MavlinkVehicle& craft, base::TimePoint deadline);
  [[nodiscard]] bool others_may_depend_on(MavlinkVehicle const& craft) const;

  mavlink::Connection& connection_;
  vehicle::Registry& registry_;
  Options options_;
  base::Logger log_;
  std::map<std::uint8_t, std::unique_ptr<MavlinkVehicle>> crafts_;  // pointers: craft addresses must not change
  std::set<std::uint8_t> cameras_;                                  ///< systems that were heard to carry one
  std::map<mavlink::PeerRef, base::TimePoint> other_ground_heard_;  ///< heartbeats of other ground stations
  bool is_giving_back_ = false;
  mavlink::Subscription subscription_;
  base::Scope scope_;
};

}  // namespace lapwing::fleet
