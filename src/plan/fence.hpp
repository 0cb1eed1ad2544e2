#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "plan/track.hpp"

/// Where vehicles must stay or must not go, in the local frame of the site.
namespace lapwing::plan {

/// A place on the level plane.
struct LevelPoint {
  double north_m = 0.0;
  double east_m = 0.0;

  friend constexpr bool operator==(LevelPoint const&, LevelPoint const&) = default;
};

/// A closed ring; the last corner is joined to the first. At least three corners.
using Ring = std::vector<LevelPoint>;

/// Rings of which a point is inside by the even-odd rule: an outer one and its holes.
struct Polygon {
  std::vector<Ring> rings;
};

/// One area with limits of height above the site's ground.
struct Zone {
  enum class Kind {
    inclusion,  ///< every vehicle stays in one of these, if there are any
    exclusion   ///< no vehicle enters
  };
  std::string name;
  Kind kind = Kind::inclusion;
  std::vector<Polygon> polygons;
  /// An inclusion's lower limit is looked at from when the vehicle first was above it to when it last was: on its way
  /// up and down it has to pass below.
  std::optional<double> lowest_m;
  std::optional<double> highest_m;
};

struct Fence {
  std::vector<Zone> zones;
};

[[nodiscard]] bool contains(Polygon const& polygon, LevelPoint point);
/// To the nearest edge, from inside or outside.
[[nodiscard]] double distance_to_edge_m(Polygon const& polygon, LevelPoint point);

/// A time without a break during which a vehicle was where it must not be.
struct Breach {
  std::string zone;  ///< the exclusion entered, or the nearest of the inclusions left
  Zone::Kind kind = Zone::Kind::inclusion;
  base::Duration begin{};
  base::Duration end{};
  double depth_m = 0.0;    ///< the shortest way back, at worst, of the moments looked at: points and crossings
  bool by_height = false;  ///< at worst that way is up or down
  TrackPoint worst;
};

/// Every breach of a track, in the order of time. Crossings of edges and heights between two points are found exactly,
/// a corner that is cut in passing included.
[[nodiscard]] std::vector<Breach> breaches(TrackPart track, Fence const& fence);

}  // namespace lapwing::plan
