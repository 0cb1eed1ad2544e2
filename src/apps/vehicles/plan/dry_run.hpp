#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "dryrun/recorder.hpp"
#include "fleet/mission/fleet_platform.hpp"
#include "host/links/ground.hpp"
#include "host/robots/robots.hpp"
#include "host/session/script_host.hpp"
#include "link/pipe_link.hpp"
#include "map/live/live_map.hpp"
#include "plan/plausibility/settings.hpp"
#include "robot/platform/robot_platform.hpp"
#include "sim/world/world.hpp"
#include "tasks/platforms.hpp"

namespace lapwing::apps {

/// One script flown on simulated vehicles as fast as the machine computes, without sockets and without a console: the
/// same script, world and seed give the same record.
class DryRun {
 public:
  struct Options {
    sim::WorldOptions world;
    base::Duration timeout = std::chrono::hours(2);  ///< simulated: a script that still runs then is cut off
    std::vector<std::string> answers;                ///< to the script's questions, in order
    missions::PlanLibrary plans;                     ///< what scripts name by `task('...')`
    plan::plausibility::Settings plausibility = {};
    std::vector<std::string> payload;  ///< what every vehicle carries, by the names that scripts use
  };
  explicit DryRun(Options options);

  /// Robots as `--robot` names them, in simulated buildings; call it first. Errors: those of `host::make_robots`;
  /// invalid_input for a robot that is not simulated.
  [[nodiscard]] base::Result<> add_robots(std::vector<std::string> const& requests);
  /// Powers the vehicles on. Errors: invalid_input when they are too many.
  [[nodiscard]] base::Result<> power_on();
  /// Checks the script and flies it to its end; nothing flies when it does not check. Ctrl-C ends it.
  [[nodiscard]] std::expected<void, station::StartFailure> fly(std::string name, std::string source);

  [[nodiscard]] std::string const& rendered_diagnostics() const { return host_.rendered_diagnostics(); }
  /// Precondition: flown.
  [[nodiscard]] dryrun::FlightRecord record() const;
  [[nodiscard]] dolphin::Outcome const& outcome() const { return *host_.outcome(); }

 private:
  class Voice;
  [[nodiscard]] std::vector<dryrun::VehicleRecord> crew() const;
  [[nodiscard]] std::vector<dryrun::Sample> look() const;
  base::Task<> sample();
  base::Task<> cut_off();
  void add_standstill();
  base::Task<> finish();

  Options options_;
  base::LogHub hub_;
  base::Loop loop_;
  base::Logger log_;
  link::PipeHub air_;
  host::Ground ground_;
  fleet::FleetPlatform platform_;
  map::LiveMap live_map_;
  std::vector<std::unique_ptr<host::SimulatedBuilding>> buildings_;
  robot::RobotPlatform robots_;
  tasks::Platforms platforms_;
  sim::World world_;
  dryrun::Recorder recorder_;
  std::unique_ptr<dolphin::Output> voice_;
  host::ScriptHost host_;
  bool is_cut_off_ = false;
  std::vector<std::string> waiting_for_;
  base::TimePoint ended_{};
};

}  // namespace lapwing::apps
