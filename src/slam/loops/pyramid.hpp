#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "slam/loops/strided_level.hpp"

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
  /// The greatest value of the cells x .. x + 2^level - 1 by y likewise, 0 to 255; 0 outside. Not of the coarsest
  /// level.
  [[nodiscard]] int at(int level, int x, int y) const { return values_[level][row(level, y) + column(level, x)]; }
  /// The same from x and from x + 2^level on, by y and y + 2^level likewise: the quarters of a cell of the next level,
  /// of which x is varied first.
  [[nodiscard]] std::array<int, 4> quarters(int level, int x, int y) const {
    auto const size = 1 << level;
    auto const* values = values_[level].data();
    auto const* low = values + row(level, y);
    auto const* high = values + row(level, y + size);
    auto const left = column(level, x);
    auto const right = column(level, x + size);
    return {low[left], low[right], high[left], high[right]};
  }
  /// Of the coarsest level, which is asked at many places at once.
  [[nodiscard]] StridedLevel const& coarsest() const { return coarsest_; }

 private:
  static constexpr int kept_levels = levels - 1;

  /// Where the row of a cell begins; the last row and the last of each row's columns are empty, for what lies outside.
  [[nodiscard]] std::size_t row(int level, int y) const {
    return static_cast<std::size_t>(clamped(level, y, height_)) * static_cast<std::size_t>(width_ + 1);
  }
  [[nodiscard]] std::size_t column(int level, int x) const {
    return static_cast<std::size_t>(clamped(level, x, width_));
  }
  /// A cell that begins outside and ends inside has what the first one inside has.
  [[nodiscard]] static int clamped(int level, int at, int size) {
    auto const inside = std::min(std::max(at, 0), size);
    return at + (1 << level) > 0 ? inside : size;
  }
  [[nodiscard]] std::vector<std::uint8_t> widened(int level) const;

  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> values_[kept_levels];
  StridedLevel coarsest_;
};

}  // namespace lapwing::slam
