#include "robot/mapping/mixed_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr float most_aslant = 0.176F;  ///< the tangent of 10 degrees
constexpr float noise_m = 0.05F;
constexpr float most_step_rad = 0.1F;  ///< farther apart beams are no neighbours

}  // namespace

slam::Scan without_mixed_pixels(slam::Scan scan, slam::Sensor const& sensor) {
  auto const& bearings = bearings_of(scan, sensor);
  auto const& ranges = scan.ranges_m;
  // Of each two neighbours: one behind the other, farther than a surface would be. 1: the second is, -1: the first.
  std::vector<int> jumps(ranges.size(), 0);
  auto const jump_to = [&](std::size_t from, std::size_t to) {
    if (!sensor.is_reading(ranges[from]) || !sensor.is_reading(ranges[to])) return 0;
    auto const step_rad = static_cast<float>(std::abs(geo::wrap_pi(double{bearings[to]} - double{bearings[from]})));
    if (step_rad > most_step_rad) return 0;
    float const apart_m = ranges[to] - ranges[from];
    float const most_m = noise_m + std::min(ranges[from], ranges[to]) * step_rad / most_aslant;
    if (std::abs(apart_m) < most_m) return 0;
    return apart_m > 0.0F ? 1 : -1;
  };
  std::size_t const count = ranges.size();
  for (std::size_t i = 0; i < count; ++i) jumps[i] = jump_to(i, (i + 1) % count);
  for (std::size_t i = 0; i < count; ++i) {
    auto const at = [&](std::size_t back) { return jumps[(i + count - back) % count]; };
    bool const is_between = at(1) != 0 && at(1) == at(0);
    bool const goes_on = at(2) == at(1) || jumps[(i + 1) % count] == at(0);
    if (is_between && !goes_on) scan.ranges_m[i] = 0.0F;
  }
  return scan;
}

}  // namespace lapwing::robot
