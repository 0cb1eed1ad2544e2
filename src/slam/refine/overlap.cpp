#include "slam/refine/overlap.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {

PlaceIndex::PlaceIndex(std::vector<Pose2> const& poses, double radius_m, int in_time)
    : poses_(&poses), radius_m_(radius_m), in_time_(in_time) {
  for (int k = 0; k < static_cast<int>(poses.size()); ++k) cells_[cell(poses[k].x, poses[k].y)].push_back(k);
}

std::int64_t PlaceIndex::cell(double x, double y) const {
  return static_cast<std::int64_t>(std::floor(x / radius_m_)) * 1'000'003 +
         static_cast<std::int64_t>(std::floor(y / radius_m_));
}

std::vector<int> PlaceIndex::near(Pose2 const& pose, int own, int most) const {
  constexpr double metres_per_rad = 0.7;
  std::vector<std::pair<double, int>> found;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      auto const at = cells_.find(cell(pose.x + i * radius_m_, pose.y + j * radius_m_));
      if (at == cells_.end()) continue;
      for (auto const k : at->second) {
        auto const apart = distance_m(pose, (*poses_)[k]);
        if (k != own && apart <= radius_m_)
          found.emplace_back(apart + metres_per_rad * turn_rad(pose, (*poses_)[k]), k);
      }
    }
  }
  std::ranges::sort(found);
  std::vector<int> chosen;
  for (auto const& [cost, k] : found) {
    if (std::ranges::any_of(chosen, [this, k = k](int c) { return std::abs(c - k) < in_time_; })) continue;
    chosen.push_back(k);
    if (static_cast<int>(chosen.size()) >= most) break;
  }
  return chosen;
}

}  // namespace lapwing::slam
