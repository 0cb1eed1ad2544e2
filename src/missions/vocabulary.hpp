#pragma once

#include "plan/plausibility/settings.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::missions {

/// What every platform that flies missions adds to the language: the one list that check, plan, run, editors, tests and
/// fuzz targets read scripts with. `settings`: by which doubts about missions are judged.
[[nodiscard]] tasks::Vocabulary vocabulary(plan::plausibility::Settings settings = {});

}  // namespace lapwing::missions
