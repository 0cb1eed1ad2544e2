#include "dryrun/internal/map_frame.hpp"

#include <algorithm>

#include "dryrun/missions.hpp"

namespace lapwing::dryrun::internal {

namespace {

/// Of the fence so much is shown round the flight.
constexpr double fence_share = 0.4;
constexpr double room_share = 0.09;
constexpr double smallest_m = 40.0;

void widen(double& low, double& high, double least) {
  double const missing = std::max(0.0, least - (high - low));
  low -= missing / 2.0;
  high += missing / 2.0;
}

}  // namespace

void Extent::include(double to_north, double to_east) {
  south = std::min(south, to_north);
  north = std::max(north, to_north);
  west = std::min(west, to_east);
  east = std::max(east, to_east);
}

Extent extent_of(Subject const& subject) {
  Extent flight;
  for (auto const& vehicle : subject.record.vehicles)
    for (auto const& point : vehicle.track) flight.include(point.place_m.north, point.place_m.east);
  for (auto const& mission : missions_of(subject.record))
    for (auto const& item : mission.items)
      if (item.place_m) flight.include(item.place_m->north, item.place_m->east);
  double const reach_m = std::max(smallest_m, fence_share * std::max(flight.width(), flight.height()));
  auto extent = flight;
  for (auto const& zone : subject.fence.zones)
    for (auto const& polygon : zone.polygons)
      for (auto const& ring : polygon.rings)
        for (auto const& corner : ring)
          extent.include(std::clamp(corner.north_m, flight.south - reach_m, flight.north + reach_m),
                         std::clamp(corner.east_m, flight.west - reach_m, flight.east + reach_m));
  widen(extent.south, extent.north, std::max(smallest_m, extent.height() * (1.0 + 2.0 * room_share)));
  widen(extent.west, extent.east, std::max(smallest_m, extent.width() * (1.0 + 2.0 * room_share)));
  return extent;
}

MapFrame::MapFrame(Extent const& extent, Box const& box)
    : box_(box),
      centre_{box.at.x + box.width / 2.0, box.at.y + box.height / 2.0},
      north_((extent.south + extent.north) / 2.0),
      east_((extent.west + extent.east) / 2.0),
      pixels_(std::min(box.width / extent.width(), box.height / extent.height())) {}

Extent MapFrame::shown() const {
  double const half_n = box_.height / pixels_ / 2.0;
  double const half_e = box_.width / pixels_ / 2.0;
  return {.south = north_ - half_n, .north = north_ + half_n, .west = east_ - half_e, .east = east_ + half_e};
}

}  // namespace lapwing::dryrun::internal
