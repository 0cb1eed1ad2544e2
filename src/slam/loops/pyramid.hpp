#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace lapwing::slam {

/// Points as a grid that says how near each cell is to one, and the same at 2, 4, 8, 16 times the width, where each
/// cell has the greatest of those that begin at it: what a branch-and-bound search bounds with (Hess et al. 2016,
/// section V).
class Pyramid {
 public:
  static constexpr float cell_m = 0.1F;
  static constexpr int levels = 5;

  explicit Pyramid(std::vector<Eigen::Vector2f> const& points);

  [[nodiscard]] Eigen::Vector2f const& origin() const { return origin_; }
  /// The greatest value of the cells x .. x + 2^level - 1 by y likewise, 0 to 255; 0 outside.
  [[nodiscard]] int at(int level, int x, int y) const {
    auto const reach = (1 << level) - 1;
    if (x < 0) x = x + reach < 0 ? width_ : 0;
    if (y < 0) y = y + reach < 0 ? height_ : 0;
    if (x >= width_ || y >= height_) return 0;
    return values_[level][static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

 private:
  void widen(int level);

  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> values_[levels];
};

}  // namespace lapwing::slam
