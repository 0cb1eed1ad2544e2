#include "sim/body/trail.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::sim {

namespace {

double distance_m(geo::Ned a, geo::Ned b) {
  return std::hypot(a.north - b.north, a.east - b.east, a.down - b.down);
}

double distance_to_line_m(geo::Ned point, geo::Ned from, geo::Ned to) {
  geo::Ned const way{to.north - from.north, to.east - from.east, to.down - from.down};
  double const squared = way.north * way.north + way.east * way.east + way.down * way.down;
  if (squared == 0.0) return distance_m(point, from);
  double const along = (point.north - from.north) * way.north + (point.east - from.east) * way.east +
                       (point.down - from.down) * way.down;
  double const part = std::clamp(along / squared, 0.0, 1.0);
  return distance_m(point, {from.north + part * way.north, from.east + part * way.east, from.down + part * way.down});
}

}  // namespace

void Trail::begin(geo::Ned here) {
  points_.assign(1, here);
  given_up_ = false;
}

bool Trail::note(geo::Ned here, Limits const& limits) {
  if (given_up_ || points_.empty() || distance_m(points_.back(), here) < limits.accuracy_m) return true;
  points_.push_back(here);
  if (points_.size() <= limits.most_points) return true;
  points_ = tidied(limits);
  // Tidying has to make room for a while, else it would be done at every point.
  given_up_ = points_.size() * 10 > limits.most_points * 9;
  return !given_up_;
}

std::vector<geo::Ned> Trail::tidied(Limits const& limits) const {
  return without_loops(straightened(points_, 0.5 * limits.accuracy_m), limits.accuracy_m);
}

std::vector<geo::Ned> straightened(std::vector<geo::Ned> const& points, double tolerance_m) {
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    auto const [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double most_m = tolerance_m;
    for (std::size_t i = first + 1; i < last; ++i) {
      double const off_m = distance_to_line_m(points[i], points[first], points[last]);
      if (off_m <= most_m) continue;
      most_m = off_m;
      farthest = i;
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<geo::Ned> rest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) rest.push_back(points[i]);
  return rest;
}

std::vector<geo::Ned> without_loops(std::vector<geo::Ned> const& points, double distance_limit_m) {
  std::vector<geo::Ned> rest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    rest.push_back(points[i]);
    // From the last moment at which the vehicle was here again the way goes on.
    for (auto later = points.size(); --later > i + 1;) {
      if (distance_m(points[i], points[later]) > distance_limit_m) continue;
      i = later;
      break;
    }
  }
  return rest;
}

}  // namespace lapwing::sim
