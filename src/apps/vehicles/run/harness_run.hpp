#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "host/files/event_file.hpp"
#include "host/files/files.hpp"
#include "host/files/plans.hpp"

namespace lapwing::apps {

struct HarnessOptions {
  host::EventFile events;
  std::optional<std::uint64_t> seed;
  std::optional<base::Duration> timeout;  ///< of each script, in its own time
  host::LoadedPlans plans;
};

/// Runs scripts one after the other on the language's test platform: vehicles a1 a2 u1 u2, no MAVLink, in unpaced time.
/// Returns the exit code of the first that does not end well, or 0.
[[nodiscard]] int run_on_harness(std::vector<host::ScriptText> const& scripts, HarnessOptions options);

}  // namespace lapwing::apps
