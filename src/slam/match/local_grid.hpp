#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "slam/pose2.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// A square of cells around the robot that says how near each is to a point of the last key frames: 255 on one, falling
/// off as a Gaussian. It is what the correlative search looks into (Olson 2009, section III).
class LocalGrid {
 public:
  static constexpr float cell_m = 0.05F;
  static constexpr int side = 600;

  LocalGrid() : cells_(static_cast<std::size_t>(side) * side) {}

  /// Empties it and lays its middle there.
  void move_to(Pose2 const& centre);
  void add(Frame const& frame, Pose2 const& pose);

  /// Of a place in the map, in cells; the frame in which `at` is asked.
  [[nodiscard]] Eigen::Vector2f cells_of(Eigen::Vector2d const& place) const {
    return ((place - origin_) / cell_m).cast<float>();
  }
  [[nodiscard]] int at(float x, float y) const {
    auto const column = static_cast<int>(x);
    auto const row = static_cast<int>(y);
    if (static_cast<unsigned>(column) >= side || static_cast<unsigned>(row) >= side) return 0;
    return cells_[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
  }

 private:
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<std::uint8_t> cells_;
};

/// What the correlative search may vary, and what it costs to leave the prediction.
struct SearchWindow {
  double reach_m = 0.4;
  double reach_rad = 0.35;
  double cost_per_m2 = 1.0;  ///< of the score, which is 1 when every point lies on a wall
  double cost_per_rad2 = 1.0;
};

struct Correlation {
  Pose2 pose;
  double score = 0.0;  ///< its fit
};

/// Mean over the points of how near each lies to what the grid has, 1 when every one lies on a wall.
[[nodiscard]] double fit(LocalGrid const& grid, Frame const& frame, Pose2 const& pose);

/// The pose near `guess` at which the frame's points lie best on what the grid has: every pose of the window in steps
/// of 0.1 m and 1 degree with some of the points, then downhill in smaller steps with all of them.
[[nodiscard]] Correlation correlate(LocalGrid const& grid, Frame const& frame, Pose2 const& guess,
                                    SearchWindow const& window);

/// What fits clearly better some way ahead of `found` or behind it than there, if anything does: up to 1.5 m along the
/// way that the robot looks. Wheels that spin, lock or are lifted err so.
[[nodiscard]] std::optional<Correlation> correlate_along(LocalGrid const& grid, Frame const& frame,
                                                         Correlation const& found);

}  // namespace lapwing::slam
