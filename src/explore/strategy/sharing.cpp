#include "explore/strategy/sharing.hpp"

#include <algorithm>
#include <limits>

namespace lapwing::explore {

std::vector<std::vector<std::size_t>> shared_out(std::span<TourCosts const> robots, std::vector<std::size_t> places) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::size_t>> given(robots.size());
  std::vector<double> length(robots.size(), 0.0);
  while (!places.empty()) {
    std::size_t best_place = 0;
    std::size_t best_robot = 0;
    double least = infinity;
    for (std::size_t robot = 0; robot < robots.size(); ++robot) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        double added = robots[robot].from_start[places[i]];
        for (auto const other : given[robot]) added = std::min(added, robots[robot].between[other][places[i]]);
        if (length[robot] + added >= least) continue;
        least = length[robot] + added;
        best_place = i;
        best_robot = robot;
      }
    }
    if (least == infinity) break;
    length[best_robot] = least;
    given[best_robot].push_back(places[best_place]);
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(best_place));
  }
  return given;
}

}  // namespace lapwing::explore
