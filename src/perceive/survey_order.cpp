#include "perceive/survey_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::perceive {

geo::Wgs84 anchor_of(geo::Wgs84 home, geo::Point3<geo::SiteFrame> const& in_frame) {
  return geo::displaced(home, {.north = -in_frame.y(), .east = -in_frame.x(), .down = in_frame.z()});
}

geo::Polygon<geo::SiteFrame> outline_of(std::vector<geo::Wgs84> const& corners, geo::Site const& site) {
  geo::Polygon<geo::SiteFrame> outline{{{}}};
  for (auto const& corner : corners) {
    auto const point = site.point_of(corner);
    outline.rings.front().emplace_back(point.x(), point.y());
  }
  return outline;
}

/// The convex hull (Andrew 1979) of eight places round each.
geo::Polygon<geo::SiteFrame> fence_round(std::vector<map::SitePoint> const& places, double margin_m) {
  constexpr int sides = 8;
  std::vector<Eigen::Vector2d> points;
  for (auto const& place : places) {
    for (int k = 0; k < sides; ++k) {
      double const way = 2.0 * std::numbers::pi * k / sides;
      points.emplace_back(place.v + margin_m * Eigen::Vector2d(std::cos(way), std::sin(way)));
    }
  }
  std::ranges::sort(points, {}, [](auto const& point) { return std::pair(point.x(), point.y()); });
  std::vector<Eigen::Vector2d> hull;
  auto const half = [&hull](auto const& in_order) {
    auto const begin = hull.size();
    for (auto const& point : in_order) {
      auto const bends_out = [&] {
        Eigen::Vector2d const a = hull.back() - hull[hull.size() - 2];
        Eigen::Vector2d const b = point - hull[hull.size() - 2];
        constexpr double straight = 1e-6;
        return a.x() * b.y() - a.y() * b.x() <= straight;
      };
      while (hull.size() >= begin + 2 && bends_out()) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
  };
  half(points);
  std::ranges::reverse(points);
  half(points);
  geo::Polygon<geo::SiteFrame> fence{{{}}};
  for (auto const& corner : hull) fence.rings.front().emplace_back(corner.x(), corner.y());
  return fence;
}

}  // namespace lapwing::perceive
