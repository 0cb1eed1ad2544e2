#pragma once

#include <numbers>

namespace lapwing::geo {

/// A place on Earth: WGS 84 geodetic latitude and longitude in radians, altitude in metres above mean sea level.
///
/// Altitude is what autopilots call AMSL. Differences of altitude are treated as ellipsoidal height differences, which
/// is exact to millimetres over the few kilometres of a mission.
struct Wgs84 {
  double lat_rad = 0.0;
  double lon_rad = 0.0;
  double alt_m = 0.0;

  [[nodiscard]] static constexpr Wgs84 from_degrees(double lat_deg, double lon_deg, double alt_m = 0.0) {
    return {lat_deg * std::numbers::pi / 180.0, lon_deg * std::numbers::pi / 180.0, alt_m};
  }
  [[nodiscard]] constexpr double lat_deg() const { return lat_rad * 180.0 / std::numbers::pi; }
  [[nodiscard]] constexpr double lon_deg() const { return lon_rad * 180.0 / std::numbers::pi; }

  friend constexpr bool operator==(Wgs84 const&, Wgs84 const&) = default;
};

/// A vector in the local tangent plane at some anchor: north, east, down, in metres (or metres a second for
/// velocities).
struct Ned {
  double north = 0.0;
  double east = 0.0;
  double down = 0.0;

  friend constexpr bool operator==(Ned const&, Ned const&) = default;
};

/// The same plane as east, north, up: the convention of ROS maps (REP 103).
struct Enu {
  double east = 0.0;
  double north = 0.0;
  double up = 0.0;

  friend constexpr bool operator==(Enu const&, Enu const&) = default;
};

[[nodiscard]] constexpr Enu to_enu(Ned v) {
  return {v.east, v.north, -v.down};
}
[[nodiscard]] constexpr Ned to_ned(Enu v) {
  return {v.north, v.east, -v.up};
}

/// The local tangent plane about an anchor: converts between places on Earth and metres round the anchor.
/// GeographicLib's LocalCartesian inside; exact to nanometres near the anchor.
class LocalFrame {
 public:
  explicit LocalFrame(Wgs84 anchor) : anchor_(anchor) {}
  [[nodiscard]] Wgs84 anchor() const { return anchor_; }
  [[nodiscard]] Ned ned_from(Wgs84 place) const;
  [[nodiscard]] Wgs84 place_at(Ned offset) const;

 private:
  Wgs84 anchor_;
};

/// The place `offset` away from `base`, by geodetic north and east at `base`; altitude is exactly base.alt_m -
/// offset.down, not lifted by the Earth's curvature as a straight line would be (language spec, REC-23).
[[nodiscard]] Wgs84 displaced(Wgs84 base, Ned offset);

/// Length of the geodesic on the WGS 84 ellipsoid, in metres; altitude is ignored. (Karney 2013, GeographicLib.)
[[nodiscard]] double surface_distance_m(Wgs84 a, Wgs84 b);
/// Straight-line distance in metres, altitude included.
[[nodiscard]] double distance_m(Wgs84 a, Wgs84 b);
/// Initial bearing of the geodesic from a to b, radians clockwise from north, in [0, 2 pi).
[[nodiscard]] double bearing_rad(Wgs84 from, Wgs84 to);

/// The same angle in [-pi, pi).
[[nodiscard]] double wrap_pi(double angle_rad);
/// The same angle in [0, 2 pi).
[[nodiscard]] double wrap_two_pi(double angle_rad);

/// All points within `radius_m` of `center`; distance is straight, altitude included.
struct Disc {
  Wgs84 center;
  double radius_m = 0.0;
  [[nodiscard]] bool contains(Wgs84 place) const { return distance_m(center, place) <= radius_m; }
  friend constexpr bool operator==(Disc const&, Disc const&) = default;
};

}  // namespace lapwing::geo
