#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "explore/path/navigator.hpp"
#include "explore/strategy/strategy.hpp"
#include "robot/planner/way.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// What a robot is to do on the floor that it maps.
struct ExploreErrand {
  std::string strategy = "nearest";  ///< of explore::strategy_names
  friend bool operator==(ExploreErrand const&, ExploreErrand const&) = default;
};
struct DriveErrand {
  Place to = {};
  double within_m = 0.3;  ///< as near as one can stand, where nobody can stand there
};
struct ReturnErrand {};
using Errand = std::variant<std::monostate, ExploreErrand, DriveErrand, ReturnErrand>;

struct PlannerOptions {
  Limits limits = {};
  double cell_m = 0.05;     ///< of the map
  double side_m = 60.0;     ///< of the square around the start that the robot plans in
  double wary_m = 0.5;      ///< ways keep so far from walls where there is room
  double give_up_s = 60.0;  ///< without getting on, an errand has failed
};

/// What is known of the floor as a whole.
struct Survey {
  double free_m2 = 0.0;  ///< seen and free
  /// Seen, of what there seems to be: beside what was seen, the unknown within sight of the open frontiers. 1 when
  /// there is none.
  double coverage = 0.0;
  std::vector<Place> frontiers = {};  ///< the middles of the open ones
};

struct Plan {
  enum class State { idle, under_way, done, failed };
  State state = State::idle;
  std::string reason = {};  ///< why it failed
  Way way = {};
  std::optional<Place> goal = {};
};

/// Plans on the map as it grows: where to go for an errand and how to get there. It keeps to cells that are known to be
/// free, a robot's radius and somewhat more than the safe distance off everything else. Pure: the same calls give the
/// same plans.
class FloorPlanner {
 public:
  explicit FloorPlanner(PlannerOptions const& options);

  /// The tiles of the grid as they are now.
  void learn(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed);
  /// Error: invalid_input for a strategy that there is not. The errand before is dropped.
  [[nodiscard]] base::Result<> begin(Errand errand);

  struct Situation {
    slam::Pose2 pose = {};
    double driven_m = 0.0;
    double time_s = 0.0;
    explore::SideDistances sides = {};
    /// Ends of the last scan, in the map: what stands where the map says that it is free is driven around.
    std::vector<Place> seen = {};
  };
  [[nodiscard]] Plan plan(Situation const& situation);
  /// Costs more than a plan: to be asked once a second or less.
  [[nodiscard]] Survey survey(slam::Pose2 const& pose) const;

 private:
  [[nodiscard]] explore::Place on_floor(Place const& place) const;
  [[nodiscard]] Place on_map(explore::Place const& place) const;
  [[nodiscard]] explore::Cell cell_at(Place const& place) const { return known_->cell_at(on_floor(place)); }
  /// The nearest of which `fits` is true, too.
  template <class Fits>
  [[nodiscard]] std::optional<explore::Cell> standable_near(explore::Cell middle, double within_m,
                                                            Fits const& fits) const;
  [[nodiscard]] std::optional<explore::Cell> standable_near(Place const& place, double within_m) const;
  [[nodiscard]] std::vector<explore::Disc> obstacles(Situation const& situation) const;
  [[nodiscard]] Plan explore(Situation const& situation, explore::Pose const& pose);
  [[nodiscard]] Plan drive(Situation const& situation, explore::Pose const& pose, Place const& to, double within_m);
  /// What the navigator has to say of its goal.
  [[nodiscard]] Plan follow(Situation const& situation, explore::Pose const& pose);
  [[nodiscard]] Way way_into_the_open(explore::Pose const& pose) const;
  void note_standing(Situation const& situation);
  [[nodiscard]] bool is_held_up(Situation const& situation, Plan const& plan) const;
  void begin_back_off(Situation const& situation);

  /// Where something held it up that the map does not show.
  struct Bump {
    Place place = {};
    double until_s = 0.0;
  };

  PlannerOptions options_;
  double half_m_;  ///< of the square's side: what lies between the map's origin and the floor's
  // Pointers, so that a planner can be moved: they refer to each other's grids.
  std::unique_ptr<explore::KnownMap> known_;
  std::unique_ptr<explore::RoadMap> roads_;
  std::unique_ptr<explore::GridSearch> search_;
  std::unique_ptr<explore::Frontiers> frontiers_;
  std::unique_ptr<explore::Strategy> strategy_;
  explore::Navigator navigator_;
  Errand errand_;
  explore::Order order_;
  std::size_t free_cells_ = 0;
  Place stood_at_ = {};
  double stood_since_s_ = 0.0;
  bool is_new_ = true;  ///< the errand has not been planned yet
  std::vector<Bump> bumps_;
  double backs_until_s_ = 0.0;
  double back_off_yaw_ = 0.0;
  Place backed_off_at_ = {};
  int back_offs_ = 0;          ///< about that place
  int back_offs_of_goal_ = 0;  ///< of an exploration
};

}  // namespace lapwing::robot
