#pragma once

#include <vector>

#include "plan/plausibility/settings.hpp"
#include "tasks/platform.hpp"

namespace lapwing::missions {

/// The block words of every platform that flies missions: the one list that check, plan, run, editors, tests and fuzz
/// targets read scripts with. `settings`: by which doubts about missions are judged.
[[nodiscard]] std::vector<tasks::BuilderSpec> vocabulary(plan::plausibility::Settings settings = {});

}  // namespace lapwing::missions
