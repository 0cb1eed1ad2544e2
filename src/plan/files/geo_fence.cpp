#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "plan/files/plan_file.hpp"
#include "plan/plan.hpp"

namespace lapwing::plan {

namespace {

using base::Result;

/// Fits messages on a line.
std::string shown(std::string name, std::size_t number) {
  constexpr std::size_t longest = 40;
  if (name.empty()) return fmt::format("zone {}", number);
  if (name.size() > longest) name = name.substr(0, longest) + "...";
  return name;
}

/// Lays places round home.
class Leveller {
 public:
  explicit Leveller(geo::Wgs84 home) : home_(home), frame_(home) {}

  Result<Zone> zone(GeoZone const& from, std::size_t number) const {
    Zone zone;
    zone.name = shown(from.name, number);
    zone.kind = from.kind;
    zone.lowest_m = limit(from.lowest);
    zone.highest_m = limit(from.highest);
    if (zone.lowest_m && zone.highest_m && *zone.lowest_m >= *zone.highest_m)
      return refuse(zone.name, "the lower limit of height is not below the upper one");
    if (auto const* circle = std::get_if<GeoCircle>(&from.area)) return add_circle(*circle, std::move(zone));
    for (auto const& polygon : std::get<std::vector<GeoPolygon>>(from.area)) {
      Polygon level;
      for (auto const& ring : polygon.rings) {
        auto laid = lay(ring, zone.name);
        if (!laid) return std::unexpected(laid.error());
        level.rings.push_back(*std::move(laid));
      }
      zone.polygons.push_back(std::move(level));
    }
    return zone;
  }

 private:
  static std::unexpected<base::Error> refuse(std::string const& name, std::string_view what, std::string hint = {}) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("fence: {}: {}", name, what), std::move(hint));
  }

  [[nodiscard]] std::optional<double> limit(std::optional<HeightLimit> const& limit) const {
    if (!limit) return std::nullopt;
    return limit->is_above_sea ? limit->height_m - home_.alt_m : limit->height_m;
  }

  [[nodiscard]] Result<LevelPoint> lay(geo::Wgs84 place, std::string const& name) const {
    place.alt_m = home_.alt_m;
    double const distance_m = geo::surface_distance_m(home_, place);
    if (distance_m > max_fence_distance_m)
      return refuse(name, fmt::format("is {:.0f} km away from home", distance_m / 1000.0),
                    "are latitude and longitude swapped? GeoJSON and KML write longitude first");
    auto const local = frame_.ned_from(place);
    return LevelPoint{local.north, local.east};
  }

  [[nodiscard]] Result<Ring> lay(GeoRing const& ring, std::string const& name) const {
    Ring level;
    for (auto const& corner : ring) {
      auto const point = lay(corner, name);
      if (!point) return std::unexpected(point.error());
      level.push_back(*point);
    }
    return level;
  }

  [[nodiscard]] Result<Zone> add_circle(GeoCircle const& circle, Zone zone) const {
    auto const center = lay(circle.center, zone.name);
    if (!center) return std::unexpected(center.error());
    constexpr int corners = 180;
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      double const angle = 2.0 * std::numbers::pi * i / corners;
      ring.push_back(
          {center->x() + circle.radius_m * std::cos(angle), center->y() + circle.radius_m * std::sin(angle)});
    }
    zone.polygons.push_back({{std::move(ring)}});
    return zone;
  }

  geo::Wgs84 home_;
  geo::LocalFrame frame_;
};

}  // namespace

Result<Fence> level(GeoFence const& fence, geo::Wgs84 home) {
  if (fence.zones.empty()) return base::fail(base::ErrorKind::invalid_input, "fence: there is no area in it");
  Leveller const leveller(home);
  Fence level;
  for (std::size_t i = 0; i < fence.zones.size(); ++i) {
    auto zone = leveller.zone(fence.zones[i], i + 1);
    if (!zone) return std::unexpected(zone.error());
    level.zones.push_back(*std::move(zone));
  }
  return level;
}

}  // namespace lapwing::plan
