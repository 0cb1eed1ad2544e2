#include "vision/lot/seen_ground.hpp"

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

SeenGround::SeenGround(std::vector<cv::Point2d> const& outline) {
  for (auto const& corner : outline) outline_.emplace_back(corner);
}

SeenGround SeenGround::rectangle(double width_m, double height_m) {
  return SeenGround({{0.0, 0.0}, {width_m, 0.0}, {width_m, height_m}, {0.0, height_m}});
}

double SeenGround::inside_by(cv::Point2d const& point) const {
  return cv::pointPolygonTest(outline_, cv::Point2f(point), true);
}

}  // namespace lapwing::vision
