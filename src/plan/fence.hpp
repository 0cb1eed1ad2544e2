#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/polygon.hpp"
#include "geo/position.hpp"
#include "plan/track.hpp"

/// Where vehicles must stay or must not go, in the local frame of the site.
namespace lapwing::plan {

/// The level plane of `geo::Ned`: x is north and y is east of its origin.
struct LevelFrame {};
using LevelPoint = geo::Point<LevelFrame>;
using Ring = geo::Ring<LevelFrame>;
using Polygon = geo::Polygon<LevelFrame>;

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
