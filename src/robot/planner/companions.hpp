#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "explore/known/known_map.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "robot/planner/planning_area.hpp"
#include "slam/pose2.hpp"

namespace lapwing::robot {

/// Another robot that explores the same floor at the same time.
struct Companion {
  std::string id = {};
  map::OccupancyGrid grid;  ///< what it has mapped, in its own frame
  slam::Pose2 origin = {};  ///< of that frame in ours, as those say who have put the two down
  slam::Pose2 pose = {};    ///< where it is, in its own frame
  bool waits = false;       ///< nothing is left for it: it goes on when something opens
  bool explores = true;     ///< still
};

/// What companions have seen of the floor, looked up in their own maps: where this robot has seen nothing itself, that
/// counts. Their maps are as true as where they are said to have begun, so what this one sees comes first.
class CompanionMaps {
 public:
  /// All who explore now. The last that was heard of others stays.
  void take(std::vector<Companion> companions);
  /// What they showed of a floor that is explored anew counts no more.
  void clear();

  [[nodiscard]] std::span<Companion const> all() const { return companions_; }
  /// The tiles of our map under those of theirs that are new since this was last asked, in their order.
  [[nodiscard]] std::vector<map::TileKey> take_changes();
  /// All tiles of our map under theirs, in their order.
  [[nodiscard]] std::vector<map::TileKey> tiles() const;
  [[nodiscard]] explore::Knowledge at(Place const& place) const;

 private:
  [[nodiscard]] static std::vector<map::TileKey> under(Companion const& companion, map::TileKey key);
  std::vector<Companion> companions_;  ///< in the order of their ids
  std::vector<slam::Turn> turns_;      ///< of their origins
  /// The tiles as they were when changes were last asked for; of each companion, by its id.
  std::map<std::string, map::OccupancyGrid::Tiles> known_;
};

}  // namespace lapwing::robot
