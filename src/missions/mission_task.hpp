#pragma once

#include <memory>
#include <string>

#include "plan/mission.hpp"
#include "plan/plausibility/settings.hpp"
#include "tasks/platform.hpp"

namespace lapwing::missions {

/// A mission as a task: what `mission { ... }` builds, for every platform that flies missions.
class MissionTask final : public tasks::PlatformTask {
 public:
  /// `settings`: by which `cannot_follow` judges.
  explicit MissionTask(plan::Mission mission, plan::plausibility::Settings settings = {})
      : mission_(std::move(mission)), settings_(std::move(settings)) {}
  [[nodiscard]] plan::Mission const& mission() const { return mission_; }

  [[nodiscard]] std::string name() const override { return mission_.name; }
  [[nodiscard]] std::string kind() const override { return "mission"; }
  [[nodiscard]] std::size_t bytes() const override { return 256 + mission_.items.size() * sizeof(mission_.items[0]); }
  /// It circles somewhere until told otherwise.
  [[nodiscard]] bool never_ends() const override;
  /// A vehicle of a type that cannot carry out one of the items is unsuited (`plan::objection`). Photos need a vehicle
  /// with the payload "Camera"; one of which no payload at all is known gets the benefit of the doubt.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const& vehicle) const override;
  /// Its home; without one its first place.
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override;
  /// A mission without take-off behind one that has landed.
  [[nodiscard]] std::optional<tasks::Doubt> cannot_follow(tasks::PlatformTask const& before) const override;

 private:
  plan::Mission mission_;
  plan::plausibility::Settings settings_;
};

}  // namespace lapwing::missions
