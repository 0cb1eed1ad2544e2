#include "robot/views/wall_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "geo/position.hpp"
#include "robot/views/free_space.hpp"
#include "robot/views/seen_walls.hpp"
#include "robot/views/way_lengths.hpp"

namespace lapwing::robot {

namespace {

constexpr double standing_m = 1.5;         ///< what a look costs beside the way: turning and standing still
constexpr std::size_t most_compared = 12;  ///< of the views of walls, the nearest: each takes a while
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

/// To before a wall, however near to it one can stand.
std::optional<double> way_before(WallPoint const& wall, WayLengths const& ways) {
  std::optional<double> least_m;
  for (double const before_m : {0.8, 1.2, 2.0}) {
    auto const way_m = ways.to(away(wall.position, wall.facing_rad, before_m));
    if (way_m && (!least_m || *way_m < *least_m)) least_m = way_m;
  }
  return least_m;
}

/// What can be looked at next.
struct Candidate {
  WallView wall;
  double way_m = 0.0;      ///< there, roughly
  bool is_likely = false;  ///< most likely there is a sign: it shows something, or a doorway is beside it
};

/// Nothing when there is no place from which it can be looked at.
std::optional<Candidate> candidate_of(LookBook::Unclear const& unclear, map::OccupancyGrid const& grid,
                                      std::span<CameraMount const> mounts, WayLengths const& ways, WallChoice which) {
  auto const& wall = unclear.wall;
  OnWall const what{.position = wall.position, .height_m = high_tag_m, .facing_rad = wall.facing_rad};
  bool const is_likely = unclear.shows_something || is_beside_an_opening(what, grid);
  if ((which == WallChoice::likely && !is_likely) || !is_wide_enough(what, grid)) return std::nullopt;
  auto const views = viewpoints_for(what, grid, mounts);
  if (views.empty()) return std::nullopt;
  // What is most likely a sign is read from near; where there may be one, more is seen from afar.
  auto const range_m = [](Viewpoint const& view) { return geo::distance_m(view.from, view.at); };
  auto const& view = is_likely ? views.front() : *std::ranges::max_element(views, {}, range_m);
  auto const way_m = ways.to(view.from);
  if (!way_m) return std::nullopt;
  return Candidate{.wall = {.piece = piece_of(wall), .view = view}, .way_m = *way_m, .is_likely = is_likely};
}

}  // namespace

std::optional<WallView> next_wall_view(LookBook const& looks, map::OccupancyGrid const& grid,
                                       std::span<CameraMount const> mounts, map::SitePoint const& here,
                                       WallChoice which) {
  WayLengths const ways(grid, here);
  std::vector<std::pair<double, LookBook::Unclear>> known;
  std::set<WallPiece> unseen;
  for (auto const& unclear : looks.unclear()) {
    unseen.insert(piece_of(unclear.wall));
    if (auto const way_m = way_before(unclear.wall, ways)) known.emplace_back(*way_m, unclear);
  }
  // What was noticed comes first, however far off it is: of other walls there is always another one nearby.
  std::ranges::stable_sort(known, {},
                           [](auto const& one) { return std::pair(!one.second.shows_something, one.first); });
  std::optional<WallView> best;
  double least_m = 0.0;
  std::size_t compared = 0;
  for (auto one = known.begin(); one != known.end() && compared < most_compared; ++one) {
    auto const candidate = candidate_of(one->second, grid, mounts, ways, which);
    if (!candidate) continue;
    if (one->second.shows_something) return candidate->wall;
    ++compared;
    auto seen = seen_from(candidate->wall.view, grid, mounts);
    seen.insert(candidate->wall.piece);
    auto const count = std::ranges::count_if(seen, [&](WallPiece const& piece) { return unseen.contains(piece); });
    double const worth = static_cast<double>(count) + (candidate->is_likely ? worth_if_likely : 0.0);
    double const each_m = (candidate->way_m + standing_m) / worth;
    if (best && each_m >= least_m) continue;
    best = candidate->wall;
    least_m = each_m;
  }
  return best;
}

}  // namespace lapwing::robot
