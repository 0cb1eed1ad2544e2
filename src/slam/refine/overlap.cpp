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

double PlaceIndex::apart(Pose2 const& a, Pose2 const& b) {
  constexpr double metres_per_rad = 0.7;
  return distance_m(a, b) + metres_per_rad * turn_rad(a, b);
}

std::vector<int> PlaceIndex::near(Pose2 const& pose, int own, int most, double apart_m) const {
  auto const& poses = *poses_;
  std::vector<std::pair<double, int>> found;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      auto const at = cells_.find(cell(pose.x + i * radius_m_, pose.y + j * radius_m_));
      if (at == cells_.end()) continue;
      for (auto const k : at->second)
        if (k != own && distance_m(pose, poses[k]) <= radius_m_) found.emplace_back(apart(pose, poses[k]), k);
    }
  }
  std::ranges::sort(found);
  std::vector<int> chosen;
  for (auto const& [cost, k] : found) {
    auto const shows_the_same = [&, k = k](int c) {
      return std::abs(c - k) < in_time_ || (apart_m > 0.0 && apart(poses[c], poses[k]) < apart_m);
    };
    if (std::ranges::any_of(chosen, shows_the_same)) continue;
    chosen.push_back(k);
    if (static_cast<int>(chosen.size()) >= most) break;
  }
  return chosen;
}

}  // namespace lapwing::slam
