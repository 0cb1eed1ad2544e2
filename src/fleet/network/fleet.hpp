#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fleet/alarms/alarms.hpp"
#include "fleet/network/network.hpp"
#include "vehicle/authority.hpp"

namespace lapwing::fleet {

/// Every vehicle of every network, in one registry. There is at least one network; the vehicles of further ones carry
/// its name in their ids, since each MAVLink network has system ids of its own and ends at 255 of them. Thread-bound.
class Fleet {
 public:
  using Options = Network::Options;
  /// What a vehicle, or another ground station, has said on a network.
  using Heard = std::function<void(Network&, mavlink::Received const&)>;
  /// Asked before anything is sent to a vehicle: an error is what the sender gets.
  using SendGuard = std::function<base::Result<>(MavlinkVehicle const&, mavlink::Message const&)>;

  /// Connections, registry and authority, which is that registry's, outlive the fleet.
  Fleet(mavlink::Connection& connection, vehicle::Registry& registry, vehicle::Authority& authority, Options options,
        base::Logger log);
  ~Fleet();
  Fleet(Fleet const&) = delete;
  Fleet& operator=(Fleet const&) = delete;

  /// A further network of this name; otherwise with the first one's options.
  void add(mavlink::Connection& connection, std::string name);

  /// Null when there is none.
  [[nodiscard]] MavlinkVehicle* find(vehicle::VehicleId const& id) const;
  /// Lost ones included.
  [[nodiscard]] std::vector<MavlinkVehicle*> all() const;
  void set_connection_timeout(vehicle::VehicleId const& id, base::Duration timeout) const;

  /// Who commands which vehicle.
  [[nodiscard]] vehicle::Authority& authority() { return authority_; }
  /// What operators must be told about any vehicle of the registry, whatever platform has it.
  [[nodiscard]] vehicle::VehicleAlarms& alarms() { return alarms_; }
  /// `heard` sees every message of every network, those added later included, as long as the result lives.
  [[nodiscard]] std::shared_ptr<Heard const> subscribe(Heard heard);
  /// Of every network, those added later included. One at a time; empty: none.
  void set_send_guard(SendGuard guard) { send_guard_ = std::move(guard); }
  /// `Network::give_back_rates` of all.
  base::Task<> give_back_rates();

  [[nodiscard]] vehicle::Registry& registry() const { return registry_; }
  [[nodiscard]] base::Loop& loop() const { return networks_.front()->loop(); }

 private:
  void open(mavlink::Connection& connection, Options options);
  [[nodiscard]] base::Result<> check_sending(Network const& network, mavlink::Address target,
                                             mavlink::Message const& message) const;

  vehicle::Registry& registry_;
  vehicle::Authority& authority_;
  base::Logger log_;
  Options options_;
  SendGuard send_guard_;
  std::vector<std::weak_ptr<Heard const>> listeners_;
  std::vector<std::unique_ptr<Network>> networks_;
  std::vector<mavlink::Subscription> subscriptions_;
  Alarms alarms_;
};

}  // namespace lapwing::fleet
