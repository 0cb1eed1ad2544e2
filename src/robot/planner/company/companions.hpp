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

/// What a robot is about to do, as it tells those beside it; in its own frame.
struct Intent {
  /// Where it wants to go on for the next metres, as if nobody else were there; empty: it is where it wants to be.
  std::vector<Place> way = {};
  double stood_s = 0.0;                    ///< so long it has not got on
  std::map<std::string, Place> asks = {};  ///< whom it asks to make room, by their ids, and where to go for that
};

/// Another robot that is about something on the same floor at the same time.
struct Companion {
  std::string id = {};
  map::OccupancyGrid grid;  ///< what it has mapped, in its own frame
  slam::Pose2 origin = {};  ///< of that frame in ours, as those say who have put the two down
  slam::Pose2 pose = {};    ///< where it is, in its own frame
  Intent intent = {};
  bool waits = false;    ///< nothing is left for it: it goes on when something opens
  bool explores = true;  ///< and does not only drive somewhere
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
