#include "video/scene/vehicle_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace lapwing::video {

namespace {

using Outline = std::vector<Eigen::Vector2d>;  // counterclockwise; x ahead, y to the left
using Corners = std::vector<Eigen::Vector3d>;

constexpr Colour glass_colour = {0.133, 0.149, 0.173};
constexpr double floor_m = 0.2;
/// Light comes back from the ground to sides that the sun does not reach.
constexpr double darkest_side = 0.5;

/// A rectangle whose corners are cut: by `nose` ahead, by `tail` behind.
Outline rounded(double rear, double front, double half, double nose, double tail) {
  return {{front, -half + nose},      {front, half - nose},        {front - 0.8 * nose, half - 0.25 * nose},
          {front - 2.2 * nose, half}, {rear + 1.6 * tail, half},   {rear + 0.5 * tail, half - 0.3 * tail},
          {rear, half - tail},        {rear, -half + tail},        {rear + 0.5 * tail, -half + 0.3 * tail},
          {rear + 1.6 * tail, -half}, {front - 2.2 * nose, -half}, {front - 0.8 * nose, -half + 0.25 * nose}};
}

/// A vehicle's measures, and its own frame.
class Shape {
 public:
  explicit Shape(Vehicle const& vehicle)
      : look_(vehicle.look),
        at_(vehicle.at.v),
        cos_(std::cos(vehicle.heading_rad)),
        sin_(std::sin(vehicle.heading_rad)) {}

  [[nodiscard]] Eigen::Vector3d placed(double x, double y, double z) const {
    return {at_.x() + x * cos_ - y * sin_, at_.y() + x * sin_ + y * cos_, z};
  }
  [[nodiscard]] Corners placed(Outline const& outline, double z) const {
    Corners corners;
    corners.reserve(outline.size());
    for (auto const& point : outline) corners.push_back(placed(point.x(), point.y(), z));
    return corners;
  }
  /// Metres from the middle of what is a share of its length from its tail.
  [[nodiscard]] double along(double share) const { return (share - 0.5) * look_.length_m; }
  [[nodiscard]] double half() const { return 0.5 * look_.width_m; }
  [[nodiscard]] double belt_m() const {
    bool const is_high = look_.kind->is_box || look_.kind->name == "pickup";
    return is_high ? 1.05 : std::min(0.95, 0.62 * look_.height_m);
  }
  [[nodiscard]] Outline body() const {
    return rounded(along(0.0), along(1.0), half(), look_.kind->is_box ? 0.16 : 0.32, look_.kind->is_box ? 0.06 : 0.2);
  }
  [[nodiscard]] Outline cabin() const {
    return look_.kind->is_box
               ? rounded(along(0.01), along(0.82), half(), 0.1, 0.06)
               : rounded(along(look_.kind->cabin[0]), along(look_.kind->cabin[1]), 0.94 * half(), 0.2, 0.12);
  }
  [[nodiscard]] Outline roof() const {
    return rounded(along(look_.kind->roof[0]), along(look_.kind->roof[1]), half() * (look_.kind->is_box ? 0.92 : 0.76),
                   0.12, 0.1);
  }
  [[nodiscard]] VehicleLook const& look() const { return look_; }

 private:
  VehicleLook const& look_;
  Eigen::Vector2d at_;
  double cos_;
  double sin_;
};

/// Draws the parts of one vehicle.
class Brush {
 public:
  Brush(Projector const& projector, Sun const& sun, double light) : projector_(projector), sun_(sun), light_(light) {}

  void level(Corners const& corners, Colour const& colour, double factor) const {
    projector_.fill(corners, bgr(colour, factor * sun_.brightness * light_));
  }
  /// Those sides between two outlines that look at the camera.
  void sides(Corners const& low, Corners const& high, Colour const& colour, double least) const {
    for (std::size_t i = 0; i < low.size(); ++i) {
      auto const next = (i + 1) % low.size();
      std::array<Eigen::Vector3d, 4> const face = {low[i], low[next], high[next], high[i]};
      Eigen::Vector3d const normal = (face[1] - face[0]).cross(face[3] - face[0]).normalized();
      if (normal.dot(projector_.camera() - face[0]) <= 0.0) continue;
      projector_.fill(face, bgr(colour, light_ * std::clamp(sun_.on(normal), least, 1.25)));
    }
  }

