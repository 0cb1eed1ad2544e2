#include "explore/strategy/right_hand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::explore {

namespace {

constexpr double right_angle = std::numbers::pi / 2.0;
constexpr double turned_rad = 0.1;
constexpr double against_something_s = 3.0;  ///< not moving for so long, there is a wall ahead that the sensors miss
constexpr double entrance_m = 1.5;           ///< of a side hall, from where it was seen
constexpr double entrance_radius_m = 2.5;

double off(double yaw_a, double yaw_b) {
  return std::abs(geo::wrap_pi(yaw_a - yaw_b));
}

}  // namespace

RightHand::Turn RightHand::turn_for(bool is_right_wall, bool is_front_wall, bool is_left_wall) {
  if (is_right_wall) {
    if (!is_front_wall) return {.quarters = 0, .pushes_left = !is_left_wall};  // cases 1 and 2
    return {.quarters = 1};                                                    // 3 and 4
  }
  return {.quarters = -1, .pushes_left = !is_left_wall, .pushes_ahead = !is_front_wall};  // 5 to 8
}

void RightHand::push(Pose const& hall) {
  bool const is_known = std::ranges::any_of(pushed_, [&](Pose const& other) {
    return distance_m(hall.position, other.position) < settings_.same_hall_m &&
           off(hall.yaw_rad, other.yaw_rad) < settings_.same_hall_rad;
  });
  if (is_known) return;
  pushed_.push_back(hall);
  halls_.push_back(hall);
}

bool RightHand::is_open(KnownMap const& map, Pose const& hall) const {
  auto const entrance = hall.position + entrance_m * Shift(std::cos(hall.yaw_rad), std::sin(hall.yaw_rad));
  return std::ranges::any_of(map.frontier_cells(), [&](std::uint32_t index) {
    return distance_m(map.middle(map.cell_of(index)), entrance) < entrance_radius_m;
  });
}

bool RightHand::has_closed_loop(RobotView const& view, Robot& robot) const {
  constexpr double trail_step_m = 0.5;
  double const least_loop_m = 4.0 * settings_.loop_m;
  auto const is_again = [&](Robot::Passed const& passed) {
    return view.driven_m - passed.driven_m > least_loop_m &&
           distance_m(view.pose.position, passed.pose.position) < settings_.loop_m &&
           off(view.pose.yaw_rad, passed.pose.yaw_rad) < settings_.loop_rad;
  };
  if (robot.trail.empty() || view.driven_m - robot.trail.back().driven_m > trail_step_m)
    robot.trail.push_back({view.pose, view.driven_m});
  if (is_again(robot.trail.front())) return true;
  // A loop need not come by where it began: the first wall may have been a way to another.
  bool const is_round = std::ranges::any_of(
      robot.trail, [&](Robot::Passed const& passed) { return passed.driven_m >= robot.news_at_m && is_again(passed); });
  return is_round || view.driven_m - robot.news_at_m > settings_.idle_m;
}

void RightHand::begin_following(Situation const& situation, RobotView const& view, Robot& robot, double yaw_rad) const {
  robot.mode = Robot::Mode::following;
  robot.opening.reset();
  robot.base_yaw_rad = yaw_rad;
  robot.is_turning = true;
  robot.right_seen_at_m = view.driven_m;
  robot.news_at_m = view.driven_m;
  robot.trail.assign(1, {{view.pose.position, yaw_rad}, view.driven_m});
  robot.moved_at_s = situation.time_s;
  robot.driven_m = view.driven_m;
}

double RightHand::shift_for(SideDistances const& sides) const {
  // The distances of P1.0 are kept where there is room for them; else the middle is.
  bool const is_narrow = sides.right_m < settings_.near_m && sides.left_m < settings_.near_m;
  bool const is_right_near = is_narrow ? sides.right_m < sides.left_m - settings_.even_m
                                       : sides.right_m < settings_.near_m ||
                                             (sides.right_m < settings_.pictures_m && sides.left_m > sides.right_m);
  if (is_right_near) return settings_.shift_rad;
  bool const is_left_near = is_narrow ? sides.left_m < sides.right_m - settings_.even_m
                                      : sides.left_m < settings_.near_m && sides.left_m < sides.right_m;
  return is_left_near ? -settings_.shift_rad : 0.0;
}

Order RightHand::follow(Situation const& situation, RobotView const& view, Robot& robot) {
  auto const steer = [&](double yaw_rad, double speed_m_s) {
    return Order{.kind = Order::Kind::steer, .yaw_rad = geo::wrap_pi(yaw_rad), .speed_m_s = speed_m_s};
  };
  if (robot.is_turning && off(view.pose.yaw_rad, robot.base_yaw_rad) > turned_rad)
    return steer(robot.base_yaw_rad, 0.0);
  if (robot.is_turning) robot.moved_at_s = situation.time_s;
  robot.is_turning = false;
  if (view.driven_m > robot.driven_m + 0.02) {
    robot.driven_m = view.driven_m;
    robot.moved_at_s = situation.time_s;
  }
  auto const sides = view.sides();
  bool const is_right_near = sides.right_m < settings_.side_wall_m;
  if (is_right_near) robot.right_seen_at_m = view.driven_m;
  bool const is_right_wall = is_right_near || view.driven_m - robot.right_seen_at_m < settings_.lost_m;
  bool const is_against = situation.time_s - robot.moved_at_s > against_something_s;
  bool const is_front_wall = is_against || sides.front_m < settings_.front_wall_m;
  auto const turn = turn_for(is_right_wall, is_front_wall, sides.left_m < settings_.side_wall_m);
  if (turn.pushes_left) push({view.pose.position, geo::wrap_pi(robot.base_yaw_rad + right_angle)});
  if (turn.pushes_ahead) push({view.pose.position, robot.base_yaw_rad});
  // A hall that it drives into is none to come back to.
  std::erase_if(halls_, [&](Pose const& hall) {
    return distance_m(hall.position, view.pose.position) < settings_.same_hall_m &&
           off(hall.yaw_rad, robot.base_yaw_rad + turn.quarters * right_angle) < settings_.same_hall_rad;
  });
  if (turn.quarters != 0) {
    robot.base_yaw_rad = geo::wrap_pi(robot.base_yaw_rad + turn.quarters * right_angle);
    robot.is_turning = true;
    robot.right_seen_at_m = view.driven_m;
    return steer(robot.base_yaw_rad, 0.0);
  }
  return steer(robot.base_yaw_rad + shift_for(sides), 0.3);
}

