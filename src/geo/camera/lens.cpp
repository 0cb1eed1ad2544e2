#include "geo/camera/lens.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

namespace lapwing::geo {

namespace {

constexpr double nearest_ahead_m = 1e-9;

/// A place on the plane z = 1, and how it moves when the place that it is bent from does.
struct Bent {
  Eigen::Vector2d place;
  Eigen::Matrix2d slope;
};

Bent bend(Lens const& lens, Eigen::Vector2d const& at) {
  double const x = at.x();
  double const y = at.y();
  double const r2 = at.squaredNorm();
  double const radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  double const radial_by_r2 = lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3);
  Eigen::Vector2d const aside(2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
                              lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y);
  Eigen::Matrix2d slope = radial * Eigen::Matrix2d::Identity() + 2.0 * radial_by_r2 * at * at.transpose();
  slope(0, 0) += 2.0 * lens.p1 * y + 6.0 * lens.p2 * x;
  slope(0, 1) += 2.0 * lens.p1 * x + 2.0 * lens.p2 * y;
  slope(1, 0) += 2.0 * lens.p1 * x + 2.0 * lens.p2 * y;
  slope(1, 1) += 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  return {radial * at + aside, slope};
}

/// From the middle out to `r2` what lies farther out is drawn farther out.
bool is_before_fold(Lens const& lens, double r2) {
  constexpr int steps = 16;
  for (int i = 1; i <= steps; ++i) {
    double const s = r2 * i / steps;
    if (1.0 + s * (3.0 * lens.k1 + s * (5.0 * lens.k2 + s * 7.0 * lens.k3)) <= 0.0) return false;
  }
  return true;
}

}  // namespace

Lens pinhole(int width_px, int height_px, double across_rad) {
  double const focal_px = width_px / 2.0 / std::tan(across_rad / 2.0);
  return {.width_px = width_px,
          .height_px = height_px,
          .focal_x_px = focal_px,
          .focal_y_px = focal_px,
          .middle = {width_px / 2.0, height_px / 2.0}};
}

std::optional<std::string> lens_fault(Lens const& lens) {
  constexpr int most_px = 100'000;
  if (lens.width_px < 1 || lens.height_px < 1 || lens.width_px > most_px || lens.height_px > most_px)
    return fmt::format("its picture has {} by {} pixels", lens.width_px, lens.height_px);
  for (double const focal_px : {lens.focal_x_px, lens.focal_y_px})
    if (!(focal_px > 0.0) || !std::isfinite(focal_px)) return fmt::format("its focal length is {} px", focal_px);
  for (double const number : {lens.middle.x, lens.middle.y, lens.k1, lens.k2, lens.k3, lens.p1, lens.p2})
    if (!std::isfinite(number)) return "one of its numbers is not finite";
  double const width = lens.width_px;
  double const height = lens.height_px;
  for (auto const& corner : {Pixel{0.0, 0.0}, Pixel{width, 0.0}, Pixel{width, height}, Pixel{0.0, height}})
    if (!ray_of(lens, corner))
      return fmt::format("no direction is drawn in the corner ({}, {}) of its picture: its coefficients fold it",
                         corner.x, corner.y);
  return std::nullopt;
}

std::optional<Vector3<CameraFrame>> ray_of(Lens const& lens, Pixel const& pixel) {
  Eigen::Vector2d const drawn((pixel.x - lens.middle.x) / lens.focal_x_px, (pixel.y - lens.middle.y) / lens.focal_y_px);
  if (!drawn.allFinite()) return std::nullopt;
  Eigen::Vector2d at = drawn;
  constexpr int most_steps = 50;
  constexpr double close_enough = 1e-13;
  for (int i = 0; i < most_steps; ++i) {
    auto const bent = bend(lens, at);
    Eigen::Vector2d const off = drawn - bent.place;
    if (off.norm() <= close_enough * (1.0 + drawn.norm())) {
      if (!is_before_fold(lens, at.squaredNorm())) return std::nullopt;
      return Vector3<CameraFrame>(at.x(), at.y(), 1.0);
    }
    Eigen::Vector2d const step = bent.slope.inverse() * off;
    if (!step.allFinite()) return std::nullopt;
    // Longer steps would leap over the fold.
    constexpr double longest = 0.5;
    at += step.norm() > longest ? Eigen::Vector2d(step.normalized() * longest) : step;
  }
  return std::nullopt;
}

std::optional<Pixel> pixel_of(Lens const& lens, Point3<CameraFrame> const& place) {
  if (!place.is_finite() || place.z() < nearest_ahead_m) return std::nullopt;
  Eigen::Vector2d const at(place.x() / place.z(), place.y() / place.z());
  if (!is_before_fold(lens, at.squaredNorm())) return std::nullopt;
  auto const drawn = bend(lens, at).place;
  return Pixel{lens.middle.x + lens.focal_x_px * drawn.x(), lens.middle.y + lens.focal_y_px * drawn.y()};
}

}  // namespace lapwing::geo
