#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "explore/path/navigator.hpp"
#include "explore/strategy/strategy.hpp"
#include "robot/planner/company/companions.hpp"
#include "robot/planner/company/company.hpp"
#include "robot/planner/driven_track.hpp"
#include "robot/planner/held_up/progress.hpp"
#include "robot/planner/held_up/recovery.hpp"
#include "robot/planner/held_up/refusals.hpp"
#include "robot/planner/look_round.hpp"
#include "robot/planner/planning_area.hpp"
#include "robot/planner/room.hpp"
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
/// To stand where something is seen well, turned so that one of its cameras looks at it. What it is for is not worth
/// waiting long for whoever stands in the way.
struct LookErrand {
  Place from = {};
  double within_m = 0.3;  ///< as near as one can stand, where nobody can stand there
  Place at = {};
  double bearing_rad = 0.0;  ///< that the camera looks along, on the body: counterclockwise from straight ahead
};
struct ReturnErrand {};
using Errand = std::variant<std::monostate, ExploreErrand, DriveErrand, LookErrand, ReturnErrand>;

struct PlannerOptions {
  std::string id = {};  ///< of the robot among its companions
  Limits limits = {};
  double cell_m = 0.05;  ///< of the map
  double wary_m = 0.5;   ///< ways keep so far from walls where there is room
  /// It sees little at a time: where it sets out, and where it has come to, it turns round and looks.
  bool looks_round = false;
  double laser_ahead_m = 0.0;  ///< of the robot's middle; 0 where it sits behind
  double give_up_s =
      180.0;  ///< without getting on, an errand is over: an exploration with what it has, others have failed
};

/// What is known of the floor as a whole.
struct Survey {
  double free_m2 = 0.0;  ///< seen and free
  /// Seen, of what there seems to be: beside what was seen, the unknown that the open frontiers hide
  /// (explore::hidden_m2). 1 when there is none.
  double coverage = 0.0;
  std::vector<Place> frontiers = {};  ///< the middles of the open ones
};
/// "2 places are left unseen"; empty when none is.
[[nodiscard]] std::string what_is_left(Survey const& survey);

struct Plan {
  enum class State { idle, under_way, done, failed };
  State state = State::idle;
  std::string reason = {};  ///< why it failed, or what it is done without
  bool waits = false;       ///< for what its companions open: it has nothing left to explore
  Way way = {};
  std::optional<Place> goal = {};
  Intent intent = {};  ///< to be told to its companions
};

/// Plans on the map as it grows: where to go for an errand and how to get there. It keeps to cells that are known to be
/// free, a robot's radius and somewhat more than the safe distance off everything else. Pure: the same calls give the
/// same plans.
class FloorPlanner {
 public:
  explicit FloorPlanner(PlannerOptions const& options);

  /// The tiles of the grid as they are now. Where it had no room for one, it plans anew in a larger area.
  void learn(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed);
  /// Who is about something on the floor as well, as they are now. Where one of them stands in its way, or it in
  /// theirs, one makes room. While it explores, what those who explore, too, have seen need not be seen again, and
  /// frontiers are shared out among all; that is forgotten when it begins to explore anew. `grid` as above, without a
  /// change.
  void meet(std::vector<Companion> const& companions, map::OccupancyGrid const& grid);
  /// Error: invalid_input for a strategy that there is not. The errand before is dropped.
  [[nodiscard]] base::Result<> begin(Errand errand);

  struct Situation {
    slam::Pose2 pose = {};
    double driven_m = 0.0;
    double time_s = 0.0;
    explore::SideDistances sides = {};
    /// Ends of the last scan, in the map: what stands where the map says that it is free is driven around.
    std::vector<Place> seen = {};
    Room room = {};  ///< by the same scan, from the pose
    /// The way that it came, as its map has it by now.
    std::span<slam::Pose2 const> driven = {};
  };
  [[nodiscard]] Plan plan(Situation const& situation);
  /// Costs more than a plan: to be asked once a second or less.
  [[nodiscard]] Survey survey() const;
  /// The way back to its start as far as it knows one, else the straight line.
  [[nodiscard]] double home_m(Place const& from) const;