Order RightHand::next_hall(Situation const& situation, RobotView const& view, Robot& robot) {
  std::erase_if(halls_, [&](Pose const& hall) { return !is_open(situation.map, hall); });
  auto const root = situation.roads.node_near(situation.map.cell_at(view.pose.position));
  // Somebody stands so near that there is no way anywhere: that is no reason to end.
  if (!root) return {};
  robot.mode = Robot::Mode::done;
  auto const tree = situation.roads.from(*root);
  float nearest = RoadMap::unreachable;
  for (auto const& hall : halls_) {
    auto const node = situation.roads.node_near(situation.map.cell_at(hall.position));
    if (!node || tree.distance_m[*node] >= nearest) continue;
    nearest = tree.distance_m[*node];
    robot.hall = hall;
    robot.mode = Robot::Mode::to_hall;
  }
  robot.opening.reset();
  if (robot.mode != Robot::Mode::to_hall) return next_opening(situation, tree, robot);
  std::erase(halls_, robot.hall);
  auto const cell = situation.map.cell_at(robot.hall.position);
  auto const node = situation.roads.node_near(cell);
  return {.kind = Order::Kind::go, .goal = situation.map.is_standable(cell) ? cell : situation.roads.place_of(*node)};
}

Order RightHand::next_opening(Situation const& situation, RoadMap::Tree const& tree, Robot& robot) const {
  auto open = situation.frontiers.find(situation.map, situation.roads, tree);
  std::erase_if(open, [&](Frontier const& frontier) {
    return std::ranges::any_of(robots_, [&](Robot const& other) {
      return &other != &robot && other.opening &&
             length_of(other.opening->middle - frontier.middle) * situation.map.cell_m() < settings_.same_hall_m;
    });
  });
  auto const next =
      std::ranges::min_element(open, {}, [&](Frontier const& frontier) { return tree.distance_m[frontier.node]; });
  if (next == open.end()) return {.kind = Order::Kind::home};
  robot.mode = Robot::Mode::to_hall;
  robot.opening = std::move(*next);
  auto const way = situation.map.middle(robot.opening->middle) - situation.map.middle(robot.opening->stand);
  robot.hall = {situation.map.middle(robot.opening->stand), std::atan2(way.y(), way.x())};
  return {.kind = Order::Kind::go, .goal = robot.opening->stand};
}

void RightHand::note_news(KnownMap const& map, RobotView const& view, Robot& robot) const {
  auto const discovered = map.discovered();
  double const new_m2 = static_cast<double>(discovered - robot.discovered) * map.cell_m() * map.cell_m();
  if (new_m2 < settings_.news_m2) return;
  robot.discovered = discovered;
  robot.news_at_m = view.driven_m;
}

Order RightHand::on_the_way(Situation const& situation, RobotView const& view, Robot& robot) {
  bool const is_there = view.has_arrived || view.is_blocked;
  bool const is_gone = robot.opening && !Frontiers::is_open(situation.map, *robot.opening);
  if (is_there && robot.opening && !is_gone) {
    if (view.has_arrived)
      situation.frontiers.give_up(situation.map, *robot.opening);
    else
      situation.frontiers.put_off(situation.map, *robot.opening);
  }
  if (is_gone || (is_there && robot.opening) || view.is_blocked) return next_hall(situation, view, robot);
  if (!is_there) return {};
  begin_following(situation, view, robot, robot.hall.yaw_rad);
  return follow(situation, view, robot);
}

Order RightHand::order_for(Situation const& situation, RobotView const& view, Robot& robot) {
  if (view.is_out) return {};
  switch (robot.mode) {
    case Robot::Mode::following:
      return has_closed_loop(view, robot) || view.is_blocked ? next_hall(situation, view, robot)
                                                             : follow(situation, view, robot);
    case Robot::Mode::to_hall: return on_the_way(situation, view, robot);
    case Robot::Mode::done: break;
  }
  // Others may have shown more since, or gone out of the way.
  bool const is_more_to_come = robots_.size() > 1 || situation.frontiers.is_any_put_off(situation.map);
  return is_more_to_come ? next_hall(situation, view, robot) : Order{.kind = Order::Kind::home};
}

std::vector<Order> RightHand::decide(Situation const& situation) {
  robots_.resize(situation.robots.size());
  std::vector<Order> orders;
  for (std::size_t i = 0; i < situation.robots.size(); ++i) {
    auto const& view = situation.robots[i];
    auto& robot = robots_[i];
    if (!robot.has_begun) {
      begin_following(situation, view, robot, view.pose.yaw_rad);
      robot.has_begun = true;
    }
    note_news(situation.map, view, robot);
    orders.push_back(order_for(situation, view, robot));
  }
  return orders;
}

}  // namespace lapwing::explore
