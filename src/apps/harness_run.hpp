#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/event_file.hpp"
#include "apps/files.hpp"
#include "apps/plans.hpp"
#include "base/time.hpp"

namespace lapwing::apps {

struct HarnessOptions {
  EventFile events;
  std::optional<std::uint64_t> seed;
  std::optional<base::Duration> timeout;  ///< of each script, in its own time
  LoadedPlans plans;
};

/// Runs scripts one after the other on the language's test platform: vehicles a1 a2 u1 u2, no MAVLink, in unpaced time.
/// Returns the exit code of the first that does not end well, or 0.
[[nodiscard]] int run_on_harness(std::vector<ScriptText> const& scripts, HarnessOptions options);

}  // namespace lapwing::apps
