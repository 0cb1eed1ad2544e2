#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explore/floor/dense_grid.hpp"

namespace lapwing::explore {

/// Why a run ended.
enum class Ending {
  explored,  ///< nothing open is left that can be reached
  energy,    ///< a robot's battery would not have taken it any farther and home again
  no_news,   ///< nothing new was seen for an hour
  stuck,     ///< no robot could move on
  time,      ///< the most time that was given is over
};

[[nodiscard]] std::string_view to_string(Ending ending);

struct RunReport {
  std::vector<Pose> starts;       ///< in the world's frame
  double travel_m = 0.0;          ///< of all robots
  double longest_travel_m = 0.0;  ///< of the one that drove farthest
  double time_s = 0.0;            ///< simulated, until the last robot was home
  double coverage = 0.0;          ///< share of what is wanted that was seen
  bool is_finished = false;       ///< explored, and every robot is back at its start
  Ending ending = Ending::explored;
  std::optional<double> travel_to_99_m;  ///< of all robots, until 99 percent were seen
  std::optional<double> time_to_99_s;
  int collisions = 0;  ///< moments at which a robot touched a wall, a person or another robot
};

}  // namespace lapwing::explore
