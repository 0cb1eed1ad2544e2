#pragma once

#include <cmath>

#include <Eigen/Core>

namespace lapwing::slam {

struct LineThrough {
  Eigen::Vector2f normal;
  bool is_one;  ///< the points lie at most a third as far across it as along
};

/// Principal axis of the points.
[[nodiscard]] inline LineThrough line_through(Eigen::Vector2f const* points, int count) {
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (int i = 0; i < count; ++i) mean += points[i];
  mean /= static_cast<float>(count);
  float xx = 0.0F;
  float xy = 0.0F;
  float yy = 0.0F;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2f const d = points[i] - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  auto const angle = 0.5F * std::atan2(2.0F * xy, xx - yy);
  auto const along = 0.5F * (xx + yy) + std::sqrt(0.25F * (xx - yy) * (xx - yy) + xy * xy);
  auto const across = xx + yy - along;
  return {{-std::sin(angle), std::cos(angle)}, across <= 0.1F * along};
}

}  // namespace lapwing::slam
