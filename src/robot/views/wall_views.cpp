#include "robot/views/wall_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "geo/position.hpp"
#include "robot/views/seen_walls.hpp"
#include "robot/views/way_lengths.hpp"

namespace lapwing::robot {

namespace {

constexpr double standing_m = 1.5;         ///< what a look costs beside the way: turning and standing still
constexpr std::size_t most_compared = 12;  ///< of the views of walls, the nearest
/// That so many pieces of wall without anything special are worth as much as one that is likely to have a sign.
constexpr double worth_if_likely = 6.0;

std::set<WallPiece> seen_from(Viewpoint const& view, map::OccupancyGrid const& grid,
                              std::span<CameraMount const> mounts) {
  double const way_rad = std::atan2(view.at.y() - view.from.y(), view.at.x() - view.from.x());
  geo::Pose<geo::SiteFrame> const stands{view.from, geo::wrap_pi(way_rad - view.bearing_rad)};
  std::set<WallPiece> seen;
  for (auto const& mount : mounts)
    for (auto const& shown : walls_in_picture(grid, mount, stands)) seen.insert(piece_of(shown.wall));
  return seen;
}

}  // namespace

std::optional<WallView> next_wall_view(LookBook const& looks, map::OccupancyGrid const& grid,
                                       std::span<CameraMount const> mounts, map::SitePoint const& here) {
  WayLengths const ways(grid, here);
  std::vector<WallView> wanted;
  std::set<WallPiece> others;
  for (auto const& [wall, shows_something, is_noticed] : looks.unclear()) {
    OnWall const what{.position = wall.position, .height_m = high_tag_m, .facing_rad = wall.facing_rad};
    bool const is_likely = shows_something || is_beside_an_opening(what, grid);
    if (!is_likely && is_noticed) continue;
    auto const views = is_wide_enough(what, grid) ? viewpoints_for(what, grid, mounts) : std::vector<Viewpoint>();
    if (views.empty()) continue;
    // What is most likely a sign is read from near; where there may be one, more is seen from afar.
    auto const range_m = [](Viewpoint const& view) { return geo::distance_m(view.from, view.at); };
    auto const& view = is_likely ? views.front() : *std::ranges::max_element(views, {}, range_m);
    auto const way_m = ways.to(view.from);
    if (!way_m) continue;
    wanted.push_back({.piece = piece_of(wall), .view = view, .way_m = *way_m, .is_likely = is_likely});
    if (!is_likely) others.insert(piece_of(wall));
  }
  auto const compared = wanted.begin() + static_cast<std::ptrdiff_t>(std::min(wanted.size(), most_compared));
  std::ranges::partial_sort(wanted, compared, {}, &WallView::way_m);
  std::optional<WallView> best;
  double least_m = 0.0;
  for (auto one = wanted.begin(); one != compared; ++one) {
    auto seen = seen_from(one->view, grid, mounts);
    seen.insert(one->piece);
    auto const count = std::ranges::count_if(seen, [&](WallPiece const& piece) { return others.contains(piece); });
    double const worth = static_cast<double>(count) + (one->is_likely ? worth_if_likely : 0.0);
    double const each_m = (one->way_m + standing_m) / worth;
    if (best && each_m >= least_m) continue;
    best = *one;
    least_m = each_m;
  }
  return best;
}

}  // namespace lapwing::robot
