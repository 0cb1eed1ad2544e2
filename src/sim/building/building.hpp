#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "sim/building/picture/camera.hpp"
#include "sim/building/plan/building_plan.hpp"
#include "sim/building/robot/robot.hpp"
#include "sim/building/scene/doors.hpp"
#include "sim/building/scene/people.hpp"

namespace lapwing::sim::building {

struct BuildingOptions {
  std::uint64_t seed = 1;
  int robots = 1;
  /// Where they begin; what is missing comes from the plan's starts, and after these beside the first.
  std::vector<Pose> starts = {};
  RobotSettings robot = {};  ///< of each
};

/// What is true of a door, to compare with what a robot made of it.
struct TrueDoor {
  std::string id;
  Place middle;
  double front_rad = 0.0;  ///< the way that its front looks
  double width_m = 0.0;
  double angle_rad = 0.0;  ///< how far it is open
  std::string text;        ///< of its sign; empty: it has none
};

/// A building in which robots drive, doors move and people walk. A value of the plan, the options and the calls: the
/// same ones give the same bytes on the robots' lines and the same pictures.
class Building {
 public:
  /// How far a step goes on.
  static constexpr double step_s = 0.005;

  /// Errors, invalid_input: a robot that starts in something solid, no place for one, more robots than
  /// `most_robots`, a door that stands in no wall.
  [[nodiscard]] static base::Result<std::unique_ptr<Building>> make(BuildingPlan plan, BuildingOptions options);
  static constexpr int most_robots = 32;

  Building(Building const&) = delete;
  Building& operator=(Building const&) = delete;

  void step();
  [[nodiscard]] double time_s() const { return static_cast<double>(steps_) * step_s; }

  [[nodiscard]] std::size_t robot_count() const { return robots_.size(); }
  [[nodiscard]] Robot& robot(std::size_t number) { return *robots_[number]; }
  [[nodiscard]] Robot const& robot(std::size_t number) const { return *robots_[number]; }

  /// Of what a camera on a robot sees now, the one that looks ahead or another; `develop` makes the picture. Nothing
  /// while it has the fault that its cameras are silent.
  [[nodiscard]] std::optional<Shot> shoot(std::size_t robot);
  [[nodiscard]] std::optional<Shot> shoot(std::size_t robot, CameraSettings settings);
  /// Of what any camera would see, from anywhere.
  [[nodiscard]] Shot shoot_from(CameraPose const& pose, CameraSettings const& settings) const;

  // Truth.
  [[nodiscard]] BuildingPlan const& plan() const { return plan_; }
  [[nodiscard]] std::vector<TrueDoor> true_doors() const;
  [[nodiscard]] std::vector<Collision> const& collisions() const { return collisions_; }
  /// At the height of the robots' sensors.
  [[nodiscard]] Surroundings surroundings() const;
  /// A body that touches nothing fixed and no door fits there.
  [[nodiscard]] bool has_room(Place const& middle, double radius_m) const;

  // What a test or a person does in it.
  [[nodiscard]] Doors& doors() { return doors_; }
  [[nodiscard]] People& people() { return people_; }

 private:
  Building(BuildingPlan plan, BuildingOptions options, Bodies bodies);
  [[nodiscard]] base::Result<> place_robots();
  [[nodiscard]] std::optional<Pose> place_near(Pose const& first) const;
  [[nodiscard]] std::vector<Surface> moving_surfaces(std::optional<std::size_t> without_robot) const;

  BuildingPlan plan_;
  BuildingOptions options_;
  std::vector<std::shared_ptr<Lettering const>> lettering_;  ///< of each door's sign; null: none
  std::shared_ptr<std::vector<Surface> const> surfaces_;     // shared with pictures that are being made
  FaceIndex faces_;
  Doors doors_;
  People people_;
  std::vector<std::unique_ptr<Robot>> robots_;  // at fixed places: programs point to them
  std::vector<std::uint64_t> pictures_taken_;
  std::vector<Collision> collisions_;
  std::uint64_t steps_ = 0;
};

}  // namespace lapwing::sim::building
