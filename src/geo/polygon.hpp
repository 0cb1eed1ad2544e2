#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geo/point.hpp"

namespace lapwing::geo {

/// A closed line; the last corner is joined to the first, which is not repeated.
template <class Frame>
using Ring = std::vector<Point<Frame>>;

/// An area on the level plane: of its rings a point is inside by the even-odd rule, so the first is the outer one and
/// the others are holes, whichever way round they go. What outsiders give is asked for its `polygon_fault` first.
template <class Frame>
struct Polygon {
  std::vector<Ring<Frame>> rings;
  friend bool operator==(Polygon const&, Polygon const&) = default;
};

namespace detail {

using PlainRing = std::vector<Eigen::Vector2d>;
[[nodiscard]] std::optional<std::string> fault_of(std::vector<PlainRing> const& rings);

/// Calls `edge(a, b)` for each pair of neighbouring corners.
template <class Frame, class Edge>
void for_each_edge(Ring<Frame> const& ring, Edge&& edge) {
  for (std::size_t i = 0; i < ring.size(); ++i) edge(ring[i], ring[(i + 1) % ring.size()]);
}

/// Twice the area that the ring goes round counterclockwise, seen from its first corner, so that places far from the
/// frame's origin lose no digits.
template <class Frame>
[[nodiscard]] double doubled_area_m2(Ring<Frame> const& ring) {
  double sum = 0.0;
  for_each_edge(ring, [&](auto const& a, auto const& b) { sum += (a - ring.front()).cross(b - ring.front()); });
  return sum;
}

}  // namespace detail

/// Seen from above; neither way for a ring without extent.
template <class Frame>
[[nodiscard]] bool is_counterclockwise(Ring<Frame> const& ring) {
  return detail::doubled_area_m2(ring) > 0.0;
}

/// Why it is no area ("its edges cross or touch each other"): fewer than three corners, numbers that are not
/// finite, rings that cross, holes outside, no extent. Nothing for a sound one. Costs n log n. (OGC Simple Features,
/// by Boost.Geometry.)
template <class Frame>
[[nodiscard]] std::optional<std::string> polygon_fault(Polygon<Frame> const& polygon) {
  std::vector<detail::PlainRing> rings;
  for (auto const& ring : polygon.rings) {
    auto& plain = rings.emplace_back();
    for (auto const& corner : ring) plain.push_back(corner.v);
  }
  return detail::fault_of(rings);
}

/// Even-odd; of points on the edge some are inside, so that areas side by side share none of them.
template <class Frame>
[[nodiscard]] bool contains(Polygon<Frame> const& polygon, Point<Frame> const& point) {
  bool is_inside = false;
  for (auto const& ring : polygon.rings) {
    detail::for_each_edge(ring, [&](auto const& a, auto const& b) {
      if ((a.y() > point.y()) == (b.y() > point.y())) return;
      double const share = (point.y() - a.y()) / (b.y() - a.y());
      if (point.x() < a.x() + share * (b.x() - a.x())) is_inside = !is_inside;
    });
  }
  return is_inside;
}

/// To the nearest edge of any ring, from inside or outside; infinite without corners.
template <class Frame>
[[nodiscard]] double distance_to_edge_m(Polygon<Frame> const& polygon, Point<Frame> const& point) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (auto const& ring : polygon.rings) {
    detail::for_each_edge(ring, [&](auto const& a, auto const& b) {
      auto const edge = b - a;
      double const square = edge.dot(edge);
      double const share = square > 0.0 ? std::clamp((point - a).dot(edge) / square, 0.0, 1.0) : 0.0;
      nearest_m = std::min(nearest_m, distance_m(point, a + share * edge));
    });
  }
  return nearest_m;
}

/// Of a sound polygon, its holes taken off.
template <class Frame>
[[nodiscard]] double area_m2(Polygon<Frame> const& polygon) {
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < polygon.rings.size(); ++i) {
    double const one_m2 = std::abs(detail::doubled_area_m2(polygon.rings[i])) / 2.0;
    area_m2 += i == 0 ? one_m2 : -one_m2;
  }
  return area_m2;
}

/// The centre of mass of a sound polygon, its holes taken off. It may lie outside.
template <class Frame>
[[nodiscard]] Point<Frame> centroid(Polygon<Frame> const& polygon) {
  auto const& origin = polygon.rings.front().front();
  Vector<Frame> moment;
  double doubled_m2 = 0.0;
  for (std::size_t i = 0; i < polygon.rings.size(); ++i) {
    auto const& ring = polygon.rings[i];
    bool const adds = (detail::doubled_area_m2(ring) > 0.0) == (i == 0);
    detail::for_each_edge(ring, [&](auto const& a, auto const& b) {
      double const part_m2 = (adds ? 1.0 : -1.0) * (a - origin).cross(b - origin);
      doubled_m2 += part_m2;
      moment = moment + ((a - origin) + (b - origin)) * (part_m2 / 3.0);
    });
  }
  return origin + moment * (1.0 / doubled_m2);
}

/// The smallest upright rectangle round points.
template <class Frame>
struct Box {
  Point<Frame> least;
  Point<Frame> most;

  [[nodiscard]] bool contains(Point<Frame> const& point) const {
    return (point.v.array() >= least.v.array()).all() && (point.v.array() <= most.v.array()).all();
  }
  [[nodiscard]] bool meets(Box const& other) const {
    return (least.v.array() <= other.most.v.array()).all() && (other.least.v.array() <= most.v.array()).all();
  }
  friend bool operator==(Box const&, Box const&) = default;
};

/// Of the outer ring. Precondition: it has a corner.
template <class Frame>
[[nodiscard]] Box<Frame> bounds(Polygon<Frame> const& polygon) {
  auto const& outer = polygon.rings.front();
  Box<Frame> box{outer.front(), outer.front()};
  for (auto const& corner : outer) {
    box.least.v = box.least.v.cwiseMin(corner.v);
    box.most.v = box.most.v.cwiseMax(corner.v);
  }
  return box;
}

}  // namespace lapwing::geo
