#include "perceive/ties/ground_plan.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace lapwing::perceive {

namespace {

/// A line of paint is two pixels wide.
constexpr double finest_m = 0.06;
constexpr double most_pixels_a_side = 512.0;
/// What stands on the ground leans over it where it is seen aslant.
constexpr double beside_m = 0.36;
constexpr double half = 0.5;  // OpenCV counts from the middle of the first pixel

double pixel_for(double side_m) {
  double pixel_m = finest_m;
  while (side_m / pixel_m > most_pixels_a_side) pixel_m *= 2.0;
  return pixel_m;
}

/// From a pixel of the plan to one of the ground picture.
cv::Matx23d to_picture(GroundPlan const& plan, GroundPicture const& ground) {
  double const scale = plan.pixel_m / ground.metres_a_pixel;
  Eigen::Vector2d const begin = plan.place({half, half}).v - ground.corner.v;
  return {scale * ground.right.x(), -scale * ground.right.y(), ground.right.dot(begin) / ground.metres_a_pixel - half,
          scale * ground.down.x(),  -scale * ground.down.y(),  ground.down.dot(begin) / ground.metres_a_pixel - half};
}

cv::Mat filled(geo::Ring<geo::SiteFrame> const& ring, GroundPlan const& plan, cv::Size const& size) {
  constexpr double on = 255.0;
  std::vector<cv::Point> outline;
  for (auto const& corner : ring)
    outline.emplace_back(static_cast<int>(std::floor((corner.x() - plan.north_west.x()) / plan.pixel_m)),
                         static_cast<int>(std::floor((plan.north_west.y() - corner.y()) / plan.pixel_m)));
  cv::Mat mask = cv::Mat::zeros(size, CV_8U);
  cv::fillPoly(mask, std::vector{outline}, cv::Scalar(on));
  return mask;
}

}  // namespace

cv::Rect2d GroundPlan::box() const {
  return {north_west.x(), -north_west.y(), shades.cols * pixel_m, shades.rows * pixel_m};
}

double GroundPlan::shorter_side_m() const {
  return pixel_m * std::min(shades.cols, shades.rows);
}

int GroundPlan::in_pixels(double metres) const {
  return static_cast<int>(std::lround(metres / pixel_m));
}

map::SitePoint GroundPlan::place(cv::Point2d const& pixels) const {
  return {north_west.x() + pixel_m * pixels.x, north_west.y() - pixel_m * pixels.y};
}

GroundPlan ground_plan(explore::LotSight const& sight, GroundPicture const& ground,
                       geo::Polygon<geo::SiteFrame> const& seen, cv::Mat const& standing) {
  auto const box = geo::bounds(seen);
  auto const extent = box.most - box.least;
  auto const camera = sight.view.site_from_camera.origin();
  GroundPlan plan{.at = sight.at,
                  .below = {camera.x(), camera.y()},
                  .north_west = {box.least.x(), box.most.y()},
                  .pixel_m = pixel_for(std::max(extent.x(), extent.y()))};
  cv::Size const size(plan.in_pixels(extent.x()) + 1, plan.in_pixels(extent.y()) + 1);
  auto const from_plan = to_picture(plan, ground);
  cv::cvtColor(ground.pixels, plan.shades, cv::COLOR_BGR2GRAY);
  cv::GaussianBlur(plan.shades, plan.shades, {}, std::max(half, half * plan.pixel_m / ground.metres_a_pixel));
  cv::warpAffine(plan.shades, plan.shades, from_plan, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  plan.is_seen = filled(seen.rings.front(), plan, size);
  cv::Mat hidden;
  cv::warpAffine(standing, hidden, from_plan, size, cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
  int const around = 2 * plan.in_pixels(beside_m) + 1;
  cv::dilate(hidden, hidden, cv::getStructuringElement(cv::MORPH_RECT, {around, around}));
  plan.is_ground = plan.is_seen & ~hidden;
  return plan;
}

}  // namespace lapwing::perceive
