#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "plan/fence.hpp"
#include "plan/mission.hpp"

/// A whole plan as files and vehicles hold it: mission, fence, rally points.
namespace lapwing::plan {

/// A ring on Earth, closed by itself; altitudes have no meaning. At least three corners.
using GeoRing = std::vector<geo::Wgs84>;
/// An outer ring, then its holes.
struct GeoPolygon {
  std::vector<GeoRing> rings;
};
struct GeoCircle {
  geo::Wgs84 center;
  double radius_m = 0.0;
};
struct HeightLimit {
  double height_m = 0.0;
  bool is_above_sea = false;  ///< else above home
};
/// One area of a fence: polygons of which a vehicle is in any, or a circle.
struct GeoZone {
  std::string name = {};  ///< empty: none
  Zone::Kind kind = Zone::Kind::inclusion;
  std::variant<std::vector<GeoPolygon>, GeoCircle> area;
  std::optional<HeightLimit> lowest = std::nullopt;
  std::optional<HeightLimit> highest = std::nullopt;
};
struct GeoFence {
  std::vector<GeoZone> zones;
  std::optional<geo::Wgs84> breach_return = std::nullopt;  ///< altitude above home
  [[nodiscard]] bool empty() const { return zones.empty() && !breach_return; }
};

/// Where a vehicle that returns may go instead of home.
struct RallyPoint {
  geo::Wgs84 place;  ///< its altitude counts from what `frame` says
  mavlink::MavFrame frame = mavlink::MavFrame::global_relative_alt;
};

/// What a part of the mission's items was made from: an item of a .plan file with more in it than Lapwing knows (a
/// survey, a corridor, a structure scan, a landing pattern), kept word for word so that it can be edited again.
struct Pattern {
  std::size_t first = 0;  ///< index of the first item made from it
  std::size_t count = 0;  ///< 0: it stores no items, so it cannot be flown
  std::string json;
};

struct Plan {
  Mission mission;                     ///< `home` is not a file's: `planned_home` is
  std::vector<Pattern> patterns = {};  ///< in the order of their items, not overlapping
  std::optional<double> cruise_speed_m_s = std::nullopt;
  std::optional<double> hover_speed_m_s = std::nullopt;
  int firmware_type = 0;  ///< MAV_AUTOPILOT for which it was drawn; 0 for any
  int vehicle_type = 0;   ///< MAV_TYPE
  GeoFence fence = {};
  std::vector<RallyPoint> rally = {};
};

/// The fence round `home`, for looking at tracks. Zones without a name are called "zone 3" after their place in the
/// list. Errors: invalid_input for one without zones, or with corners that are too far away.
[[nodiscard]] base::Result<Fence> level(GeoFence const& fence, geo::Wgs84 home);

}  // namespace lapwing::plan
