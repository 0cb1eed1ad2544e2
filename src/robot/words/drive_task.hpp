#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tasks/platform.hpp"

namespace lapwing::robot {

/// The steps of a `drive` block, as scripts give them.
struct ExploreStep {
  std::string strategy;
  friend bool operator==(ExploreStep const&, ExploreStep const&) = default;
};
struct DriveToPlaceStep {
  geo::Wgs84 place;
  friend bool operator==(DriveToPlaceStep const&, DriveToPlaceStep const&) = default;
};
/// To what the map calls so: a door's number, a point of interest.
struct DriveToNameStep {
  std::string name;
  friend bool operator==(DriveToNameStep const&, DriveToNameStep const&) = default;
};
struct ReturnStep {
  friend bool operator==(ReturnStep const&, ReturnStep const&) = default;
};
/// With the camera that looks ahead, onto the map.
struct PhotographStep {
  friend bool operator==(PhotographStep const&, PhotographStep const&) = default;
};
struct WaitStep {
  double seconds = 0.0;
  friend bool operator==(WaitStep const&, WaitStep const&) = default;
};
using Step = std::variant<ExploreStep, DriveToPlaceStep, DriveToNameStep, ReturnStep, PhotographStep, WaitStep>;

/// What a robot carries that can take pictures.
inline constexpr auto camera_payload = "Camera";

/// "explore", "drive to room 221".
[[nodiscard]] std::string to_text(Step const& step);

/// What `drive { ... }` builds: for one robot, step by step.
class DriveTask final : public tasks::PlatformTask {
 public:
  DriveTask(std::string name, std::vector<Step> steps) : name_(std::move(name)), steps_(std::move(steps)) {}
  [[nodiscard]] std::vector<Step> const& steps() const { return steps_; }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string kind() const override { return "drive"; }
  [[nodiscard]] std::size_t bytes() const override { return 256 + steps_.size() * sizeof(Step); }
  /// What does not drive on the ground, or has no camera and is to take pictures.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const& vehicle) const override;
  /// The first place that it drives to; nothing where it begins with the robot's own floor.
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override;

 private:
  std::string name_;
  std::vector<Step> steps_;
};

}  // namespace lapwing::robot
