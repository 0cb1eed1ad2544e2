#pragma once

#include <cstddef>
#include <vector>

#include "geo/position.hpp"

namespace lapwing::sim {

/// Where a vehicle has been since it was armed, for the way back by SMART_RTL. As ArduPilot's: points no closer than
/// an accuracy, straightened and freed of loops when they become many; when that does not help, the trail is given up
/// until the vehicle is armed again.
class Trail {
 public:
  struct Limits {
    double accuracy_m = 2.0;        ///< SRTL_ACCURACY
    std::size_t most_points = 300;  ///< SRTL_POINTS
  };

  /// Armed, here.
  void begin(geo::Ned here);
  /// Was here. False when this was one point too many, and the trail is given up.
  bool note(geo::Ned here, Limits const& limits);
  [[nodiscard]] bool usable() const { return !given_up_; }
  /// From the beginning on, straightened and freed of loops.
  [[nodiscard]] std::vector<geo::Ned> tidied(Limits const& limits) const;
  /// What is left of it after a part of the way back.
  void keep(std::vector<geo::Ned> points) { points_ = std::move(points); }

 private:
  std::vector<geo::Ned> points_;
  bool given_up_ = false;
};

/// The points without those that are nearer than `tolerance_m` to the line between others (Ramer, Douglas, Peucker).
[[nodiscard]] std::vector<geo::Ned> straightened(std::vector<geo::Ned> const& points, double tolerance_m);
/// The points without the rounds that came back to within `distance_m` of where they began.
[[nodiscard]] std::vector<geo::Ned> without_loops(std::vector<geo::Ned> const& points, double distance_m);

}  // namespace lapwing::sim