 private:
  [[nodiscard]] explore::Place on_floor(Place const& place) const { return area_.on_floor(place); }
  [[nodiscard]] Place on_map(explore::Place const& place) const { return area_.on_map(place); }
  [[nodiscard]] explore::Cell cell_at(Place const& place) const { return known_->cell_at(on_floor(place)); }
  /// On grids of the area's size on which nothing is known. What it is about it goes on with, by a new plan.
  void begin_anew();
  [[nodiscard]] std::optional<explore::Cell> standable_near(Place const& place, double within_m) const;
  [[nodiscard]] std::vector<explore::Disc> obstacles(Situation const& situation) const;
  [[nodiscard]] Plan explore(Situation const& situation, explore::Pose const& pose);
  void share(std::vector<Companion> companions, map::OccupancyGrid const& grid);
  void learn_theirs(map::OccupancyGrid const& own, std::vector<map::TileKey> const& tiles);
  [[nodiscard]] explore::Pose pose_of(Companion const& companion) const;
  void find_sharers(explore::Pose const& pose, double time_s);
  /// Of all who share the floor out, in the order of their ids, which is the same to each of them; and which is this
  /// one.
  [[nodiscard]] std::pair<std::vector<explore::RobotView>, std::size_t> views(explore::RobotView own) const;
  [[nodiscard]] std::vector<explore::Place> wanted_way(explore::Place const& here) const;
  /// Precondition: the plan is under way. Says in it what its companions are to be told; and where it is to make room
  /// itself, its way is there.
  void mind_company(Situation const& situation, explore::Pose const& pose, Plan& plan);
  [[nodiscard]] Plan wait_for_companions(Situation const& situation, explore::Pose const& pose);
  [[nodiscard]] Plan drive(Situation const& situation, explore::Pose const& pose, Place const& to, double within_m);
  [[nodiscard]] Plan look(Situation const& situation, explore::Pose const& pose, LookErrand const& looking);
  /// Before it sets out for the first time a robot that sees little stands until its gyroscope's bias is known: until
  /// it knows the building's walls it heads by nothing else. 1e-3 rad/s of noise ten times a second leave a third of a
  /// degree a minute after 15 s, and a degree after two.
  [[nodiscard]] bool stands_at_first(double time_s);
  [[nodiscard]] double give_up_s() const;
  /// For how long it has not got on with what it is about now.
  [[nodiscard]] double stalled_s(double time_s) const;
  /// What the navigator has to say of its goal.
  [[nodiscard]] Plan follow(explore::Navigator& navigator, Situation const& situation, explore::Pose const& pose);
  void learn_all(map::OccupancyGrid const& grid);
  void learn(map::OccupancyGrid const& grid, map::TileKey key);
  void learn(explore::Cell cell, explore::Knowledge knowledge);
  void learn_start(explore::Pose const& pose);
  void learn_way(Situation const& situation, explore::Pose const& pose);
  void note_progress(Situation const& situation, explore::Pose const& pose, Plan const& plan);
  [[nodiscard]] std::optional<double> left_m(explore::Pose const& pose) const;
  [[nodiscard]] std::optional<double> road_m(explore::Place const& from, explore::Cell to) const;
  [[nodiscard]] Place what_refuses(Situation const& situation) const;
  [[nodiscard]] Recovery::Now recovery_now(Situation const& situation) const;
  /// Nothing, or a way to get on again.
  [[nodiscard]] std::optional<Way> recover(Situation const& situation, Plan const& plan);
  [[nodiscard]] Plan done_exploring() const;
  [[nodiscard]] Plan given_up(Situation const& situation) const;

  PlannerOptions options_;
  PlanningArea area_;
  // Pointers, so that a planner can be moved: they refer to each other's grids.
  std::unique_ptr<explore::KnownMap> known_;
  std::unique_ptr<explore::RoadMap> roads_;
  std::unique_ptr<explore::GridSearch> search_;
  std::unique_ptr<explore::Frontiers> frontiers_;
  std::unique_ptr<explore::Frontiers> all_frontiers_;  ///< nothing is given up in these
  std::unique_ptr<explore::Strategy> strategy_;
  CompanionMaps companions_;
  std::optional<explore::DenseGrid<explore::Knowledge>> theirs_;  ///< what they have seen, where any has
  std::vector<bool> shares_;  ///< a companion: has a way to what is open to this one
  double sharers_found_s_ = 0.0;
  Company company_;
  explore::Navigator aside_;  ///< to where it makes room
  std::optional<double> waits_since_s_;
  bool learns_anew_ = false;  ///< its own map alone
  explore::Navigator navigator_;
  Errand errand_;
  explore::Order order_;
  bool is_there_ = false;  ///< where it is to look from
  std::size_t free_cells_ = 0;
  LookRound look_round_;
  std::optional<double> stands_since_s_;
  DrivenTrack track_;
  Progress progress_;
  double measured_s_ = 0.0;    ///< when progress was
  double goal_since_s_ = 0.0;  ///< of an exploration
  Refusals refusals_;
  Recovery recovery_;
  double recovered_s_ = 0.0;  ///< when it last began or ended
  bool is_recovering_ = false;
  bool is_new_ = true;  ///< the errand has not been planned yet
};

}  // namespace lapwing::robot
