#pragma once

#include <optional>
#include <vector>

#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

struct RightHandSettings {
  double side_wall_m = 2.5;   ///< nearer than this there is a wall beside,
  double front_wall_m = 2.0;  ///< and this ahead
  double near_m = 1.0;        ///< distance kept to walls,
  double pictures_m = 1.5;    ///< and to the right one, for pictures, where there is more room to the left
  double even_m = 0.1;        ///< the middle is where both sides differ by less
  double shift_rad = 0.2618;  ///< 15 degrees
  double lost_m = 1.0;        ///< the wall that is followed is lost for so long before it counts as free
  double same_hall_m = 1.0;
  double same_hall_rad = 0.5236;
  double loop_m = 1.0;       ///< a loop closes within this and
  double loop_rad = 0.3491;  ///< 20 degrees of its start
  double idle_m = 15.0;      ///< driven so far without news, a loop brings none
  double news_m2 = 0.5;      ///< less than this, newly seen, is none
};

/// The right-hand rule of seed 001: eight cases of what is free to the right, ahead and to the left (P3.0), distances
/// kept on the way (P1.0), side halls kept for later. It ends when none of them is open; what the map shows as open and
/// the side sensors passed by unseen is a side hall, too. It always ends: no hall is pushed twice, a wall is left where
/// it was followed before and nothing was new since, and an opening that stays open is given up.
class RightHand : public Strategy {
 public:
  explicit RightHand(RightHandSettings const& settings = {}) : settings_(settings) {}
  [[nodiscard]] std::vector<Order> decide(Situation const& situation) override;

  struct Turn {
    int quarters = 0;  ///< to the left; 0: forward
    bool pushes_left = false;
    bool pushes_ahead = false;
  };
  /// The table of P3.0.
  [[nodiscard]] static Turn turn_for(bool is_right_wall, bool is_front_wall, bool is_left_wall);
  /// To the left, to keep the distances of P1.0.
  [[nodiscard]] double shift_for(SideDistances const& sides) const;

 private:
  struct Robot {
    enum class Mode { following, to_hall, done } mode = Mode::following;
    bool has_begun = false;
    double base_yaw_rad = 0.0;  ///< of the hall that is driven along
    bool is_turning = false;
    double right_seen_at_m = 0.0;  ///< driven when the right wall was last seen
    double news_at_m = 0.0;        ///< driven when the map last brought news
    std::uint64_t discovered = 0;  ///< of the map, then
    struct Passed {
      Pose pose;
      double driven_m = 0.0;
    };
    std::vector<Passed> trail;  ///< since the wall was taken up
    double moved_at_s = 0.0;
    double driven_m = 0.0;
    Pose hall;  ///< that is driven to
    std::optional<Frontier> opening;
  };

  [[nodiscard]] Order follow(Situation const& situation, RobotView const& view, Robot& robot);
  [[nodiscard]] Order next_hall(Situation const& situation, RobotView const& view, Robot& robot);
  /// Of what the map shows and the sensors at the sides did not.
  [[nodiscard]] Order next_opening(Situation const& situation, RoadMap::Tree const& tree, Robot& robot) const;
  [[nodiscard]] Order on_the_way(Situation const& situation, RobotView const& view, Robot& robot);
  [[nodiscard]] Order order_for(Situation const& situation, RobotView const& view, Robot& robot);
  void note_news(KnownMap const& map, RobotView const& view, Robot& robot) const;
  [[nodiscard]] bool has_closed_loop(RobotView const& view, Robot& robot) const;
  [[nodiscard]] bool is_open(KnownMap const& map, Pose const& hall) const;
  void push(Pose const& hall);
  void begin_following(Situation const& situation, RobotView const& view, Robot& robot, double yaw_rad) const;

  RightHandSettings settings_;
  std::vector<Robot> robots_;
  std::vector<Pose> halls_;   ///< Q
  std::vector<Pose> pushed_;  ///< all that ever were in it: none is twice
};

}  // namespace lapwing::explore
