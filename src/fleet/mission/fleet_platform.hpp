#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "fleet/mission/pilot.hpp"
#include "fleet/network/fleet.hpp"
#include "missions/plan_library.hpp"
#include "tasks/platform.hpp"

namespace lapwing::fleet {

/// One mission that was run, for reports.
struct MissionReport {
  std::string name;
  int items = 0;
  double upload_s = 0.0;
  std::string outcome;  ///< "done", "failed", "stopped", "running"
  std::string error;
  std::optional<plan::Flown> flown = {};  ///< missions that were begun: what was expected, and what came of it
};

/// MAVLink vehicles as a platform of the mission language: `mission { ... }` blocks, flown by the autopilots of a
/// fleet.
///
/// Must outlive the runs that it started. Thread-bound.
class FleetPlatform final : public tasks::Platform {
 public:
  struct Options {
    RunOptions run = {};
    missions::PlanLibrary plan_library = {};  ///< what `task('survey1')` finds
  };

  /// `fleet` outlives the platform.
  FleetPlatform(Fleet& fleet, Options options, base::Logger log);

  [[nodiscard]] tasks::Vocabulary const& vocabulary() const override { return vocabulary_; }
  [[nodiscard]] base::Result<std::shared_ptr<tasks::PlatformTask const>> named_task(
      std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> plan_names() const override {
    return missions::names_of(options_.plan_library);
  }
  [[nodiscard]] std::vector<tasks::VehicleInfo> vehicles() const override;
  [[nodiscard]] std::optional<tasks::VehicleInfo> find(vehicle::VehicleId const& id) const override;
  [[nodiscard]] base::Notifier& vehicles_changed() override { return vehicles_changed_; }
  [[nodiscard]] base::TimePoint all_heard_by() const override { return all_heard_by_; }
  void set_connection_timeout(vehicle::VehicleId const& id, base::Duration timeout) override;
  [[nodiscard]] std::unique_ptr<tasks::TaskRun> start(std::shared_ptr<tasks::PlatformTask const> task,
                                                      vehicle::VehicleId const& id) override;
  /// Missions are what it flies.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::PlatformTask const& task,
                                                    tasks::VehicleInfo const& vehicle) const override;
  /// `sendMessage`.
  [[nodiscard]] base::Result<> perform(tasks::InstructionCall const& call, vehicle::VehicleId const& id) override;
  [[nodiscard]] base::Task<void> settle() override;

  /// Stops every run of ours and ends when each vehicle has confirmed its stop mode, or has failed to with a logged
  /// reason. For the end of a program. Vehicles without a run of ours are not touched.
  [[nodiscard]] base::Task<void> make_safe(OnStop on_stop);
  /// Gives the vehicle, or all of them, up to somebody else: a run on it fails with `reason`, and nothing more is sent.
  void yield(vehicle::VehicleId const& id, std::string const& reason);
  void yield_all(std::string const& reason);
  /// Names of the vehicles that were told to stop and have not confirmed it.
  [[nodiscard]] std::vector<std::string> unsettled() const;
  /// What somebody who commands one of the vehicles has to know of the others.
  [[nodiscard]] Neighbours const& neighbours() const { return options_.run.neighbours; }
  /// Every mission that was run on the vehicle, oldest first.
  [[nodiscard]] std::vector<MissionReport> missions(vehicle::VehicleId const& id) const;

 private:
  /// The message goes out raw, by its MAVLink name.
  [[nodiscard]] base::Result<> send_message(vehicle::VehicleId const& id, std::string_view message,
                                            std::span<tasks::NamedValue const> fields);
  base::Task<void> tell_of_vehicles();
  Pilot& pilot(MavlinkVehicle& craft);
  [[nodiscard]] std::vector<plan::plausibility::Neighbour> neighbours(MavlinkVehicle const& craft) const;

  Fleet& fleet_;
  Options options_;
  base::Logger log_;
  base::TimePoint all_heard_by_;
  tasks::Vocabulary vocabulary_;
  base::Notifier settled_;
  base::Notifier vehicles_changed_;
  std::map<vehicle::VehicleId, std::unique_ptr<Pilot>> pilots_;  // pointers: pilots do not move
  base::Scope scope_;
};

}  // namespace lapwing::fleet
