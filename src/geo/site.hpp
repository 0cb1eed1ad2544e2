#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geo/point.hpp"
#include "geo/position.hpp"
#include "geo/transform.hpp"

namespace lapwing::geo {

/// The frame of a site: x east, y north, z up from its anchor, in metres (REP 105's `map`, georeferenced).
struct SiteFrame {};
/// The frame of one floor's plan, as it was drawn or mapped: x and y level, z up from the floor's ground.
struct FloorFrame {};

/// One level of a site: a car park has one, a building several.
struct Floor {
  std::string id;         ///< short, unique in its site: "0", "1", "B1"
  std::string name = {};  ///< for people: "Ground floor"
  double up_m = 0.0;      ///< of its ground, above the anchor
  /// Where its plan lies in the site; the frames coincide where nothing else is known.
  Transform<SiteFrame, FloorFrame> site_from_floor = {};
};

/// One map frame with a geographic anchor, and its floors. A value: what a site is does not change while it is mapped.
///
/// The frame is the plane that touches the ellipsoid at the anchor. It is meant for the few kilometres of a site: 1 km
/// away the plane is 8 cm above the sea's curve, 10 km away 8 m.
class Site {
 public:
  /// `floors` in any order; none makes one called "0" at the anchor's height. Errors, invalid_input: an anchor that is
  /// no place, a floor without an id, two with one id or at one height, a number that is not finite.
  [[nodiscard]] static base::Result<Site> make(std::string id, Wgs84 anchor, std::vector<Floor> floors = {});

  [[nodiscard]] std::string const& id() const { return id_; }
  [[nodiscard]] Wgs84 anchor() const { return frame_.anchor(); }
  /// From the lowest to the highest; at least one.
  [[nodiscard]] std::span<Floor const> floors() const { return floors_; }
  /// Null when there is none of that id.
  [[nodiscard]] Floor const* floor(std::string_view id) const;
  /// On which something stands or flies that is `up_m` above the anchor: the highest whose ground is not above it but
  /// for `tolerance_m`; the lowest for what is below all.
  [[nodiscard]] Floor const& floor_at(double up_m, double tolerance_m = 0.5) const;

  [[nodiscard]] Point3<SiteFrame> point_of(Wgs84 place) const;
  [[nodiscard]] Wgs84 place_of(Point3<SiteFrame> const& point) const;
  /// Of a point on the ground of a floor.
  [[nodiscard]] Wgs84 place_of(Point<FloorFrame> const& point, Floor const& floor) const;

 private:
  Site(std::string id, Wgs84 anchor, std::vector<Floor> floors)
      : id_(std::move(id)), frame_(anchor), floors_(std::move(floors)) {}

  std::string id_;
  LocalFrame frame_;
  std::vector<Floor> floors_;
};

}  // namespace lapwing::geo
