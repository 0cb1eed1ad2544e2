#pragma once

#include <Eigen/Core>

#include "sim/building/picture/surfaces.hpp"

namespace lapwing::sim::building {

using Light = Eigen::Vector3f;  ///< red, green, blue; 1 is white

/// How bright a surface is at a point of it. `spread_m` is how much of the surface a pixel covers there: what is finer
/// fades into its mean.
[[nodiscard]] Light shade(Surface const& surface, Eigen::Vector3d const& point, double spread_m);

}  // namespace lapwing::sim::building
