#pragma once

#include "base/config.hpp"
#include "plan/plausibility/settings.hpp"

namespace lapwing::host {

/// The station file's [plausibility]: limits by name, and [plausibility.allow], rules with the reasons why they may be
/// broken. What is wrong is reported.
[[nodiscard]] plan::plausibility::Settings read_plausibility(base::ConfigReader table);

}  // namespace lapwing::host
