#pragma once

#include <optional>

#include "robot/planner/way.hpp"

namespace lapwing::robot {

/// Whether a robot gets on, by one measure: it has come nearer to its goal by the way that is left than it ever was, or
/// its map has grown. Who drives to and fro gets on by neither.
class Progress {
 public:
  struct Now {
    double time_s = 0.0;
    std::optional<Place> goal = {};
    std::optional<double> left_m = {};  ///< of the way to it; nothing when there is none
    double free_m2 = 0.0;               ///< that the map has
  };
  /// A new errand begins.
  void begin(double time_s);
  void note(Now const& now);
  /// The way had to be made longer, to go round something.
  void allow_detour() { least_m_.reset(); }

  [[nodiscard]] double stalled_s(double time_s) const { return time_s - since_s_; }

 private:
  std::optional<Place> goal_;
  std::optional<double> least_m_;
  double most_m2_ = 0.0;
  double since_s_ = 0.0;
};

}  // namespace lapwing::robot
