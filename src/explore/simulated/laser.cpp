#include "explore/simulated/laser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::explore {

namespace {

/// Along the ray to the disc's rim; `range_m` where it passes by.
double distance_to_disc_m(Place const& from, Shift const& way, Disc const& disc, double range_m) {
  auto const to = disc.middle - from;
  double const along_m = to.dot(way);
  double const aside_m = std::abs(way.cross(to));
  if (along_m <= 0.0 || aside_m >= disc.radius_m) return range_m;
  return std::clamp(along_m - std::sqrt(disc.radius_m * disc.radius_m - aside_m * aside_m), 0.0, range_m);
}

}  // namespace

Scan scan(World const& world, Pose const& from, LaserSettings const& settings, std::span<Disc const> discs,
          Random& random) {
  Scan scan{from, settings.range_m, {}};
  scan.ranges_m.reserve(static_cast<std::size_t>(settings.beams));
  std::normal_distribution<double> noise(0.0, 1.0);
  for (auto const& way : beam_ways(from.yaw_rad, static_cast<std::size_t>(settings.beams))) {
    double range_m = world.distance_to_wall_m(from.position, way, settings.range_m);
    for (auto const& disc : discs) range_m = distance_to_disc_m(from.position, way, disc, range_m);
    if (range_m < settings.range_m && settings.noise_m > 0.0)
      range_m = std::clamp(range_m + settings.noise_m * noise(random), 0.0, settings.range_m);
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

double sonar_m(World const& world, Place const& from, double yaw_rad, double range_m, std::span<Disc const> discs) {
  constexpr int rays = 5;
  double nearest_m = range_m;
  for (int i = 0; i < rays; ++i) {
    double const yaw = yaw_rad + sonar_cone_rad * (static_cast<double>(i) / (rays - 1) - 0.5);
    Shift const way(std::cos(yaw), std::sin(yaw));
    nearest_m = std::min(nearest_m, world.distance_to_wall_m(from, way, range_m));
    for (auto const& disc : discs) nearest_m = distance_to_disc_m(from, way, disc, nearest_m);
  }
  return nearest_m;
}

}  // namespace lapwing::explore
