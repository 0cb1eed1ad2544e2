#pragma once

#include <Eigen/Core>

#include "slam/pose2.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// How far points may lie from the lines that they are said to be on.
struct Association {
  double gate_m = 0.12;   ///< farther apart, two points are not of one wall
  double scale_m = 0.03;  ///< of the robust kernel: residuals beyond count less and less
  int stride = 1;         ///< every n-th point
};

/// A quadratic of two poses' steps (source first): H and b of Gauss-Newton, in 1 / m^2 and radians.
struct PairTerm {
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  double cost = 0.0;  ///< sum of weighted squared residuals
  int matches = 0;

  /// Fewer points pin nothing down.
  [[nodiscard]] bool is_usable() const { return matches >= 15; }
};

/// The points of `source` against the lines of `target`, each with the nearest of those that are seen at about the same
/// bearing and whose normals agree (projective association, Blais & Levine 1995; point to line, Censi 2008, eq. 4),
/// weighted after Geman & McClure.
[[nodiscard]] PairTerm point_to_line(Frame const& source, Pose2 const& source_pose, Frame const& target,
                                     Pose2 const& target_pose, Association const& association);

}  // namespace lapwing::slam
