#pragma once

#include <random>
#include <span>

#include "explore/known/known_map.hpp"
#include "explore/simulated/world.hpp"

namespace lapwing::explore {

using Random = std::mt19937_64;

/// What a laser scanner at `from` measures: walls, and whoever stands before them.
[[nodiscard]] Scan scan(World const& world, Pose const& from, LaserSettings const& settings,
                        std::span<Disc const> discs, Random& random);

/// What an ultrasonic sensor measures that looks to `yaw_rad`: the nearest thing within its cone.
[[nodiscard]] double sonar_m(World const& world, Place const& from, double yaw_rad, double range_m,
                             std::span<Disc const> discs);

/// Of the whole cone, about that of an HC-SR04 or a MaxSonar.
inline constexpr double sonar_cone_rad = 0.26;

}  // namespace lapwing::explore
