#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "fleet/control/emergency.hpp"
#include "fleet/control/goal.hpp"
#include "fleet/mission/fleet_platform.hpp"
#include "fleet/network/other_stations.hpp"
#include "plan/plausibility/settings.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// What operators do with the vehicles of a fleet: commands to many at once with what each made of them, the emergency
/// stop, and the command of a vehicle handed from one to the other.
///
/// Each command runs as one task a vehicle, which sends it and then watches what comes of it; a later one, or a stop,
/// destroys that first, so that nothing of it can follow. Thread-bound.
class FleetControl final : public vehicle::VehicleControl {
 public:
  struct Options {
    vehicle::StopAction stop_action = vehicle::StopAction::hold;  ///< of an emergency stop that names none
    base::Duration expiry = std::chrono::seconds(10);             ///< of commands that make a vehicle move
    plan::plausibility::Settings plausibility = {};
    base::Duration answer_timeout = std::chrono::seconds(10);  ///< of who is asked for a vehicle
  };
  /// `fleet` and `platform` outlive this.
  FleetControl(Fleet& fleet, FleetPlatform& platform, Options options, base::Logger log);
  FleetControl(FleetControl const&) = delete;
  FleetControl& operator=(FleetControl const&) = delete;

  /// Called with the reason when the emergency stop is latched: scripts are to be halted.
  void set_on_latched(std::function<void(std::string const& reason)> on_latched) {
    on_latched_ = std::move(on_latched);
  }

  [[nodiscard]] bool has(vehicle::VehicleId const& id) const override { return fleet_.find(id) != nullptr; }
  base::Result<std::uint64_t> command(vehicle::VehicleCommand command, std::span<vehicle::VehicleId const> vehicles,
                                      vehicle::Commander by, bool takes_over) override;
  [[nodiscard]] std::deque<vehicle::CommandRecord> const& commands() const override { return records_; }
  void emergency_stop(std::optional<vehicle::StopAction> action, vehicle::Commander by) override;
  void release_emergency_stop(vehicle::Commander by) override;
  [[nodiscard]] vehicle::EmergencyStop const& emergency() const override { return emergency_.state(); }
  base::Result<> request_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> yield_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> keep_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  void forget(vehicle::Commander const& by) override;
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

 private:
  struct Running {
    std::uint64_t number = 0;
    bool made_commander = false;  ///< nobody had the vehicle before
    bool is_sent = false;         ///< nothing of it is sent any more; what comes of it is watched
    std::string stands;           ///< how far it has got, told or not
    base::Task<> task;
  };

  void give(vehicle::CommandRecord& record, vehicle::VehicleId const& id, bool takes_over);
  [[nodiscard]] base::Result<> let_through(MavlinkVehicle& craft, vehicle::CommandRecord const& record,
                                           bool takes_over);
  base::Task<> carry(MavlinkVehicle& craft, std::uint64_t number, vehicle::VehicleCommand command,
                     base::TimePoint expires);
  /// Watches what comes of it, for some minutes also of what seems to have failed.
  base::Task<> watch(MavlinkVehicle& craft, std::uint64_t number, Goal& goal);
  void fail_command(MavlinkVehicle& craft, std::uint64_t number, base::Error const& error, base::TimePoint expires);
  /// Whether there was a command to end that was not sent completely.
  bool supersede(vehicle::VehicleId const& id, std::string const& reason);
  [[nodiscard]] vehicle::CommandOutcome* outcome_of(std::uint64_t number, vehicle::VehicleId const& id);
  void show(std::uint64_t number, vehicle::VehicleId const& id, vehicle::CommandState state, std::string reason,
            std::optional<double> left_m = std::nullopt);
  void expect_late_arming(MavlinkVehicle& craft);
  void take_late_arming(Network& network, mavlink::Received const& received);
  base::Task<> take_back(MavlinkVehicle& craft);

  Fleet& fleet_;
  FleetPlatform& platform_;
  Options options_;
  std::function<void(std::string const& reason)> on_latched_;
  base::Logger log_;
  std::uint64_t revision_ = 0;
  std::uint64_t last_number_ = 0;
  std::deque<vehicle::CommandRecord> records_;
  std::map<vehicle::VehicleId, Running> running_;
  Emergency emergency_;
  OtherStations others_;
  std::shared_ptr<Fleet::Heard const> acknowledgements_;
  base::Scope scope_;
};

}  // namespace lapwing::fleet
