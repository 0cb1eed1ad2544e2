#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"

/// Where vehicles were over time, and what follows from it. Between two points a vehicle moves straight and evenly: all
/// figures are exact for that path.
namespace lapwing::plan {

/// Where a vehicle was at one moment, in the local frame of the site: down is minus the height above its ground.
struct TrackPoint {
  base::Duration time{};
  geo::Ned place_m;

  friend constexpr bool operator==(TrackPoint const&, TrackPoint const&) = default;
};

/// Times rise from point to point.
using Track = std::vector<TrackPoint>;
using TrackPart = std::span<TrackPoint const>;

/// Length of the way in metres, height differences included.
[[nodiscard]] double length_m(TrackPart track);
/// Greatest height above the site's ground; 0 for no track.
[[nodiscard]] double greatest_height_m(TrackPart track);
/// The place at that time; before the begin and after the end those of the ends. Precondition: not empty.
[[nodiscard]] geo::Ned place_at(TrackPart track, base::Duration time);
/// The points from `begin` to `end`, both included.
[[nodiscard]] TrackPart part(TrackPart track, base::Duration begin, base::Duration end);
/// When the vehicle was first that far from where it began, measured level; nothing if it never was.
[[nodiscard]] std::optional<base::Duration> left_start(TrackPart track, double distance_m);

/// The moment at which two vehicles were nearest.
struct Approach {
  base::Duration time{};
  double distance_m = 0.0;  ///< straight, height difference included
  double level_m = 0.0;     ///< the horizontal part of it
  geo::Ned first_m;
  geo::Ned second_m;
};
/// The first of the nearest moments in the time that both tracks cover; nothing when they share none. The points of the
/// two need not be of the same times. Linear in the number of points.
[[nodiscard]] std::optional<Approach> closest_approach(TrackPart first, TrackPart second);

}  // namespace lapwing::plan
