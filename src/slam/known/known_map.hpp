#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "slam/loops/pyramid.hpp"
#include "slam/pose2.hpp"

namespace lapwing::slam {

/// A floor map that is there already, made ready for scans to be laid on it: how far each place is from the nearest
/// cell that is taken, and the same places as a pyramid to search in.
class KnownMap {
 public:
  /// Errors (invalid_input): nothing in it is taken; it is larger than a hundred million cells.
  [[nodiscard]] static base::Result<KnownMap> make(map::OccupancyGrid const& grid);

  /// Farther away nothing counts as near.
  static constexpr float far_m = 0.5F;
  struct Distance {
    float m = far_m;                                  ///< to the nearest wall, at most `far_m`
    Eigen::Vector2f slope = Eigen::Vector2f::Zero();  ///< of the distance along x and y
  };
  /// Between the middles of four cells it goes over evenly (as in Kohlbrecher et al. 2011, section IV).
  [[nodiscard]] Distance distance(Eigen::Vector2d const& place) const;

  [[nodiscard]] Pyramid const& pyramid() const { return pyramid_; }
  [[nodiscard]] Eigen::Vector2d middle() const { return middle_; }
  /// Of the square around the middle with every wall in it.
  [[nodiscard]] double half_side_m() const { return half_side_m_; }

 private:
  explicit KnownMap(std::vector<Eigen::Vector2f> const& walls, float cell_m);
  [[nodiscard]] float at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return far_m;
    return distances_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

  Pyramid pyramid_;
  float cell_m_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
  double half_side_m_ = 0.0;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> distances_;
};

}  // namespace lapwing::slam
