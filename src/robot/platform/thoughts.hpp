#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "robot/mapping/floor_map.hpp"
#include "robot/mapping/other_robots.hpp"
#include "robot/mapping/wall_book.hpp"
#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

/// All that a robot works out beside the loop: its map, and the planning on it.
struct Thoughts {
  Thoughts(slam::Sensor sensor, MappingOptions const& mapping, PlannerOptions const& planning)
      : map(std::move(sensor), mapping), planner(for_sensor(planning, map.sensor())) {}
  FloorMap map;
  FloorPlanner planner;
  WallBook walls;
  Room room;  ///< by the last scan

 private:
  [[nodiscard]] static PlannerOptions for_sensor(PlannerOptions planning, slam::Sensor const& sensor) {
    planning.looks_round = planning.looks_round || slam::is_sparse(sensor);
    planning.laser_ahead_m = std::max(0.0, double{sensor.mount_m.x()});
    return planning;
  }
};

struct NewErrand {
  std::uint64_t number = 0;
  Errand errand = {};
};

/// What mapping has made of some scans, and planning goes on with.
struct MapResult {
  std::unique_ptr<Thoughts> thoughts;
  Located here;
  slam::Pose2 odometry;  ///< of the scan at which it was here
  /// How little the scan fits the map there: see `misfit`. Nothing where too little of what it shows is known.
  std::optional<double> misfit = {};
  std::vector<Place> seen = {};                 ///< the ends of its beams, in the map
  std::optional<map::OccupancyGrid> grid = {};  ///< when it has changed
  std::vector<map::TileKey> changed = {};
  std::vector<MapShift> shifts = {};  ///< how the map has moved
};

struct PlanInput {
  std::optional<NewErrand> errand = {};
  explore::SideDistances sides = {};
  double driven_m = 0.0;
  double time_s = 0.0;
  std::optional<std::vector<Companion>> companions = {};  ///< when they are asked for
  bool wants_survey = false;
  bool wants_walls = false;  ///< which costs more than all the rest
  bool may_align = false;    ///< no alignment is under way
  bool aligns_soon = false;  ///< for a reason, however little is new
};

struct PlanResult {
  MapResult map;
  Plan plan;
  std::uint64_t errand = 0;  ///< which one the plan is for; 0: none
  std::optional<Survey> survey = {};
  std::optional<double> home_m = {};  ///< the way back to its start; with the survey
  std::optional<WallBook::Changes> walls = {};
  std::unique_ptr<slam::JointAlignment> alignment = {};  ///< that has begun; what comes of it is for `take_in`
};

struct MapInput {
  std::vector<slam::Scan> scans;  ///< in the order of time, at least one
  /// What has come of an alignment; nothing if none has ended.
  std::vector<slam::Pose2> aligned = {};
  std::vector<OtherRobot> others = {};  ///< on its map, which shows none of them
};

/// A pure function for `Loop::on_pool`: takes the scans into the map.
[[nodiscard]] MapResult take_in(std::unique_ptr<Thoughts> thoughts, MapInput input);
/// The same: plans on what has come of that. `errand`: the one that the planner has.
[[nodiscard]] PlanResult plan_on(MapResult map, std::uint64_t errand, PlanInput input);
/// The same: a piece of it, short enough not to hold up mapping. Precondition: not done.
[[nodiscard]] std::unique_ptr<slam::JointAlignment> go_on_aligning(std::unique_ptr<slam::JointAlignment> alignment);

}  // namespace lapwing::robot
