#pragma once

#include <unordered_map>
#include <vector>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// Key frames by place, to find those that may see the same walls.
class PlaceIndex {
 public:
  /// `in_time`: key frames nearer to each other in time than so many show nothing that the one does not.
  PlaceIndex(std::vector<Pose2> const& poses, double radius_m, int in_time = 4);

  /// The nearest to the pose (a turn counts as a distance, for who looks elsewhere sees less of the same), none of them
  /// neighbours in time of each other nor nearer to each other than `apart_m`; `own` is left out (-1: none).
  [[nodiscard]] std::vector<int> near(Pose2 const& pose, int own, int most, double apart_m = 0.0) const;

 private:
  [[nodiscard]] static double apart(Pose2 const& a, Pose2 const& b);
  [[nodiscard]] std::int64_t cell(double x, double y) const;

  std::vector<Pose2> const* poses_;
  double radius_m_;
  int in_time_;
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

}  // namespace lapwing::slam
