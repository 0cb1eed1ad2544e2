#pragma once

#include <unordered_map>
#include <vector>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// Key frames by place, to find those that may see the same walls.
class PlaceIndex {
 public:
  PlaceIndex(std::vector<Pose2> const& poses, double radius_m);

  /// The nearest to the pose (a turn counts as a distance, for who looks elsewhere sees less of the same), none of them
  /// neighbours in time of each other or of `own` (-1: of none).
  [[nodiscard]] std::vector<int> near(Pose2 const& pose, int own, int most) const;

 private:
  [[nodiscard]] std::int64_t cell(double x, double y) const;

  std::vector<Pose2> const* poses_;
  double radius_m_;
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

}  // namespace lapwing::slam
