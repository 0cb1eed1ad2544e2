#pragma once

#include <string>

#include "autonomy/states/situation.hpp"

namespace lapwing::autonomy {

/// Why there is a malfunction and what was told in that frame, a line each, for whoever looks for the cause.
[[nodiscard]] std::string diagnostics_text(Situation const& s);

}  // namespace lapwing::autonomy
