#pragma once

#include "plan/plausibility/settings.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::host {

/// What all platforms of the programs add to the language: by it scripts are checked where there are no vehicles.
/// `settings`: by which doubts about missions are judged.
[[nodiscard]] tasks::Vocabulary vocabulary(plan::plausibility::Settings settings = {});

}  // namespace lapwing::host
