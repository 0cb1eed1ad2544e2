#include "geo/polygon.hpp"

#include <fmt/format.h>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

namespace lapwing::geo::detail {

namespace bg = boost::geometry;

namespace {

using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint>;

std::string ring_name(std::size_t i) {
  return i == 0 ? "the outer ring" : fmt::format("hole {}", i);
}

/// What Boost cannot be given: it takes numbers as they come.
std::optional<std::string> plain_fault(std::vector<PlainRing> const& rings) {
  constexpr std::size_t fewest_corners = 3;
  if (rings.empty()) return "there is no ring";
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i].size() < fewest_corners)
      return fmt::format("{} has {} corners; it takes 3", ring_name(i), rings[i].size());
    for (std::size_t k = 0; k < rings[i].size(); ++k)
      if (!rings[i][k].allFinite()) return fmt::format("corner {} of {} is not finite", k + 1, ring_name(i));
  }
  return std::nullopt;
}

std::string words_of(bg::validity_failure_type failure) {
  switch (failure) {
    case bg::failure_spikes: return "an edge goes back on itself";
    case bg::failure_wrong_orientation:  // after `correct`: a ring that goes round as much one way as the other
    case bg::failure_self_intersections: return "its edges cross or touch each other";
    case bg::failure_interior_rings_outside: return "a hole lies outside";
    case bg::failure_nested_interior_rings: return "a hole lies in a hole";
    case bg::failure_disconnected_interior: return "its holes cut it in two";
    case bg::failure_intersecting_interiors: return "its holes overlap";
    case bg::failure_wrong_topological_dimension:
    case bg::failure_few_points: return "it has no extent";
    default: return "it is no area";
  }
}

}  // namespace

std::optional<std::string> fault_of(std::vector<PlainRing> const& rings) {
  if (auto fault = plain_fault(rings)) return fault;
  BoostPolygon polygon;
  polygon.inners().resize(rings.size() - 1);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    auto& ring = i == 0 ? polygon.outer() : polygon.inners()[i - 1];
    for (auto const& corner : rings[i]) ring.emplace_back(corner.x(), corner.y());
  }
  bg::correct(polygon);  // closes the rings and turns them the way Boost wants them
  auto failure = bg::no_failure;
  if (bg::is_valid(polygon, failure)) return std::nullopt;
  return words_of(failure);
}

}  // namespace lapwing::geo::detail
