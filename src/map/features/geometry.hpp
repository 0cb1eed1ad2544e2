#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geo/point.hpp"
#include "geo/polygon.hpp"
#include "geo/site.hpp"

namespace lapwing::map {

using SitePoint = geo::Point<geo::SiteFrame>;
using SiteBox = geo::Box<geo::SiteFrame>;
using SitePolygon = geo::Polygon<geo::SiteFrame>;

/// The points of a line in order, at least two.
struct LineString {
  std::vector<SitePoint> points;
  friend bool operator==(LineString const&, LineString const&) = default;
};

/// Where a feature lies on the ground, in metres in the frame of its site (OGC Simple Features: point, line string,
/// polygon with holes).
using Geometry = std::variant<SitePoint, LineString, SitePolygon>;

/// Limits of what outsiders may give: more is refused before anything is computed.
inline constexpr std::size_t most_points = 100'000;
/// Of a polygon, all rings together: whether edges cross costs more than a look at each.
inline constexpr std::size_t most_corners = 10'000;
inline constexpr double farthest_m = 100'000.0;  ///< from the anchor: beyond that the plane is no map any more

/// Why it cannot lie on the map ("its edges cross or touch each other"); nothing for a sound one.
[[nodiscard]] std::optional<std::string> geometry_fault(Geometry const& geometry);
/// Precondition: sound.
[[nodiscard]] SiteBox bounds(Geometry const& geometry);
[[nodiscard]] std::size_t point_count(Geometry const& geometry);

}  // namespace lapwing::map
