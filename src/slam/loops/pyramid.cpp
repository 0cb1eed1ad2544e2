#include "slam/loops/pyramid.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace lapwing::slam {

Pyramid::Pyramid(std::vector<Eigen::Vector2f> const& points) {
  LAPWING_ASSERT(!points.empty());
  constexpr int reach = 2;  // cells around a point that it touches
  Eigen::Vector2f low = points.front();
  Eigen::Vector2f high = points.front();
  for (auto const& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  origin_ = low - Eigen::Vector2f::Constant((reach + 1) * cell_m);
  Eigen::Vector2f const size = (high - origin_) / cell_m;
  width_ = static_cast<int>(size.x()) + reach + 2;
  height_ = static_cast<int>(size.y()) + reach + 2;
  auto const pitch = static_cast<std::size_t>(width_ + 1);
  values_[0].assign(pitch * static_cast<std::size_t>(height_ + 1), 0);
  constexpr double spread_cells = 1.0;
  for (auto const& point : points) {
    auto const x = static_cast<int>((point.x() - origin_.x()) / cell_m);
    auto const y = static_cast<int>((point.y() - origin_.y()) / cell_m);
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        auto const near = 255.0 * std::exp(-(i * i + j * j) / (2.0 * spread_cells * spread_cells));
        auto& value = values_[0][static_cast<std::size_t>(y + j) * pitch + static_cast<std::size_t>(x + i)];
        value = std::max(value, static_cast<std::uint8_t>(near));
      }
    }
  }
  for (int level = 1; level < kept_levels; ++level) values_[level] = widened(level);
  auto const coarsest = widened(kept_levels);
  static_assert(1 << kept_levels == StridedLevel::stride);
  coarsest_ = StridedLevel(width_, height_,
                           [&](int x, int y) { return coarsest[row(kept_levels, y) + column(kept_levels, x)]; });
}

std::vector<std::uint8_t> Pyramid::widened(int level) const {
  auto const half = 1 << (level - 1);
  auto const& finer = values_[level - 1];
  auto values = finer;
  auto const pitch = static_cast<std::size_t>(width_ + 1);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      auto const here = static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(x);
      auto& value = values[here];
      if (x + half < width_) value = std::max(value, finer[here + static_cast<std::size_t>(half)]);
      if (y + half < height_) value = std::max(value, finer[here + static_cast<std::size_t>(half) * pitch]);
      if (x + half < width_ && y + half < height_)
        value = std::max(value, finer[here + static_cast<std::size_t>(half) * (pitch + 1)]);
    }
  }
  return values;
}

}  // namespace lapwing::slam
