#include "explore/simulated/walkers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::explore {

namespace {

constexpr double apart_m = 0.35;  ///< so far from a robot's rim a person stops
constexpr double farthest_walk_m = 8.0;
constexpr double from_start_m = 2.0;  ///< nobody stands nearer to a robot at the beginning

double uniform(Random& random, double least, double most) {
  return least + (most - least) * static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

}  // namespace

Walkers::Walkers(World const& world, int people, std::span<Pose const> robots, Random& random) {
  constexpr int most_tries = 10'000;
  for (int tries = 0; tries < most_tries && static_cast<int>(walkers_.size()) < people; ++tries) {
    auto const index = static_cast<std::size_t>(random() % world.is_standable().size());
    if (world.is_standable().at_index(index) == 0) continue;
    auto const place = middle_of(world.is_standable().cell_of(index), world.cell_m());
    if (!world.has_room(place, radius_m)) continue;
    if (std::ranges::any_of(robots,
                            [&](Pose const& robot) { return distance_m(robot.position, place) < from_start_m; }))
      continue;
    walkers_.push_back({place, place, uniform(random, 0.5, 1.2), 0.0});
  }
}

void Walkers::choose(World const& world, Walker& walker, Random& random) const {
  double const yaw = uniform(random, -std::numbers::pi, std::numbers::pi);
  Shift const way(std::cos(yaw), std::sin(yaw));
  double const free_m = world.distance_to_wall_m(walker.at, way, farthest_walk_m) - radius_m - 0.1;
  double const wanted_m = uniform(random, 0.0, std::max(free_m, 0.0));
  double done_m = 0.0;
  // As far as there is room beside, too.
  while (done_m + 0.1 < wanted_m && world.has_room(walker.at + (done_m + 0.1) * way, radius_m)) done_m += 0.1;
  walker.to = walker.at + done_m * way;
  walker.waits_s = uniform(random, 0.0, 3.0);
}

void Walkers::step(World const& world, double seconds, std::span<Disc const> robots, Random& random) {
  for (auto& walker : walkers_) {
    if (walker.waits_s > 0.0) {
      walker.waits_s -= seconds;
      continue;
    }
    auto const left = walker.to - walker.at;
    double const step_m = walker.speed_m_s * seconds;
    if (left.length() <= step_m) {
      choose(world, walker, random);
      continue;
    }
    auto const next = walker.at + (step_m / left.length()) * left;
    bool const is_robot_near = std::ranges::any_of(robots, [&](Disc const& robot) {
      // Whoever has come too near already, or was come near to, may step away.
      double const far_m = distance_m(robot.middle, next);
      return far_m < robot.radius_m + radius_m + apart_m && far_m < distance_m(robot.middle, walker.at);
    });
    if (is_robot_near)
      choose(world, walker, random);
    else
      walker.at = next;
  }
}

std::vector<Disc> Walkers::discs() const {
  std::vector<Disc> discs;
  for (auto const& walker : walkers_) discs.push_back({walker.at, radius_m});
  return discs;
}

}  // namespace lapwing::explore
