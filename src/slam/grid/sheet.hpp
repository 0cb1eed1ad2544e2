#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace lapwing::slam {

/// A rectangle of cells, each with what beams have said of it so far.
struct Sheet {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double cell_m = 0.05;
  int width = 0;
  int height = 0;
  std::vector<float> log_odds = {};

  static constexpr float unseen = 1e3F;  ///< in place of log-odds

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  void add(std::size_t at, float evidence) {
    // What was said a hundred times is not surer than what was said thirty times, and a door may open.
    constexpr float most = 12.0F;
    float const before = log_odds[at] == unseen ? 0.0F : log_odds[at];
    log_odds[at] = std::clamp(before + evidence, -most, most);
  }
};

/// Where a beam or a cone looks from, and which way.
struct Ray {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
};

}  // namespace lapwing::slam
