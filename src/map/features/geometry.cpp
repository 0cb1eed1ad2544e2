#include "map/features/geometry.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lapwing::map {

namespace {

/// What a look at each point finds; `of` tells in words which points these are.
std::optional<std::string> points_fault(std::span<SitePoint const> points, std::string_view of) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto const& point = points[i];
    if (!point.is_finite()) return fmt::format("point {} of {} is no number", i + 1, of);
    if (point.v.cwiseAbs().maxCoeff() > farthest_m)
      return fmt::format("point {} of {} lies {:.0f} km from the site's anchor; the map of a site ends at {:.0f} km",
                         i + 1, of, point.v.norm() / 1000.0, farthest_m / 1000.0);
  }
  return std::nullopt;
}

std::optional<std::string> too_many(std::size_t count, std::size_t most) {
  if (count <= most) return std::nullopt;
  return fmt::format("it has {} points; at most {} are taken", count, most);
}

/// Of how many pairs of edges the spans along an axis overlap. Costs n log n.
std::size_t overlaps(SitePolygon const& polygon, int axis) {
  std::vector<std::pair<double, double>> spans;
  for (auto const& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      spans.emplace_back(std::minmax({ring[i].v[axis], ring[(i + 1) % ring.size()].v[axis]}));
  std::ranges::sort(spans);
  std::size_t count = 0;
  for (auto span = spans.begin(); span != spans.end(); ++span) {
    auto const beyond = std::upper_bound(span, spans.end(), span->second,
                                         [](double most, auto const& other) { return most < other.first; });
    count += static_cast<std::size_t>(beyond - span) - 1;
  }
  return count;
}

/// Whether looking for crossing edges would take too long: it compares those whose boxes overlap, which in a comb that
/// lies aslant are all with all. A million comparisons take a tenth of a second; every polygon with less than 1,400
/// corners needs fewer, and a coastline of 10,000, too.
bool is_tangled(SitePolygon const& polygon) {
  constexpr std::size_t most_comparisons = 1'000'000;
  return std::min(overlaps(polygon, 0), overlaps(polygon, 1)) > most_comparisons;
}

std::optional<std::string> fault(SitePoint const& point) {
  return points_fault({&point, 1}, "the place");
}

std::optional<std::string> fault(LineString const& line) {
  if (line.points.size() < 2) return fmt::format("a line takes two points, and this has {}", line.points.size());
  if (auto many = too_many(line.points.size(), most_points)) return many;
  return points_fault(line.points, "the line");
}

std::optional<std::string> fault(SitePolygon const& polygon) {
  std::size_t corners = polygon.rings.size();  // empty rings cost something, too
  for (auto const& ring : polygon.rings) corners += ring.size();
  if (auto many = too_many(corners, most_corners)) return many;
  for (std::size_t i = 0; i < polygon.rings.size(); ++i)
    if (auto wrong = points_fault(polygon.rings[i], i == 0 ? "the outer ring" : fmt::format("hole {}", i)))
      return wrong;
  if (is_tangled(polygon)) return "its edges lie too close together to be examined; simplify it or cut it in several";
  return geo::polygon_fault(polygon);
}

SiteBox box_of(std::span<SitePoint const> points) {
  SiteBox box{points.front(), points.front()};
  for (auto const& point : points) {
    box.least.v = box.least.v.cwiseMin(point.v);
    box.most.v = box.most.v.cwiseMax(point.v);
  }
  return box;
}

struct Bounds {
  SiteBox operator()(SitePoint const& point) const { return {point, point}; }
  SiteBox operator()(LineString const& line) const { return box_of(line.points); }
  SiteBox operator()(SitePolygon const& polygon) const { return geo::bounds(polygon); }
};

struct Count {
  std::size_t operator()(SitePoint const& /*point*/) const { return 1; }
  std::size_t operator()(LineString const& line) const { return line.points.size(); }
  std::size_t operator()(SitePolygon const& polygon) const {
    std::size_t count = 0;
    for (auto const& ring : polygon.rings) count += ring.size();
    return count;
  }
};

}  // namespace

std::optional<std::string> geometry_fault(Geometry const& geometry) {
  return std::visit([](auto const& shape) { return fault(shape); }, geometry);
}

SiteBox bounds(Geometry const& geometry) {
  return std::visit(Bounds(), geometry);
}

std::size_t point_count(Geometry const& geometry) {
  return std::visit(Count(), geometry);
}

}  // namespace lapwing::map
