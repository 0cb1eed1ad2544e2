#pragma once

#include <vector>

#include "robot/planner/way.hpp"

namespace lapwing::robot {

/// Where something that the map does not show held the robot up: its board, or what its laser does not see. Obstacles
/// beside those of the map for a while (as the layers of Nav2's costmaps), and for longer each time that it is the same
/// place.
class Refusals {
 public:
  void note(Place const& place, double time_s);
  /// Those that hold.
  [[nodiscard]] std::vector<Place> at(double time_s) const;
  void forget() { known_.clear(); }

 private:
  struct Refusal {
    Place place = {};
    double until_s = 0.0;
    double lasts_s = 0.0;
  };
  std::vector<Refusal> known_;
};

}  // namespace lapwing::robot
