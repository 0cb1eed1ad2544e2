#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "map/features/geometry.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::robot {

/// How far it is for a robot from one place to others, round the walls of its map: over free floor, in steps of two
/// decimetres to eight sides (Dijkstra 1959). Up to 8 % longer than the shortest way: good for choosing where to drive,
/// not for driving.
class WayLengths {
 public:
  WayLengths(map::OccupancyGrid const& grid, map::SitePoint const& from);

  /// Nothing: the map knows no way there.
  [[nodiscard]] std::optional<double> to(map::SitePoint const& place) const;

 private:
  struct Step {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend bool operator==(Step const&, Step const&) = default;
  };
  struct Hash {
    std::size_t operator()(Step const& step) const {
      return static_cast<std::size_t>(step.x) * 0x9e3779b97f4a7c15U + static_cast<std::size_t>(step.y);
    }
  };
  [[nodiscard]] static Step step_at(map::SitePoint const& place);

  std::unordered_map<Step, double, Hash> metres_;
};

}  // namespace lapwing::robot
