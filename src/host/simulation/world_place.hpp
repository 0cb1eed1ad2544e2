#pragma once

#include <string>

#include "base/config.hpp"
#include "base/error.hpp"
#include "geo/position.hpp"

namespace lapwing::host {

/// Where on the globe the world of a file lies, be it a car park's or a building's: its `anchor`. Nothing else in it is
/// looked at. Without an anchor, or with one that is no place on Earth, a diagnostic is written.
[[nodiscard]] geo::Wgs84 read_world_place(base::SourceFile const& source, base::Diagnostics& diagnostics);

/// Of that file. Errors: io; invalid_input.
[[nodiscard]] base::Result<geo::Wgs84> world_place(std::string const& path);

}  // namespace lapwing::host
