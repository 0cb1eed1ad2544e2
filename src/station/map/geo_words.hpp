#pragma once

#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/site.hpp"
#include "map/features/geometry.hpp"

/// Rectangles and times as addresses tell them (OGC API Features 1.0, 7.15.3 and 7.15.4).
namespace lapwing::station {

/// In degrees; `west` is greater than `east` where it lies across the antimeridian.
struct LonLatBox {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;

  /// Whether they share a place, their edges among them.
  [[nodiscard]] bool meets(LonLatBox const& other) const;
  friend bool operator==(LonLatBox const&, LonLatBox const&) = default;
};

/// "west,south,east,north", or six numbers with heights, which are passed over. Error: invalid_input.
[[nodiscard]] base::Result<LonLatBox> lon_lat_box(std::string_view text);

/// Both ends are within; nothing: open.
struct Period {
  std::optional<base::UtcTime> from = {};
  std::optional<base::UtcTime> to = {};

  [[nodiscard]] bool contains(base::UtcTime time) const { return (!from || *from <= time) && (!to || time <= *to); }
};

/// One time, or two with a slash between them, of which one may be ".." or empty. Error: invalid_input.
[[nodiscard]] base::Result<Period> period(std::string_view text);

/// What of a site's plane the box may meet: a rectangle that holds all of it.
struct SiteReach {
  bool is_empty = false;                 ///< the box is elsewhere on the globe
  std::optional<map::SiteBox> box = {};  ///< none: everything
};
[[nodiscard]] SiteReach reach_of(LonLatBox const& box, geo::Site const& site);

/// The rectangle round a geometry, as it lies on the globe.
[[nodiscard]] LonLatBox lon_lat_bounds(map::Geometry const& geometry, geo::Site const& site);
/// The same round a rectangle of the site's plane.
[[nodiscard]] LonLatBox lon_lat_bounds(map::SiteBox const& box, geo::Site const& site);

}  // namespace lapwing::station
