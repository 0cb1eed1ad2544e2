#include "perceive/ground_picture.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "explore/lot/lot_map.hpp"

namespace lapwing::perceive {

namespace {

/// Four pixels of a line that is 10 cm wide.
constexpr double finest_m = 0.025;
/// What is larger says that the drone is too high for its camera; it is drawn coarser.
constexpr double most_pixels_a_side = 2'400.0;
constexpr double grey = 110.0;
/// The way from ground to pixel is worked out there, and straight in between.
constexpr int step_px = 16;
constexpr float outside = -1e4F;

struct Extent {
  double left = 1e18;
  double right = -1e18;
  double top = 1e18;
  double bottom = -1e18;
};

Extent extent_of(geo::Ring<geo::SiteFrame> const& ring, Eigen::Vector2d const& right, Eigen::Vector2d const& down) {
  Extent extent;
  for (auto const& point : ring) {
    extent.left = std::min(extent.left, right.dot(point.v));
    extent.right = std::max(extent.right, right.dot(point.v));
    extent.top = std::min(extent.top, down.dot(point.v));
    extent.bottom = std::max(extent.bottom, down.dot(point.v));
  }
  return extent;
}

/// The camera's right hand on the ground; for one that looks straight down or aside it is level.
Eigen::Vector2d right_hand(geo::CameraPlace const& camera) {
  geo::Vector3<geo::SiteFrame> const right = camera * geo::Vector3<geo::CameraFrame>(1.0, 0.0, 0.0);
  Eigen::Vector2d const level(right.x(), right.y());
  constexpr double least = 1e-6;  // a camera on its side
  return level.norm() > least ? Eigen::Vector2d(level.normalized()) : Eigen::Vector2d::UnitX();
}

/// Where each pixel of the ground is found in the picture, which is `shrunk` times smaller than the lens's.
cv::Mat places_in_picture(GroundPicture const& ground, geo::GroundView const& view, cv::Size const& size,
                          double shrunk) {
  auto const camera_from_site = view.site_from_camera.inverse();
  // One more on each side, so that nothing is drawn from beyond the last.
  cv::Size const nodes(size.width / step_px + 3, size.height / step_px + 3);
  cv::Mat coarse(nodes, CV_32FC2);
  for (int row = 0; row < nodes.height; ++row) {
    for (int column = 0; column < nodes.width; ++column) {
      auto const middle = [](int node) { return (node - 1) * step_px + 0.5 * step_px; };
      auto const place = ground.ground({ground.metres_a_pixel * middle(column), ground.metres_a_pixel * middle(row)});
      auto const pixel = geo::pixel_of(
          view.lens, camera_from_site * geo::Point3<geo::SiteFrame>(place.x(), place.y(), view.ground_up_m));
      constexpr double half = 0.5;  // OpenCV counts from the middle of the first pixel
      coarse.at<cv::Vec2f>(row, column) =
          pixel ? cv::Vec2f(static_cast<float>(pixel->x / shrunk - half), static_cast<float>(pixel->y / shrunk - half))
                : cv::Vec2f(outside, outside);
    }
  }
  cv::Mat fine;
  cv::resize(coarse, fine, {nodes.width * step_px, nodes.height * step_px}, 0.0, 0.0, cv::INTER_LINEAR);
  return fine(cv::Rect(step_px, step_px, size.width, size.height));
}

}  // namespace

std::optional<GroundPicture> ground_picture(cv::Mat const& picture, geo::GroundView const& view,
                                            explore::LotSettings const& settings) {
  auto const seen = explore::well_seen_ground(view, settings);
  auto const sampling = geo::ground_sampling(view, view.lens.middle);
  if (picture.empty() || seen.rings.empty() || !sampling) return std::nullopt;
  GroundPicture ground;
  ground.right = right_hand(view.site_from_camera);
  ground.down = Eigen::Vector2d(ground.right.y(), -ground.right.x());
  auto const extent = extent_of(seen.rings.front(), ground.right, ground.down);
  double const wide_m = extent.right - extent.left;
  double const high_m = extent.bottom - extent.top;
  ground.metres_a_pixel =
      std::max({finest_m, sampling->finest_m, wide_m / most_pixels_a_side, high_m / most_pixels_a_side});
  ground.corner = map::SitePoint(Eigen::Vector2d(extent.left * ground.right + extent.top * ground.down));
  cv::Size const size(std::max(1, static_cast<int>(wide_m / ground.metres_a_pixel)),
                      std::max(1, static_cast<int>(high_m / ground.metres_a_pixel)));

  // Several pixels of the picture in one of the ground: each is to count.
  double const shrunk = std::max(1.0, std::floor(ground.metres_a_pixel / sampling->finest_m));
  cv::Mat source = picture;
  if (shrunk > 1.0) cv::resize(picture, source, {}, 1.0 / shrunk, 1.0 / shrunk, cv::INTER_AREA);
  cv::remap(source, ground.pixels, places_in_picture(ground, view, size, shrunk), cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_CONSTANT, cv::Scalar::all(grey));
  return ground;
}

}  // namespace lapwing::perceive
