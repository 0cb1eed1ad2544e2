#include "robot/views/way_lengths.hpp"

#include <cmath>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "robot/views/free_space.hpp"

namespace lapwing::robot {

namespace {

constexpr double step_m = 0.2;
constexpr double beside_m = 0.2;  ///< so much floor to each side, at least: a robot comes through, if only just

}  // namespace

WayLengths::Step WayLengths::step_at(map::SitePoint const& place) {
  return {static_cast<std::int32_t>(std::lround(place.x() / step_m)),
          static_cast<std::int32_t>(std::lround(place.y() / step_m))};
}

WayLengths::WayLengths(map::OccupancyGrid const& grid, map::SitePoint const& from) {
  FreeSpace const space(grid);
  auto const is_passable = [&](Step const& step) {
    map::SitePoint const middle(step.x * step_m, step.y * step_m);
    if (!space.is_free(middle)) return false;
    for (int side = 0; side < 4; ++side)
      if (!space.is_free(away(middle, side * std::numbers::pi / 2.0, beside_m))) return false;
    return true;
  };
  using Reached = std::pair<double, Step>;
  auto const later = [](Reached const& a, Reached const& b) { return a.first > b.first; };
  std::priority_queue<Reached, std::vector<Reached>, decltype(later)> next(later);
  // A robot stands where it stands, however near to a wall.
  auto const begin = step_at(from);
  metres_[begin] = 0.0;
  next.emplace(0.0, begin);
  while (!next.empty()) {
    auto const [metres, at] = next.top();
    next.pop();
    if (metres > metres_[at]) continue;
    for (std::int32_t x = -1; x <= 1; ++x) {
      for (std::int32_t y = -1; y <= 1; ++y) {
        Step const to{at.x + x, at.y + y};
        double const so_far = metres + step_m * std::hypot(x, y);
        auto const known = metres_.find(to);
        if (known != metres_.end() && known->second <= so_far) continue;
        if (known == metres_.end() && !is_passable(to)) continue;
        metres_[to] = so_far;
        next.emplace(so_far, to);
      }
    }
  }
}

std::optional<double> WayLengths::to(map::SitePoint const& place) const {
  auto const at = step_at(place);
  std::optional<double> least;
  for (std::int32_t x = -1; x <= 1; ++x) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      auto const found = metres_.find({at.x + x, at.y + y});
      if (found == metres_.end()) continue;
      double const metres = found->second + step_m * std::hypot(x, y);
      if (!least || metres < *least) least = metres;
    }
  }
  return least;
}

}  // namespace lapwing::robot
