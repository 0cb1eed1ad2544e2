#include "explore/lot/lot_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lapwing::explore {

std::optional<Corners> on_ground(geo::GroundView const& view, std::array<geo::Pixel, 4> const& corners,
                                 double farthest_m) {
  Corners outline;
  auto const camera = view.site_from_camera.origin();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto const ground = geo::ground_at(view, corners[i]);
    if (!ground || geo::distance_m(*ground, {camera.x(), camera.y()}) > farthest_m) return std::nullopt;
    outline[i] = *ground;
  }
  return outline;
}

double ground_doubt_m(LotSight const& sight, map::SitePoint const& ground) {
  auto const camera = sight.view.site_from_camera.origin();
  double const height_m = std::max(sight.view.height_m(), 0.1);
  double const away_m = geo::distance_m(ground, {camera.x(), camera.y()});
  double const by_tilt_m = sight.doubt.angle_rad * (height_m * height_m + away_m * away_m) / height_m;
  double const aside_m = std::hypot(sight.doubt.heading_rad, sight.doubt.height_m / height_m) * away_m;
  return std::hypot(sight.doubt.position_m, by_tilt_m, aside_m);
}

map::SitePoint middle_of(Corners const& corners) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (auto const& corner : corners) sum += corner.v;
  return map::SitePoint(Eigen::Vector2d(sum / static_cast<double>(corners.size())));
}

namespace {

/// The mean of two opposite sides, as an arrow.
Eigen::Vector2d side_of(Corners const& corners, std::size_t first) {
  return 0.5 *
         (corners[(first + 1) % 4].v - corners[first].v + corners[(first + 2) % 4].v - corners[(first + 3) % 4].v);
}

}  // namespace

Sides sides_of(Corners const& corners) {
  double const a = side_of(corners, 0).norm();
  double const b = side_of(corners, 1).norm();
  return {.width_m = std::min(a, b), .length_m = std::max(a, b)};
}

double axis_of(Corners const& corners) {
  auto const a = side_of(corners, 0);
  auto const b = side_of(corners, 1);
  auto const& along = a.norm() > b.norm() ? a : b;
  double const angle = std::atan2(along.y(), along.x());
  return angle < 0.0 ? angle + std::numbers::pi : std::fmod(angle, std::numbers::pi);
}

double between_axes(double a_rad, double b_rad) {
  double const apart = std::fmod(std::abs(a_rad - b_rad), std::numbers::pi);
  return std::min(apart, std::numbers::pi - apart);
}

double inside_by_m(Corners const& corners, map::SitePoint const& place) {
  auto const middle = middle_of(corners);
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto const edge = corners[(i + 1) % 4] - corners[i];
    double const length_m = edge.length();
    if (length_m <= 0.0) continue;
    double const side = edge.cross(middle - corners[i]) < 0.0 ? -1.0 : 1.0;
    least_m = std::min(least_m, side * edge.cross(place - corners[i]) / length_m);
  }
  return least_m;
}

Corners aligned(Corners const& corners, Corners const& like) {
  Corners best = corners;
  double least = std::numeric_limits<double>::infinity();
  for (bool const turns_back : {false, true}) {
    for (std::size_t first = 0; first < 4; ++first) {
      Corners tried;
      double sum = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        tried[i] = corners[turns_back ? (first + 4 - i) % 4 : (first + i) % 4];
        sum += (tried[i] - like[i]).dot(tried[i] - like[i]);
      }
      if (sum < least) {
        least = sum;
        best = tried;
      }
    }
  }
  return best;
}

}  // namespace lapwing::explore
