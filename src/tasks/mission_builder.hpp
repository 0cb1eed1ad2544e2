#pragma once

#include "tasks/mission_task.hpp"

namespace lapwing::tasks {

/// The block word `mission { ... }` with all its commands (language spec, 5.5). Builds `MissionTask`s; one without a
/// `name` is called MissionPlan_N, N counting the missions that this spec has built.
/// `settings`: by which its doubts are judged.
[[nodiscard]] BuilderSpec mission_builder(plan::plausibility::Settings settings = {});

}  // namespace lapwing::tasks
