#pragma once

#include <cstdint>
#include <string>

#include "explore/path/motion.hpp"

namespace lapwing::explore {

struct LaserSettings {
  int beams = 360;  ///< around the whole circle
  double range_m = 10.0;
  double noise_m = 0.01;  ///< standard deviation
};

/// What a run is made of; the same settings give the same run.
struct Settings {
  CarrierLimits carrier;
  LaserSettings laser;
  std::string strategy = "nearest";
  int robots = 1;
  int people = 0;
  std::uint64_t seed = 1;
  double map_cell_m = 0.05;            ///< of the robots' map, or the plan's where that is coarser
  double wary_m = 0.5;                 ///< paths keep so far from walls where there is room
  double energy_m = 0.0;               ///< how far each robot can drive on its battery; 0: any way
  double most_time_s = 48.0 * 3600.0;  ///< of simulated time
  bool does_return = true;
};

}  // namespace lapwing::explore
