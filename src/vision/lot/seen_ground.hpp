#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace lapwing::vision {

/// The part of a plan that the picture shows: a convex outline, metres as those of PaintedLine.
class SeenGround {
 public:
  explicit SeenGround(std::vector<cv::Point2d> const& outline);
  /// Of that size, from the upper left corner.
  [[nodiscard]] static SeenGround rectangle(double width_m, double height_m);

  /// Metres to its edge; negative outside of it.
  [[nodiscard]] double inside_by(cv::Point2d const& point) const;

 private:
  std::vector<cv::Point2f> outline_;
};

}  // namespace lapwing::vision
