#pragma once

#include <optional>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"
#include "explore/path/grid_search.hpp"
#include "explore/path/motion.hpp"

namespace lapwing::explore {

/// What a navigator plans on.
struct Roads {
  KnownMap const& map;
  RoadMap const& graph;
  GridSearch& search;
};

/// Brings one robot to a cell: a way over the road map, drawn exactly for the next metres only, and along it by pure
/// pursuit (Coulter 1992) of the farthest point that lies in a straight line over standable cells.
class Navigator {
 public:
  explicit Navigator(CarrierLimits const& limits) : limits_(limits) {}

  enum class State { idle, driving, arrived, blocked };

  void go_to(Cell goal);
  void stop();
  [[nodiscard]] std::optional<Cell> goal() const { return goal_; }
  [[nodiscard]] State state() const { return state_; }

  /// Where not to go through: other robots, people. To be told whenever they moved; looked at when a path is made.
  void plan(Roads roads, Pose const& pose, std::vector<Disc> const& closed) { plan(roads, pose, closed, closed); }
  /// `closed_far`: where not to lead the way over the road map. A disc that leaves a gap beside it closes a whole part
  /// of that; what is drawn exactly goes through.
  void plan(Roads roads, Pose const& pose, std::vector<Disc> const& closed, std::vector<Disc> const& closed_far);
  /// Another path to the same goal, though the one that there is still seems good.
  void replan() { path_.clear(); }
  /// What to do now. To be asked at each step; plans only in `plan`.
  [[nodiscard]] Motion steer(KnownMap const& map, Pose const& pose, double speed_m_s);
  /// The next metres.
  [[nodiscard]] std::vector<Cell> const& path() const { return path_; }

 private:
  [[nodiscard]] bool is_path_good(KnownMap const& map, Pose const& pose, std::vector<Disc> const& closed) const;
  [[nodiscard]] std::vector<Cell> next_path(Roads roads, Cell from, std::vector<Disc> const& closed,
                                            std::vector<Disc> const& closed_far) const;

  CarrierLimits limits_;
  std::optional<Cell> goal_;
  State state_ = State::idle;
  std::vector<Cell> path_;
  std::size_t at_ = 0;  ///< of the path, what has been passed
};

}  // namespace lapwing::explore
