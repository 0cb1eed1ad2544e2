#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "explore/known/frontiers.hpp"
#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"
#include "explore/lead/giving_way.hpp"
#include "explore/path/grid_search.hpp"
#include "explore/path/motion.hpp"
#include "explore/path/navigator.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

struct ExplorerSettings {
  std::string strategy = "nearest";
  CarrierLimits carrier;
  double range_m = 10.0;  ///< how far the robots see
  double energy_m = 0.0;  ///< how far each robot can drive on its battery; 0: any way
  bool does_return = true;
};

/// What is known of a robot at a moment.
struct RobotNow {
  Pose pose;
  double driven_m = 0.0;                      ///< since it began
  std::function<SideDistances()> sides = {};  ///< measured when asked for; only the right-hand rule asks
};

/// Leads robots that share a map until the floor is explored and they are back where they started: asks a strategy
/// where to go, finds the ways, makes robots give way to one another, minds batteries and says when it is over. What it
/// gets is the map, the poses and the time, what it gives are motions: the floor may be simulated or a real one.
class Explorer {
 public:
  /// With a strategy of one's own; the name in the settings does not matter then.
  Explorer(KnownMap const& map, ExplorerSettings const& settings, std::span<Pose const> starts,
           std::unique_ptr<Strategy> strategy);
  /// Error: invalid_input where there is no strategy of that name.
  [[nodiscard]] static base::Result<Explorer> begin(KnownMap const& map, ExplorerSettings const& settings,
                                                    std::span<Pose const> starts);

  /// To be called after each update of the map, twice a second or so: decides and plans. `map` is always the same.
  /// `moving`: people and whatever else moves and is no robot of these. A `RobotNow` a start, in that order.
  void update(KnownMap& map, double time_s, std::span<RobotNow const> robots, std::span<Disc const> moving);
  /// What a robot is to do now, from where it is now; to be asked as often as the carrier likes between updates.
  [[nodiscard]] Motion motion(KnownMap const& map, std::size_t robot, Pose const& pose);

  /// Nothing open is left that the strategy wants to see or can reach.
  [[nodiscard]] bool is_explored() const { return is_explored_; }
  [[nodiscard]] bool is_home(std::size_t robot) const;
  /// Explored, and all are back.
  [[nodiscard]] bool is_over() const;
  /// Nothing was new for an hour, and so all were called home: whatever the strategy still wanted, it did not get.
  [[nodiscard]] bool has_no_news() const { return has_no_news_; }
  /// No robot has moved on for ten minutes, or not all have come home within an hour.
  [[nodiscard]] bool is_stuck() const { return is_stuck_; }
  /// A robot turned back because of its battery.
  [[nodiscard]] bool is_any_low() const;
  /// What the robot was told last.
  [[nodiscard]] Order const& order(std::size_t robot) const { return members_[robot].order; }
  /// The next metres of its way.
  [[nodiscard]] std::vector<Cell> const& path(std::size_t robot) const { return members_[robot].navigator.path(); }
  /// Calls the robot home for good (an operator's wish).
  void call_home(KnownMap const& map, std::size_t robot);

 private:
  struct Member {
    Pose start;
    Navigator navigator;
    Pose pose;
    double driven_m = 0.0;
    std::function<SideDistances()> sides = {};
    Order order = {};
    bool is_out = false;
    bool is_low = false;         ///< out because of its battery
    Place stood_at = {};         ///< where it was seen not to move on,
    double stood_since_s = 0.0;  ///< and since when
    double ordered_s = 0.0;      ///< when it was last told something new
    bool is_blocked = false;
    bool is_aside = false;  ///< makes room for another
  };

  void mind_standing();
  void mind_news(KnownMap const& map);
  void mind_energy(KnownMap const& map);
  void give_orders(KnownMap const& map);
  void make_room(KnownMap const& map);
  void plan_ways(KnownMap const& map, std::span<Disc const> moving);
  void follow(KnownMap const& map, Member& member, Order const& order);
  [[nodiscard]] std::vector<RobotView> views() const;
  /// Where it wants to go on for the next metres, as if it were alone; empty when it does not.
  [[nodiscard]] std::vector<Place> way_of(KnownMap const& map, Member const& member) const;
  [[nodiscard]] std::optional<Cell> home_of(KnownMap const& map, Member const& member) const;

  ExplorerSettings settings_;
  std::unique_ptr<Strategy> strategy_;
  RoadMap roads_;
  GridSearch search_;
  Frontiers frontiers_;
  std::vector<Member> members_;
  GivingWay giving_way_;
  double time_s_ = 0.0;
  std::uint64_t discovered_ = 0;
  double news_at_s_ = 0.0;
  bool has_no_news_ = false;
  bool is_explored_ = false;
  bool is_stuck_ = false;
};

}  // namespace lapwing::explore
