#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "missions/plan_library.hpp"
#include "tasks/harness_platform.hpp"

namespace lapwing::missions {

/// The test platform with missions: `run --platform test`, and what the language is tested on. A mission takes as long
/// as it is estimated to, from its home or, without one, from where the vehicle is.
class MissionHarness final : public tasks::HarnessPlatform {
 public:
  /// `plans`: what named tasks are looked up in first.
  explicit MissionHarness(base::Loop& loop, PlanLibrary plans = {});

  [[nodiscard]] base::Result<std::shared_ptr<tasks::PlatformTask const>> named_task(
      std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> plan_names() const override { return names_of(plans_); }
  /// Refuses raw messages: these vehicles have no protocol.
  [[nodiscard]] base::Result<> perform(tasks::InstructionCall const& call, tasks::VehicleId const& id) override;

 private:
  [[nodiscard]] base::Result<std::optional<base::Duration>> length_of(tasks::PlatformTask const& task,
                                                                      tasks::VehicleInfo const& vehicle) const override;

  PlanLibrary plans_;
};

}  // namespace lapwing::missions
