#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "video/world/car_park.hpp"

namespace lapwing::video {

namespace car_park_kinds {
inline constexpr base::DiagnosticKind too_large{"too-large", base::Severity::error, "The car park is too large."};
inline constexpr base::DiagnosticKind misfit{"misfit", base::Severity::error,
                                             "Parts of the car park do not fit together."};
}  // namespace car_park_kinds

/// More is refused before it is drawn.
inline constexpr std::size_t most_world_bytes = std::size_t{4} << 20;
inline constexpr std::size_t most_slots = 5'000;
inline constexpr std::size_t most_parts = 2'000;    ///< of each other kind
inline constexpr std::size_t most_corners = 1'000;  ///< of one of them
inline constexpr double most_far_m = 500.0;

/// A car park as people write it (TOML; docs/reference/car-park-worlds.md). Everything wrong is reported with its
/// place; what is returned then is of no use. The picture of the ground keeps the name that it has there.
[[nodiscard]] CarPark read_car_park(base::SourceFile const& source, base::Diagnostics& diagnostics);

/// The same for programs: the car park, or all that is wrong as one message for people (invalid_input).
[[nodiscard]] base::Result<CarPark> car_park_of(std::string name, std::string text);

/// Of a file; its picture of the ground is found beside it. Errors: not_found and io, too.
[[nodiscard]] base::Result<CarPark> load_car_park(std::filesystem::path const& file);

}  // namespace lapwing::video
