#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "robot/platform/robot_platform.hpp"
#include "vehicle/control.hpp"

namespace lapwing::robot {

/// What operators do with robots: stand, drive to a place or back to the start, the emergency stop, and who commands
/// whom. Thread-bound.
class RobotControl final : public vehicle::VehicleControl {
 public:
  struct Surroundings {
    base::Loop& loop;
    vehicle::Authority& authority;
    base::Duration answer_timeout = std::chrono::seconds(10);  ///< of who is asked for a robot
  };
  /// `platform` and what is around outlive this.
  RobotControl(RobotPlatform& platform, Surroundings around, base::Logger log);
  RobotControl(RobotControl const&) = delete;
  RobotControl& operator=(RobotControl const&) = delete;

  [[nodiscard]] bool has(vehicle::VehicleId const& id) const override { return platform_.robot(id) != nullptr; }
  /// hold, return_home, go_to; arm lets a robot go that was stopped, disarm stops it. Everything else is refused.
  base::Result<std::uint64_t> command(vehicle::VehicleCommand command, std::span<vehicle::VehicleId const> vehicles,
                                      vehicle::Commander by, bool takes_over) override;
  [[nodiscard]] std::deque<vehicle::CommandRecord> const& commands() const override { return records_; }
  /// Whatever kind of stop it is, a robot stands, and its carrier lets it go only when it is released.
  void emergency_stop(std::optional<vehicle::StopAction> action, vehicle::Commander by) override;
  void release_emergency_stop(vehicle::Commander by) override;
  [[nodiscard]] vehicle::EmergencyStop const& emergency() const override { return emergency_; }
  base::Result<> request_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> yield_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> keep_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  void forget(vehicle::Commander const& by) override;
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

 private:
  [[nodiscard]] base::Result<> let_through(vehicle::VehicleId const& id, vehicle::VehicleCommand const& command,
                                           vehicle::Commander const& by, bool takes_over);
  void give(vehicle::CommandRecord& record, vehicle::VehicleId const& id, bool takes_over);
  base::Task<> follow(std::uint64_t number, vehicle::VehicleId id, std::shared_ptr<DriveRecord const> drive);
  base::Task<> wait_until_it_stands(std::uint64_t number, vehicle::VehicleId id);
  /// Kills those that do not show it, until the stop is released.
  base::Task<> keep_stopped();
  void show(std::uint64_t number, vehicle::VehicleId const& id, vehicle::CommandState state, std::string reason = {});

  RobotPlatform& platform_;
  Surroundings around_;
  base::Logger log_;
  std::uint64_t revision_ = 0;
  std::uint64_t last_number_ = 0;
  std::deque<vehicle::CommandRecord> records_;
  vehicle::EmergencyStop emergency_;
  base::Task<> stopping_;
  base::Scope scope_;
};

}  // namespace lapwing::robot
