#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "fleet/network/fleet.hpp"
#include "parameters/service.hpp"
#include "vehicle/parameters.hpp"

namespace lapwing::fleet {

/// The parameters of a fleet's vehicles: each network has a `parameters::ParameterService`, who may change what is the
/// `vehicle::Authority`'s say, as with commands. Thread-bound.
class FleetParameters final : public vehicle::VehicleParameters {
 public:
  /// `fleet` outlives this.
  FleetParameters(Fleet& fleet, parameters::Cache cache, base::Logger log);
  FleetParameters(FleetParameters const&) = delete;
  FleetParameters& operator=(FleetParameters const&) = delete;

  [[nodiscard]] bool has(vehicle::VehicleId const& id) const override { return fleet_.find(id) != nullptr; }
  [[nodiscard]] base::Task<base::Result<vehicle::ParameterList>> all(vehicle::VehicleId id, bool old_ones_do) override;
  [[nodiscard]] std::optional<vehicle::ParameterProgress> progress(vehicle::VehicleId const& id) const override;
  [[nodiscard]] base::Task<base::Result<std::string>> file(vehicle::VehicleId id, bool old_ones_do) override;
  [[nodiscard]] base::Task<base::Result<vehicle::Parameter>> read(vehicle::VehicleId id, std::string name) override;
  [[nodiscard]] base::Task<base::Result<vehicle::ParameterChange>> change(vehicle::VehicleId id, std::string name,
                                                                          double value, vehicle::Commander by) override;

 private:
  using Snapshot = base::Result<parameters::Snapshot>;
  /// A list on its way, for everybody who has asked for it.
  struct Fetch {
    Fetch(base::Loop& loop, parameters::Wanted which) : wanted(which), ended(loop) {}
    parameters::Wanted wanted;
    vehicle::ParameterProgress progress;
    std::optional<Snapshot> result;
    base::Notifier ended;
  };
  class Loan;

  [[nodiscard]] base::Result<MavlinkVehicle*> find(vehicle::VehicleId const& id) const;
  [[nodiscard]] parameters::ParameterService& service_of(mavlink::Connection& connection);
  base::Task<Snapshot> snapshot(vehicle::VehicleId id, bool old_ones_do);
  base::Task<> fetch(MavlinkVehicle& craft, std::shared_ptr<Fetch> into);

  Fleet& fleet_;
  parameters::Cache cache_;
  base::Logger log_;
  std::map<mavlink::Connection*, parameters::ParameterService> services_;
  std::map<vehicle::VehicleId, std::shared_ptr<Fetch>> fetches_;
  std::shared_ptr<Fleet::Heard const> subscription_;
  base::Scope scope_;
};

}  // namespace lapwing::fleet
