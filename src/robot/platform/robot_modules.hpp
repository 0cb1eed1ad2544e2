#pragma once

#include "robot/platform/robot_platform.hpp"
#include "vehicle/modules.hpp"

namespace lapwing::robot {

/// The robots' modules for whoever shows them: those that are needed, and those that have been heard.
class RobotModules final : public vehicle::VehicleModules {
 public:
  /// It outlives this.
  explicit RobotModules(RobotPlatform const& platform) : platform_(platform) {}

  [[nodiscard]] std::vector<vehicle::ModulesOfVehicle> modules(base::TimePoint now) const override;

 private:
  RobotPlatform const& platform_;
};

}  // namespace lapwing::robot
