#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geo/position.hpp"

namespace lapwing::geo {

/// What lies within a closed line on the ground: its corners in order, the last joined to the first, which is not
/// repeated. Altitudes of the corners do not count.
struct Outline {
  std::vector<Wgs84> corners;
  friend bool operator==(Outline const&, Outline const&) = default;
};

/// An area on the ground, as people give it: round a place, or within corners.
using Area = std::variant<Disc, Outline>;

/// Why it is no area ("an area has at least 3 corners, not 2", "its edges cross or touch each other"); nothing for a
/// sound one.
[[nodiscard]] std::optional<std::string> area_fault(Area const& area);

}  // namespace lapwing::geo
