#include "video/scene/projector.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace lapwing::video {

namespace {

/// OpenCV draws to a sixteenth of a pixel.
constexpr int shift = 4;
constexpr double parts = 1 << shift;
/// What is drawn so far aside would overflow them.
constexpr double farthest_px = 1e6;
constexpr double nearest_ahead_m = 0.05;
/// The middle of a pixel is at its half in geo, at its whole number in OpenCV.
constexpr double half_px = 0.5;
/// Values of pictures grow with a root of the light.
constexpr double gamma_of_pictures = 2.2;

}  // namespace

double Sun::on(Eigen::Vector3d const& normal) const {
  double const sky = (1.0 - share) * (0.5 + 0.5 * normal.z());
  double const straight = share * std::max(0.0, normal.dot(towards)) / std::max(0.25, towards.z());
  return brightness * std::pow(sky + straight, 1.0 / gamma_of_pictures);
}

double Sun::in_shadow(double depth) const {
  return std::pow(1.0 - share * depth, 1.0 / gamma_of_pictures);
}

Eigen::Vector3d Sun::shadow_of(Eigen::Vector3d const& point) const {
  return {point.x() - towards.x() / towards.z() * point.z(), point.y() - towards.y() / towards.z() * point.z(), 0.0};
}

Projector::Projector(geo::GroundView const& view, cv::Mat& picture)
    : lens_(view.lens),
      picture_(picture),
      camera_from_site_(view.site_from_camera.rotation().toRotationMatrix().transpose()),
      camera_(view.site_from_camera.origin().v) {}

std::optional<cv::Point2d> Projector::pixel(Eigen::Vector3d const& point) const {
  Eigen::Vector3d const ahead = camera_from_site_ * (point - camera_);
  if (ahead.z() < nearest_ahead_m) return std::nullopt;
  auto const pixel = geo::pixel_of(lens_, geo::Point3<geo::CameraFrame>(ahead));
  if (!pixel || std::abs(pixel->x) > farthest_px || std::abs(pixel->y) > farthest_px) return std::nullopt;
  return cv::Point2d(pixel->x - half_px, pixel->y - half_px);
}

double Projector::metres_a_pixel(Eigen::Vector3d const& point) const {
  double const ahead_m = (camera_from_site_ * (point - camera_)).z();
  return ahead_m < nearest_ahead_m ? 0.0 : ahead_m / lens_.focal_x_px;
}

bool Projector::may_show(Eigen::Vector3d const& middle, double radius_m) const {
  auto const at = pixel(middle);
  // Where the camera is among it, or the lens folds, drawing it decides.
  if (!at) return (middle - camera_).norm() < 2.0 * radius_m;
  // Lenses draw what is aside larger.
  constexpr double larger = 2.0;
  double const reach = larger * radius_m / std::max(1e-6, metres_a_pixel(middle));
  return at->x > -reach && at->y > -reach && at->x < lens_.width_px + reach && at->y < lens_.height_px + reach;
}

void Projector::fill(std::span<Eigen::Vector3d const> corners, cv::Scalar const& colour, bool is_convex) const {
  std::vector<cv::Point> points;
  points.reserve(corners.size());
  for (auto const& corner : corners) {
    auto const at = pixel(corner);
    if (!at) return;
    points.emplace_back(static_cast<int>(std::lround(at->x * parts)), static_cast<int>(std::lround(at->y * parts)));
  }
  if (is_convex)
    cv::fillConvexPoly(picture_, points, colour, cv::LINE_AA, shift);
  else
    cv::fillPoly(picture_, points, colour, cv::LINE_AA, shift);
}

void Projector::disc(Eigen::Vector3d const& middle, double radius_m, cv::Scalar const& colour) const {
  auto const at = pixel(middle);
  double const metres = metres_a_pixel(middle);
  if (!at || metres <= 0.0) return;
  double const radius_px = std::min(radius_m / metres, 4000.0);
  cv::circle(picture_, {static_cast<int>(std::lround(at->x * parts)), static_cast<int>(std::lround(at->y * parts))},
             static_cast<int>(std::lround(radius_px * parts)), colour, cv::FILLED, cv::LINE_AA, shift);
}

}  // namespace lapwing::video
