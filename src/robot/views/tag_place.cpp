#include "robot/views/tag_place.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

using geo::SiteFrame;
using map::SitePoint;

constexpr double taken = 0.6;        ///< probability from which on a cell is a wall's
constexpr double beside_m = 0.25;    ///< how far from a point of a wall its direction is looked for
constexpr double lowest_m = 0.8;     ///< nobody hangs name tags below
constexpr double highest_m = 2.3;    ///< nor above
constexpr double bearing_sd = 0.02;  ///< of pose, mount and box together
constexpr double place_sd_m = 0.05;  ///< of the robot's place and its map's cells

SitePoint ahead_of(SitePoint const& from, double way_rad, double by_m) {
  return {from.x() + by_m * std::cos(way_rad), from.y() + by_m * std::sin(way_rad)};
}

std::optional<double> range_to_wall(map::OccupancyGrid const& grid, SitePoint const& from, double way_rad,
                                    double most_m) {
  auto const grid_from_site = grid.site_from_grid().inverse();
  double const step_m = grid.resolution_m() / 2.0;
  for (double range_m = step_m; range_m <= most_m; range_m += step_m) {
    auto const evidence = grid.at(grid.cell_at(grid_from_site * ahead_of(from, way_rad, range_m)));
    if (!evidence.is_seen()) return std::nullopt;
    if (evidence.probability() >= taken) return range_m;
  }
  return std::nullopt;
}

/// Beside a doorway one of the neighbours is the next room's wall: the nearer one belongs to the same wall.
std::optional<SitePoint> neighbour(map::OccupancyGrid const& grid, SitePoint const& from, double way_rad,
                                   SitePoint const& met, double range_m, double most_m) {
  std::optional<SitePoint> nearest;
  double const aside_rad = std::atan2(beside_m, range_m);
  for (double const turn_rad : {-aside_rad, aside_rad}) {
    auto const range = range_to_wall(grid, from, way_rad + turn_rad, most_m);
    if (!range) continue;
    auto const point = ahead_of(from, way_rad + turn_rad, *range);
    if (!nearest || geo::distance_m(point, met) < geo::distance_m(*nearest, met)) nearest = point;
  }
  return nearest;
}

/// Of a line both ways, the one from which it is seen.
double facing_of(double along_rad, double way_rad) {
  double const normal_rad = along_rad + std::numbers::pi / 2.0;
  return geo::wrap_pi(std::cos(normal_rad - way_rad) < 0.0 ? normal_rad : normal_rad + std::numbers::pi);
}

/// Which way the wall runs by its cells around `met` that are seen from there; nothing where these are no line, as in a
/// corner. Two beams tell it badly where they meet a wall aslant.
std::optional<double> direction_of_cells(map::OccupancyGrid const& grid, SitePoint const& from, SitePoint const& met) {
  constexpr double least_cells = 5.0;
  constexpr double least_elongation = 5.0;  // of a corner it is 4
  auto const grid_from_site = grid.site_from_grid().inverse();
  auto const eye = grid_from_site * from;
  auto const middle = grid.cell_at(grid_from_site * met);
  auto const is_taken = [&](map::Cell const& cell) {
    return grid.at(cell).is_seen() && grid.at(cell).probability() >= taken;
  };
  auto const is_lit = [&](map::Cell const& cell) {
    double const far_m = geo::distance_m(grid.centre_of(cell), eye);
    for (auto const& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      map::Cell const beside{cell.x + x, cell.y + y};
      if (grid.at(beside).is_seen() && !is_taken(beside) && geo::distance_m(grid.centre_of(beside), eye) < far_m)
        return true;
    }
    return false;
  };
  auto const reach = static_cast<std::int32_t>(beside_m / grid.resolution_m());
  double count = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (auto y = -reach; y <= reach; ++y) {
    for (auto x = -reach; x <= reach; ++x) {
      map::Cell const cell{middle.x + x, middle.y + y};
      if (!is_taken(cell) || !is_lit(cell)) continue;
      Eigen::Vector2d const at(x, y);
      count += 1.0;
      sum += at;
      squares += at * at.transpose();
    }
  }
  if (count < least_cells) return std::nullopt;
  Eigen::Matrix2d const spread = squares / count - sum * sum.transpose() / (count * count);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const solver(spread);
  if (solver.eigenvalues()(1) < least_elongation * solver.eigenvalues()(0)) return std::nullopt;
  auto const along = solver.eigenvectors().col(1);
  return std::atan2(along.y(), along.x()) + grid.site_from_grid().yaw_rad();
}

/// Along the line of sight a wall that is seen aslant is the less sure.
Eigen::Matrix2d covariance_of(WallPoint const& wall, double way_rad) {
  double const across_m = wall.range_m * bearing_sd;
  double const slant_rad = std::min(std::abs(geo::wrap_pi(wall.facing_rad + std::numbers::pi - way_rad)), 1.3);
  double const along_m = across_m * std::tan(slant_rad);
  Eigen::Vector2d const ahead(std::cos(way_rad), std::sin(way_rad));
  Eigen::Vector2d const aside(-ahead.y(), ahead.x());
  Eigen::Matrix2d const sum = along_m * along_m * ahead * ahead.transpose() +
                              across_m * across_m * aside * aside.transpose() +
                              place_sd_m * place_sd_m * Eigen::Matrix2d::Identity();
  return (sum + sum.transpose()) / 2.0;  // the map takes no other, and rounding makes some
}

}  // namespace

SitePoint camera_place(geo::Pose<SiteFrame> const& body, CameraMount const& mount) {
  auto const ahead = ahead_of(body.position, body.yaw_rad, mount.x_m);
  return ahead_of(ahead, body.yaw_rad + std::numbers::pi / 2.0, mount.y_m);
}

std::optional<WallPoint> wall_seen(map::OccupancyGrid const& grid, geo::Pose<SiteFrame> const& body,
                                   CameraMount const& mount, double bearing_rad, double most_m) {
  auto const from = camera_place(body, mount);
  double const way_rad = body.yaw_rad + bearing_rad;
  auto const range_m = range_to_wall(grid, from, way_rad, most_m);
  if (!range_m) return std::nullopt;
  auto const met = ahead_of(from, way_rad, *range_m);
  auto along_rad = direction_of_cells(grid, from, met);
  if (!along_rad) {
    auto const beside = neighbour(grid, from, way_rad, met, *range_m, most_m);
    if (!beside) return std::nullopt;
    along_rad = std::atan2(beside->y() - met.y(), beside->x() - met.x());
  }
  return WallPoint{.position = met, .range_m = *range_m, .facing_rad = facing_of(*along_rad, way_rad)};
}

std::optional<TagPlace> tag_place(map::OccupancyGrid const& grid, geo::Pose<SiteFrame> const& body,
                                  CameraMount const& mount, vision::Box const& tag) {
  auto const line = sight_line(mount, {.x = tag.x + tag.width / 2.0, .y = tag.y + tag.height / 2.0});
  auto const wall = wall_seen(grid, body, mount, line.bearing_rad);
  if (!wall) return std::nullopt;
  double const height_m = mount.up_m + wall->range_m * line.slope;
  if (height_m < lowest_m || height_m > highest_m) return std::nullopt;
  return TagPlace{
      .wall = *wall, .height_m = height_m, .covariance_m2 = covariance_of(*wall, body.yaw_rad + line.bearing_rad)};
}

}  // namespace lapwing::robot
