#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "explore/known/frontiers.hpp"
#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// Distances to what is left, in front and right of a robot, in metres (seed 001: sonars).
struct SideDistances {
  double left_m = 0.0;
  double front_m = 0.0;
  double right_m = 0.0;
};

/// A robot as a strategy sees it.
struct RobotView {
  Pose pose;
  Pose start;
  std::function<SideDistances()> sides;  ///< measured when asked for
  std::optional<Cell> goal;              ///< where it was sent
  bool has_arrived = false;              ///< there
  bool is_blocked = false;               ///< there is no way to it at the moment
  bool is_out = false;                   ///< takes no orders any more: on its way home for good, or home
  double driven_m = 0.0;
};

/// What is known when orders are given.
struct Situation {
  KnownMap const& map;
  RoadMap const& roads;
  Frontiers& frontiers;
  std::span<RobotView const> robots;
  double time_s = 0.0;
  double range_m = 10.0;  ///< how far the robots see
};

/// What a robot is to do next.
struct Order {
  enum class Kind {
    keep,   ///< what it was told before
    go,     ///< drive to `goal`
    steer,  ///< turn to `yaw_rad` and drive at `speed_m_s`, not nearer to anything than the safe distance
    home,   ///< nothing is left for it: back to its start; may be called again
  };
  Kind kind = Kind::keep;
  Cell goal = {};
  double yaw_rad = 0.0;
  double speed_m_s = 0.0;
};

/// How robots that share a map choose where to go. What it knows is the map, the robots' poses and the time: it is the
/// same on a simulated floor and in a building.
class Strategy {
 public:
  virtual ~Strategy() = default;
  Strategy() = default;
  Strategy(Strategy const&) = delete;
  Strategy& operator=(Strategy const&) = delete;

  /// An order for each robot. Asked for after every update of the map. When all get `home`, the floor is explored as
  /// far as this strategy can.
  [[nodiscard]] virtual std::vector<Order> decide(Situation const& situation) = 0;
};

/// Names that `make_strategy` takes, each with a line that says what it is.
struct StrategyName {
  std::string_view name;
  std::string_view about;
};
[[nodiscard]] std::span<StrategyName const> strategy_names();
/// Error: invalid_input for a name that there is not.
[[nodiscard]] base::Result<std::unique_ptr<Strategy>> make_strategy(std::string_view name);

}  // namespace lapwing::explore
