#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "robot/mapping/floor_map.hpp"
#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

/// All that a robot works out beside the loop: its map, and the planning on it.
struct Thoughts {
  Thoughts(slam::Sensor sensor, MappingOptions const& mapping, PlannerOptions const& planning)
      : map(std::move(sensor), mapping), planner(planning) {}
  FloorMap map;
  FloorPlanner planner;
};

struct NewErrand {
  std::uint64_t number = 0;
  Errand errand = {};
};

struct ThoughtInput {
  std::vector<slam::Scan> scans = {};  ///< in the order of time, at least one
  std::optional<NewErrand> errand = {};
  explore::SideDistances sides = {};
  double driven_m = 0.0;
  double time_s = 0.0;
  bool wants_survey = false;
};

struct ThoughtResult {
  std::unique_ptr<Thoughts> thoughts;
  Located here;
  slam::Pose2 odometry;  ///< of the scan at which it was here
  Plan plan;
  std::uint64_t errand = 0;  ///< which one the plan is for; 0: none
  std::optional<Survey> survey = {};
  std::optional<map::OccupancyGrid> grid = {};  ///< when it has changed
  std::vector<map::TileKey> changed = {};
};

/// A pure function for `Loop::on_pool`: takes the scans into the map and plans on it.
[[nodiscard]] ThoughtResult think(std::unique_ptr<Thoughts> thoughts, std::uint64_t errand, ThoughtInput input);

}  // namespace lapwing::robot