 private:
  Projector const& projector_;
  Sun const& sun_;
  double light_;
};

void draw_small_things(Brush const& brush, Shape const& shape) {
  auto const& paint = shape.look().paint;
  double const half = shape.half();
  double const z = shape.belt_m();
  double const mirror = shape.along(shape.look().kind->cabin[1] - 0.05);
  for (double const side : {-1.0, 1.0}) {
    brush.level({shape.placed(mirror, side * half, z), shape.placed(mirror + 0.16, side * half, z),
                 shape.placed(mirror + 0.12, side * (half + 0.18), z), shape.placed(mirror, side * (half + 0.18), z)},
                paint, 0.7);
    brush.level({shape.placed(shape.along(0.985), side * 0.55 * half, z),
                 shape.placed(shape.along(0.975), side * 0.85 * half, z),
                 shape.placed(shape.along(0.945), side * 0.9 * half, z)},
                {0.84, 0.84, 0.82}, 1.0);
    brush.level({shape.placed(shape.along(0.012), side * 0.6 * half, z),
                 shape.placed(shape.along(0.012), side * 0.88 * half, z),
                 shape.placed(shape.along(0.032), side * 0.9 * half, z)},
                {0.47, 0.08, 0.08}, 1.0);
  }
}

void draw_wheels(Projector const& projector, Shape const& shape) {
  constexpr double radius_m = 0.33;
  for (double const side : {-1.0, 1.0}) {
    Eigen::Vector3d const normal = shape.placed(0.0, side, 0.0) - shape.placed(0.0, 0.0, 0.0);
    if (normal.dot(projector.camera() - shape.placed(0.0, side * shape.half(), radius_m)) <= 0.0) continue;
    for (double const at : {shape.along(0.19), shape.along(0.81)}) {
      std::array<Eigen::Vector3d, 6> wheel;
      for (std::size_t i = 0; i < wheel.size(); ++i) {
        double const angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(wheel.size());
        wheel[i] = shape.placed(at + radius_m * std::cos(angle), side * (shape.half() - 0.01),
                                radius_m + radius_m * std::sin(angle));
      }
      projector.fill(wheel, cv::Scalar(26, 25, 24));
    }
  }
}

void draw_body(Projector const& projector, Brush const& brush, Shape const& shape) {
  auto const& paint = shape.look().paint;
  auto const body = shape.body();
  double const z = shape.belt_m();
  brush.sides(shape.placed(body, floor_m), shape.placed(body, z), paint, darkest_side);
  draw_wheels(projector, shape);
  brush.level(shape.placed(body, z), paint, 0.88);
  auto const bonnet =
      rounded(shape.along(shape.look().kind->cabin[1]) - 0.1, shape.along(0.965), 0.74 * shape.half(), 0.2, 0.05);
  brush.level(shape.placed(bonnet, z), paint, 1.0);
  draw_small_things(brush, shape);
  if (shape.look().kind->name != "pickup") return;
  double const wide = 0.78 * shape.half();
  Outline const bed = {
      {shape.along(0.03), -wide}, {shape.along(0.37), -wide}, {shape.along(0.37), wide}, {shape.along(0.03), wide}};
  brush.level(shape.placed(bed, z - 0.05), {0.18, 0.18, 0.19}, 1.0);
}

/// The panes ahead and behind, the brighter one towards the sun; and the pillars between them.
void draw_panes(Brush const& brush, Shape const& shape, Sun const& sun) {
  auto const& kind = *shape.look().kind;
  double const low = shape.belt_m() + 0.04;
  double const high = shape.look().height_m - 0.04;
  double const half = shape.half();
  Eigen::Vector3d const ahead = shape.placed(1.0, 0.0, 0.0) - shape.placed(0.0, 0.0, 0.0);
  bool const sun_is_ahead = ahead.dot(sun.towards) > 0.0;
  for (bool const is_front : {true, false}) {
    double const foot = shape.along(is_front ? kind.cabin[1] - 0.01 : kind.cabin[0] + 0.01);
    double const head = shape.along(is_front ? kind.roof[1] : kind.roof[0]);
    double const bright = shape.look().glass * (is_front == sun_is_ahead ? 1.7 : 1.0);
    brush.level({shape.placed(foot, -0.62 * half, low), shape.placed(foot, 0.62 * half, low),
                 shape.placed(head, 0.56 * half, high), shape.placed(head, -0.56 * half, high)},
                glass_colour, bright);
    for (double const side : {-1.0, 1.0})
      brush.level({shape.placed(foot, side * 0.82 * half, low), shape.placed(foot, side * 0.9 * half, low),
                   shape.placed(head, side * 0.72 * half, high), shape.placed(head, side * 0.66 * half, high)},
                  shape.look().paint, 0.8);
  }
}

void draw_roof(Brush const& brush, Shape const& shape) {
  auto const& look = shape.look();
  auto const [tail, nose] = look.kind->roof;
  double const half = shape.half();
  brush.level(shape.placed(shape.roof(), look.height_m), look.paint, 1.0);
  brush.level(shape.placed(rounded(shape.along(tail + 0.04), shape.along(nose - 0.03), 0.55 * half, 0.08, 0.08),
                           look.height_m + 0.03),
              look.paint, 1.07);
  if (look.has_skylight && !look.kind->is_box) {
    double const at = nose - 0.09;
    Outline const pane = {{shape.along(at - 0.1), -0.42 * half},
                          {shape.along(at), -0.42 * half},
                          {shape.along(at), 0.42 * half},
                          {shape.along(at - 0.1), 0.42 * half}};
    brush.level(shape.placed(pane, look.height_m + 0.03), glass_colour, look.glass);
  }
  if (!look.has_rails) return;
  for (double const side : {-1.0, 1.0}) {
    Outline const rail = {{shape.along(tail + 0.05), side * 0.6 * half},
                          {shape.along(nose - 0.05), side * 0.6 * half},
                          {shape.along(nose - 0.05), side * 0.66 * half},
                          {shape.along(tail + 0.05), side * 0.66 * half}};
    brush.level(shape.placed(rail, look.height_m + 0.05), {0.2, 0.2, 0.2}, 1.0);
  }
}

void draw_cabin(Brush const& brush, Shape const& shape, Sun const& sun) {
  auto const& look = shape.look();
  auto const low = shape.placed(shape.cabin(), shape.belt_m());
  auto const high = shape.placed(shape.roof(), look.height_m);
  if (look.kind->is_box) {
    brush.sides(low, high, look.paint, darkest_side);
    double const half = shape.half();
    brush.level({shape.placed(shape.along(0.805), -0.84 * half, look.height_m - 0.15),
                 shape.placed(shape.along(0.805), 0.84 * half, look.height_m - 0.15),
                 shape.placed(shape.along(0.9), 0.9 * half, shape.belt_m()),
                 shape.placed(shape.along(0.9), -0.9 * half, shape.belt_m())},
                glass_colour, look.glass);
  } else {
    brush.sides(low, high, glass_colour * look.glass, 0.7);
    draw_panes(brush, shape, sun);
  }
  draw_roof(brush, shape);
}

}  // namespace

