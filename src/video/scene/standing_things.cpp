#include "video/scene/standing_things.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "video/scene/vehicle_solid.hpp"

namespace lapwing::video {

namespace {

constexpr std::uint64_t leaves_of_trees = 901;
/// Long sides are drawn in pieces, since a lens bends them.
constexpr double piece_m = 2.0;

std::vector<Spot> in_pieces(std::vector<Spot> const& corners) {
  std::vector<Spot> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto const way = corners[(i + 1) % corners.size()] - corners[i];
    int const count = std::max(1, static_cast<int>(std::ceil(way.length() / piece_m)));
    for (int k = 0; k < count; ++k) points.push_back(corners[i] + way * (static_cast<double>(k) / count));
  }
  return points;
}

struct Wall {
  std::array<Eigen::Vector3d, 4> corners;
  double light = 1.0;
  double distance_m = 0.0;
};

/// Those that look at the camera, the farthest first.
std::vector<Wall> walls_of(std::vector<Spot> const& points, double height_m, Eigen::Vector3d const& camera,
                           Sun const& sun) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto const& a = points[i];
    auto const& b = points[(i + 1) % points.size()];
    Eigen::Vector3d const normal = Eigen::Vector3d((b - a).y(), -(b - a).x(), 0.0).normalized();
    Eigen::Vector3d const foot(a.x(), a.y(), 0.0);
    if (normal.dot(camera - foot) <= 0.0) continue;
    walls.push_back({{foot, {b.x(), b.y(), 0.0}, {b.x(), b.y(), height_m}, {a.x(), a.y(), height_m}},
                     std::clamp(sun.on(normal), 0.35, 1.2),
                     (camera - foot).norm()});
  }
  std::ranges::stable_sort(walls, std::ranges::greater(), &Wall::distance_m);
  return walls;
}

}  // namespace

Crown crown_of(Tree const& tree, Sun const& sun, std::uint64_t seed, std::uint64_t number) {
  Dice dice(seed, leaves_of_trees, number);
  constexpr std::array<Colour, 3> greens = {{{0.26, 0.36, 0.17}, {0.21, 0.30, 0.15}, {0.34, 0.39, 0.2}}};
  auto const& green = greens[dice.bits() % greens.size()];
  Crown crown{.tree = tree, .leaves = {}};
  constexpr int tufts = 380;
  double const flat = std::min(0.35 * tree.radius_m, 0.3 * tree.height_m);
  for (int i = 0; i < tufts; ++i) {
    double const out = std::sqrt(dice.uniform());
    double const angle = dice.uniform(0.0, 2.0 * std::numbers::pi);
    // A dome: the farther out, the lower.
    double const up = flat * (std::sqrt(1.0 - 0.9 * out * out) + 0.25 * dice.gaussian());
    double const radius_m = tree.radius_m * dice.uniform(0.05, 0.15);
    Eigen::Vector3d const off((tree.radius_m - 0.6 * radius_m) * out * std::cos(angle),
                              (tree.radius_m - 0.6 * radius_m) * out * std::sin(angle), up - 1.2 * flat);
    double const facing = 0.5 + 0.5 * off.dot(sun.towards) / tree.radius_m;
    double const light = sun.brightness * dice.uniform(0.6, 1.25) * (0.6 + 0.55 * facing);
    crown.leaves.push_back(
        {Eigen::Vector3d(tree.at.x(), tree.at.y(), tree.height_m) + off, radius_m, bgr(green, light)});
  }
  std::ranges::stable_sort(crown.leaves, std::ranges::less(), [](auto const& leaves) { return leaves.at.z(); });
  return crown;
}

void draw_tree(Projector const& projector, Crown const& crown, Sun const& sun) {
  // The trunk, as wide as it is seen from the camera.
  auto const& tree = crown.tree;
  Eigen::Vector3d const foot(tree.at.x(), tree.at.y(), 0.0);
  Eigen::Vector2d const away = (foot - projector.camera()).head<2>();
  double const half_m = 0.06 * tree.radius_m;
  if (away.norm() > half_m) {
    Eigen::Vector3d const aside = Eigen::Vector3d(-away.y(), away.x(), 0.0) * (half_m / away.norm());
    Eigen::Vector3d const up(0.0, 0.0, 0.8 * tree.height_m);
    constexpr Colour bark = {0.3, 0.25, 0.2};
    projector.fill(std::array<Eigen::Vector3d, 4>{foot - aside, foot + aside, foot + aside + up, foot - aside + up},
                   bgr(bark, 0.8 * sun.brightness));
  }
  for (auto const& leaves : crown.leaves) projector.disc(leaves.at, leaves.radius_m, leaves.colour);
}

void draw_block(Projector const& projector, Block const& block, Sun const& sun) {
  auto corners = block.corners;
  if (!geo::is_counterclockwise(corners)) std::ranges::reverse(corners);
  auto const points = in_pieces(corners);
  constexpr Colour plaster = {0.78, 0.76, 0.72};
  for (auto const& wall : walls_of(points, block.height_m, projector.camera(), sun))
    projector.fill(wall.corners, bgr(plaster, wall.light));
  if (projector.camera().z() <= block.height_m) return;
  std::vector<Eigen::Vector3d> roof;
  for (auto const& point : points) roof.emplace_back(point.x(), point.y(), block.height_m);
  projector.fill(roof, bgr(block.roof, sun.brightness), false);
}

}  // namespace lapwing::video
