#pragma once

#include "geo/position.hpp"

namespace lapwing::sim {

/// The flat patch of Earth on which a simulated world stands: local north, east, down about an anchor, with heights
/// kept as differences of altitude, so that the ground is level however far a vehicle goes.
class Site {
 public:
  explicit Site(geo::Wgs84 anchor) : anchor_(anchor) {}

  /// The same patch, higher by so much.
  [[nodiscard]] Site raised(double by_m) const {
    auto anchor = anchor_;
    anchor.alt_m += by_m;
    return Site(anchor);
  }
  [[nodiscard]] geo::Wgs84 anchor() const { return anchor_; }
  [[nodiscard]] geo::Wgs84 place_at(geo::Ned offset) const { return geo::displaced(anchor_, offset); }
  [[nodiscard]] geo::Ned ned_from(geo::Wgs84 place) const {
    auto offset = geo::LocalFrame(anchor_).ned_from({place.lat_rad, place.lon_rad, anchor_.alt_m});
    offset.down = anchor_.alt_m - place.alt_m;
    return offset;
  }

 private:
  geo::Wgs84 anchor_;
};

}  // namespace lapwing::sim
