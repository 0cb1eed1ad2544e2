#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "plan/mission.hpp"
#include "tasks/platform.hpp"

namespace lapwing::missions {

/// Missions drawn elsewhere, by the name that scripts give them: `task('survey1')`. One that could not be read keeps
/// its error, which is whoever's who asks for it.
using PlanLibrary = std::map<std::string, base::Result<plan::Mission>, std::less<>>;

/// Errors: not_found; or why the plan of that name could not be read.
[[nodiscard]] base::Result<std::shared_ptr<tasks::PlatformTask const>> find_plan(PlanLibrary const& library,
                                                                                 std::string_view name);
[[nodiscard]] std::vector<std::string> names_of(PlanLibrary const& library);

}  // namespace lapwing::missions
