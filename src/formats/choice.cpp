#include "formats/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "map/features/placement.hpp"

namespace lapwing::formats {

namespace {

constexpr double turn_deg = 360.0;

/// The least box round places of one site, in longitudes that may go on beyond 180 degrees.
class Reach {
 public:
  void add(geo::Wgs84 const& place) {
    box_.west = std::min(box_.west, place.lon_deg());
    box_.east = std::max(box_.east, place.lon_deg());
    box_.south = std::min(box_.south, place.lat_deg());
    box_.north = std::max(box_.north, place.lat_deg());
  }
  /// `wanted` may lie in another turn, and across the antimeridian.
  [[nodiscard]] bool meets(DegreeBox const& wanted) const {
    if (box_.south > wanted.north || wanted.south > box_.north) return false;
    double const east = wanted.east < wanted.west ? wanted.east + turn_deg : wanted.east;
    return std::ranges::any_of(std::array{-turn_deg, 0.0, turn_deg}, [&](double shift) {
      return box_.west <= east + shift && wanted.west + shift <= box_.east;
    });
  }

 private:
  DegreeBox box_{.west = 1e9, .south = 1e9, .east = -1e9, .north = -1e9};
};

bool lies_in(map::Feature const& feature, geo::Site const& site, DegreeBox const& within) {
  auto const box = map::bounds(map::geometry_of(feature.content));
  Reach reach;
  for (double const x : {box.least.x(), box.most.x()})
    for (double const y : {box.least.y(), box.most.y()}) reach.add(map::place_of(site, map::SitePoint(x, y)));
  return reach.meets(within);
}

bool lies_in(map::OccupancyGrid const& grid, geo::Site const& site, DegreeBox const& within) {
  auto const extent = grid.extent();
  if (!extent) return false;
  Reach reach;
  for (double const x : {extent->least.x(), extent->most.x()})
    for (double const y : {extent->least.y(), extent->most.y()})
      reach.add(map::place_of(site, grid.site_from_grid() * geo::Point<map::GridFrame>(x, y)));
  return reach.meets(within);
}

}  // namespace

MapContents chosen_of(MapContents contents, Choice const& choice) {
  auto const is_there = [&](std::string const& site, std::string const& floor, auto const& thing) {
    if (!choice.site.empty() && site != choice.site) return false;
    if (!choice.floor.empty() && floor != choice.floor) return false;
    if (!choice.within) return true;
    auto const of = contents.sites.find(site);
    return of != contents.sites.end() && lies_in(thing, of->second, *choice.within);
  };
  std::erase_if(contents.features, [&](map::Feature const& feature) {
    bool const is_wanted = choice.layers.empty() ||
                           std::ranges::find(choice.layers, map::layer_of(feature.content)) != choice.layers.end();
    return !is_wanted || !is_there(feature.site, feature.floor, feature);
  });
  std::erase_if(contents.grids,
                [&](auto const& one) { return !is_there(one.first.site, one.first.floor, one.second); });
  bool const is_all = choice.site.empty() && choice.floor.empty() && !choice.within;
  if (is_all) return contents;
  std::set<std::string> used{choice.site};
  for (auto const& feature : contents.features) used.insert(feature.site);
  for (auto const& [key, grid] : contents.grids) used.insert(key.site);
  std::erase_if(contents.sites, [&](auto const& one) { return !used.contains(one.first); });
  return contents;
}

}  // namespace lapwing::formats