cv::Scalar bgr(Colour const& colour, double factor) {
  auto const value = [factor](double part) { return std::clamp(255.0 * part * factor, 0.0, 255.0); };
  return {value(colour.blue), value(colour.green), value(colour.red)};
}

void draw_vehicle(Projector const& projector, Vehicle const& vehicle, Sun const& sun, double light) {
  Shape const shape(vehicle);
  Brush const brush(projector, sun, light);
  draw_body(projector, brush, shape);
  draw_cabin(brush, shape, sun);
}

std::vector<Eigen::Vector3d> vehicle_foot(Vehicle const& vehicle) {
  Shape const shape(vehicle);
  return shape.placed(shape.body(), 0.0);
}

std::vector<Eigen::Vector3d> vehicle_shadow(Vehicle const& vehicle, Sun const& sun) {
  Shape const shape(vehicle);
  std::vector<cv::Point2f> fallen;
  auto const cast = [&](Corners const& corners) {
    for (auto const& corner : corners) {
      Eigen::Vector2d const foot = (sun.shadow_of(corner) - shape.placed(0.0, 0.0, 0.0)).head<2>();
      fallen.emplace_back(static_cast<float>(foot.x()), static_cast<float>(foot.y()));
    }
  };
  cast(shape.placed(shape.body(), floor_m));
  cast(shape.placed(shape.body(), shape.belt_m()));
  cast(shape.placed(shape.roof(), shape.look().height_m));
  std::vector<cv::Point2f> hull;
  cv::convexHull(fallen, hull);
  Corners corners;
  for (auto const& point : hull)
    corners.push_back(shape.placed(0.0, 0.0, 0.0) + Eigen::Vector3d(point.x, point.y, 0.0));
  return corners;
}

}  // namespace lapwing::video
