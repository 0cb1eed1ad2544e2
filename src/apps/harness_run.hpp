#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/plans.hpp"

namespace lapwing::apps {

/// Runs a script on the language's test platform: vehicles a1 a2 u1 u2, no MAVLink, in unpaced time. `events` is a file
/// for JSON lines, "-" for standard output, or empty. Returns the exit code.
[[nodiscard]] int run_on_harness(std::string const& name, std::string const& source, std::string const& events,
                                 std::optional<std::uint64_t> seed, LoadedPlans plans);

}  // namespace lapwing::apps
