#pragma once

#include "missions/mission_task.hpp"

namespace lapwing::missions {

/// The block word `mission { ... }` with all its commands (language spec, 5.5). Builds `MissionTask`s; one without a
/// `name` is called MissionPlan_N, N counting the missions that this spec has built.
/// `settings`: by which its doubts are judged.
[[nodiscard]] tasks::BuilderSpec mission_block(plan::plausibility::Settings settings = {});

}  // namespace lapwing::missions
