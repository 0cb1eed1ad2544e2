#pragma once

#include <cstdint>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// A short way over a known floor from which a laser sees so much of what is wanted.
struct WatchmanRoute {
  std::vector<RoadMap::Node> nodes;  ///< from the start on
  double length_m = 0.0;
  double seen = 0.0;  ///< share of what is wanted
};

struct WatchmanSettings {
  double range_m = 10.0;
  double enough = 0.99;    ///< share of what can be seen that is to be seen
  double target_m = 0.25;  ///< side of the squares that what is wanted is counted in
  int rounds = 6;          ///< of making it shorter
};

[[nodiscard]] WatchmanRoute watchman_route(KnownMap const& map, RoadMap const& roads,
                                           DenseGrid<std::uint8_t> const& is_wanted, RoadMap::Node start,
                                           WatchmanSettings const& settings = {});

}  // namespace lapwing::explore
