#pragma once

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "sim/building/plan/building_plan.hpp"

namespace lapwing::sim::building {

namespace building_kinds {
inline constexpr base::DiagnosticKind too_large{"too-large", base::Severity::error, "The building is too large."};
inline constexpr base::DiagnosticKind misfit{"misfit", base::Severity::error,
                                             "Parts of the building do not fit together."};
}  // namespace building_kinds

/// More is refused before it is built.
inline constexpr std::size_t most_building_bytes = std::size_t{4} << 20;
inline constexpr std::size_t most_walls = 20'000;
inline constexpr std::size_t most_doors = 2'000;
inline constexpr std::size_t most_people = 200;
inline constexpr std::size_t most_furniture = 10'000;
inline constexpr double most_far_m = 2'000.0;

/// A building as people write it (TOML; docs/reference/building.md). Everything wrong is reported with its place; what
/// is returned then is of no use.
[[nodiscard]] BuildingPlan read_building(base::SourceFile const& source, base::Diagnostics& diagnostics);

/// The same for programs: the plan, or all that is wrong as one message for people (invalid_input).
[[nodiscard]] base::Result<BuildingPlan> building_of(std::string name, std::string text);

}  // namespace lapwing::sim::building
