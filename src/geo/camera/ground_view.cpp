#include "geo/camera/ground_view.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/SVD>

namespace lapwing::geo {

namespace {

constexpr int points_a_side = 16;

std::optional<Vector3<SiteFrame>> ray_into_site(GroundView const& view, Pixel const& pixel) {
  auto const ray = ray_of(view.lens, pixel);
  if (!ray) return std::nullopt;
  return view.site_from_camera * *ray;
}

/// Along the ray until it is so far below the camera.
Point<SiteFrame> foot_of(Point3<SiteFrame> const& from, Vector3<SiteFrame> const& ray, double height_m) {
  double const share = height_m / -ray.z();
  return {from.x() + share * ray.x(), from.y() + share * ray.y()};
}

/// Along the border of the picture, from the upper left corner clockwise.
std::vector<Pixel> border_of(Lens const& lens) {
  double const width = lens.width_px;
  double const height = lens.height_px;
  std::array<Pixel, 4> const corners = {{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}};
  std::vector<Pixel> border;
  for (std::size_t side = 0; side < corners.size(); ++side) {
    auto const& from = corners[side];
    auto const& to = corners[(side + 1) % corners.size()];
    for (int i = 0; i < points_a_side; ++i) {
      double const share = static_cast<double>(i) / points_a_side;
      border.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
  }
  return border;
}

}  // namespace

CameraPlace camera_at(Point3<SiteFrame> const& position, double yaw_rad, double tilt_rad, double roll_rad) {
  // Looking down with the upper edge east, x (right) is south, y (down in the picture) west and z (ahead) down.
  Eigen::Matrix3d down;
  down << 0.0, -1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  Eigen::Quaterniond const rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(down) *
                                      Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX()) *
                                      Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
  return {position, rotation};
}

std::optional<Point<SiteFrame>> ground_at(GroundView const& view, Pixel const& pixel) {
  auto const ray = ray_into_site(view, pixel);
  if (!ray || ray->z() >= 0.0 || view.height_m() <= 0.0) return std::nullopt;
  auto ground = foot_of(view.site_from_camera.origin(), *ray, view.height_m());
  if (!ground.is_finite()) return std::nullopt;
  return ground;
}

std::optional<Point3<SiteFrame>> ground_at(GroundView const& view, Pixel const& pixel, GroundHeight const& ground,
                                           double farthest_m, double step_m) {
  auto const ray = ray_into_site(view, pixel);
  if (!ray) return std::nullopt;
  auto const way = *ray * (1.0 / ray->length());
  auto const from = view.site_from_camera.origin();
  auto const at = [&](double along_m) { return from + way * along_m; };
  auto const is_below = [&](Point3<SiteFrame> const& place) { return place.z() <= ground({place.x(), place.y()}); };
  if (is_below(from)) return std::nullopt;
  for (double along_m = step_m; along_m <= farthest_m; along_m += step_m) {
    if (!is_below(at(along_m))) continue;
    double above_m = along_m - step_m;
    double below_m = along_m;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
      double const middle_m = 0.5 * (above_m + below_m);
      (is_below(at(middle_m)) ? below_m : above_m) = middle_m;
    }
    return at(below_m);
  }
  return std::nullopt;
}

std::optional<Pixel> seen_at(GroundView const& view, Point<SiteFrame> const& ground) {
  if (view.height_m() <= 0.0) return std::nullopt;
  auto const place = view.site_from_camera.inverse() * Point3<SiteFrame>(ground.x(), ground.y(), view.ground_up_m);
  auto const pixel = pixel_of(view.lens, place);
  if (!pixel || !view.lens.contains(*pixel)) return std::nullopt;
  return pixel;
}

std::optional<std::array<Point<SiteFrame>, 4>> footprint_corners(GroundView const& view) {
  double const width = view.lens.width_px;
  double const height = view.lens.height_px;
  std::array<Pixel, 4> const pixels = {{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}};
  std::array<Point<SiteFrame>, 4> corners;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    auto const ground = ground_at(view, pixels[i]);
    if (!ground) return std::nullopt;
    corners[i] = *ground;
  }
  return corners;
}

Ring<SiteFrame> footprint(GroundView const& view, double farthest_m) {
  Ring<SiteFrame> outline;
  double const height_m = view.height_m();
  if (!(height_m > 0.0) || !(farthest_m > 0.0)) return outline;
  auto const from = view.site_from_camera.origin();
  // Rays that sink by less than this for each metre ahead meet the ground too far away, or never.
  double const least_sink = height_m / farthest_m;
  auto const excess = [&](Vector3<SiteFrame> const& ray) {
    return -ray.z() - least_sink * std::hypot(ray.x(), ray.y());
  };
  auto const border = border_of(view.lens);
  std::optional<Vector3<SiteFrame>> before = ray_into_site(view, border.back());
  for (auto const& pixel : border) {
    auto const ray = ray_into_site(view, pixel);
    if (ray && before && (excess(*ray) > 0.0) != (excess(*before) > 0.0)) {
      auto seen = excess(*ray) > 0.0 ? *ray : *before;
      auto unseen = excess(*ray) > 0.0 ? *before : *ray;
      constexpr int halvings = 40;
      for (int i = 0; i < halvings; ++i) {
        auto const middle = (seen + unseen) * 0.5;
        (excess(middle) > 0.0 ? seen : unseen) = middle;
      }
      outline.push_back(foot_of(from, seen, height_m));
    }
    if (ray && excess(*ray) > 0.0) outline.push_back(foot_of(from, *ray, height_m));
    before = ray;
  }
  constexpr std::size_t fewest_corners = 3;
  if (outline.size() < fewest_corners) outline.clear();
  return outline;
}

std::optional<GroundSampling> ground_sampling(GroundView const& view, Pixel const& pixel) {
  constexpr double half_px = 0.5;
  auto const right = ground_at(view, {pixel.x + half_px, pixel.y});
  auto const left = ground_at(view, {pixel.x - half_px, pixel.y});
  auto const lower = ground_at(view, {pixel.x, pixel.y + half_px});
  auto const upper = ground_at(view, {pixel.x, pixel.y - half_px});
  if (!right || !left || !lower || !upper) return std::nullopt;
  Eigen::Matrix2d a_pixel;
  a_pixel << (*right - *left).v, (*lower - *upper).v;
  auto const stretch = Eigen::JacobiSVD<Eigen::Matrix2d>(a_pixel).singularValues();
  return GroundSampling{.finest_m = stretch[1], .coarsest_m = stretch[0]};
}

}  // namespace lapwing::geo
