#include "sim/building/picture/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::sim::building {

namespace {

using Vector = Eigen::Vector3d;

/// Nearer than this is inside the lens.
constexpr double nearest_m = 0.03;
/// A polygon gets at most one corner more where it is cut.
constexpr std::size_t most_cut_corners = Surface::most_corners + 1;

}  // namespace

View view_of(CameraPose const& pose, CameraSettings const& settings, int parts) {
  double const cos_yaw = std::cos(pose.yaw_rad);
  double const sin_yaw = std::sin(pose.yaw_rad);
  double const cos_pitch = std::cos(pose.pitch_rad);
  double const sin_pitch = std::sin(pose.pitch_rad);
  return {.at = pose.at,
          .right = {sin_yaw, -cos_yaw, 0.0},
          .down = {sin_pitch * cos_yaw, sin_pitch * sin_yaw, -cos_pitch},
          .forward = {cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch},
          .focal_px = settings.focal_px() * parts,
          .width = settings.width * parts,
          .height = settings.height * parts};
}

Visibility::Visibility(View const& view)
    : view_(view),
      nearness_(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), 0.0F),
      numbers_(nearness_.size(), nothing) {}

void Visibility::draw(Surface const& surface, std::uint32_t number) {
  double const plane = surface.normal.dot(surface.corners[0] - view_.at);
  if (plane >= 0.0) return;
  std::array<Vector, Surface::most_corners> seen;  // right, down, forward
  auto const count = static_cast<std::size_t>(surface.corner_count);
  for (std::size_t i = 0; i < count; ++i) {
    Vector const to = surface.corners[i] - view_.at;
    seen[i] = {to.dot(view_.right), to.dot(view_.down), to.dot(view_.forward)};
  }
  std::array<Eigen::Vector2d, most_cut_corners> corners;
  std::size_t kept = 0;
  auto const keep = [&](Vector const& point) {
    corners[kept++] = {view_.width / 2.0 + view_.focal_px * point.x() / point.z(),
                       view_.height / 2.0 + view_.focal_px * point.y() / point.z()};
  };
  for (std::size_t i = 0; i < count; ++i) {
    auto const& a = seen[i];
    auto const& b = seen[(i + 1) % count];
    if (a.z() >= nearest_m) keep(a);
    if ((a.z() >= nearest_m) != (b.z() >= nearest_m)) keep(a + (nearest_m - a.z()) / (b.z() - a.z()) * (b - a));
  }
  if (kept < 3) return;
  // The plane's equation along a ray gives one over the distance.
  Vector const normal(surface.normal.dot(view_.right), surface.normal.dot(view_.down),
                      surface.normal.dot(view_.forward));
  Vector const slope = normal / plane;
  double const a_column = slope.x() / view_.focal_px;
  double const a_row = slope.y() / view_.focal_px;
  fill(std::span(corners).first(kept),
       {.at_corner = slope.z() + (0.5 - view_.width / 2.0) * a_column + (0.5 - view_.height / 2.0) * a_row,
        .a_column = a_column,
        .a_row = a_row},
       number);
}

void Visibility::fill(std::span<Eigen::Vector2d const> corners, Nearness const& nearness, std::uint32_t number) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (auto const& corner : corners) {
    lowest = std::min(lowest, corner.y());
    highest = std::max(highest, corner.y());
  }
  int const first = static_cast<int>(std::ceil(std::clamp(lowest, 0.0, 1.0 * view_.height) - 0.5));
  int const last = static_cast<int>(std::ceil(std::clamp(highest, 0.0, 1.0 * view_.height) - 0.5)) - 1;
  for (int y = std::max(first, 0); y <= std::min(last, view_.height - 1); ++y) {
    double const middle = y + 0.5;
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      auto const& a = corners[i];
      auto const& b = corners[(i + 1) % corners.size()];
      if ((a.y() <= middle) == (b.y() <= middle)) continue;
      double const x = a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (left <= right) fill_row(y, left, right, nearness, number);
  }
}

void Visibility::fill_row(int y, double from_x, double to_x, Nearness const& nearness, std::uint32_t number) {
  int const first = static_cast<int>(std::ceil(std::clamp(from_x, 0.0, 1.0 * view_.width) - 0.5));
  int const end = static_cast<int>(std::ceil(std::clamp(to_x, 0.0, 1.0 * view_.width) - 0.5));
  double const in_row = nearness.at_corner + nearness.a_row * y;
  auto const row = static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width);
  for (int x = std::max(first, 0); x < end; ++x) {
    auto const near = static_cast<float>(in_row + nearness.a_column * x);
    auto& nearest = nearness_[row + static_cast<std::size_t>(x)];
    if (near <= nearest) continue;
    nearest = near;
    numbers_[row + static_cast<std::size_t>(x)] = number;
  }
}

}  // namespace lapwing::sim::building
