#include "explore/strategy/known_floor.hpp"

#include <algorithm>

#include "explore/strategy/watchman.hpp"

namespace lapwing::explore {

KnownFloor::KnownFloor(TrueFloor floor, Place const& start) {
  RoadMap roads(floor.map);
  roads.update(floor.map, floor.map.take_changes());
  auto const root = roads.node_near(floor.map.cell_at(start));
  if (!root) return;
  auto const route = watchman_route(floor.map, roads, floor.is_wanted, *root, {.range_m = floor.range_m});
  planned_m_ = route.length_m;
  for (auto const node : route.nodes) way_.push_back(roads.place_of(node));
}

std::vector<Order> KnownFloor::decide(Situation const& situation) {
  auto const& robot = situation.robots.front();
  double const cell_m = situation.map.cell_m();
  auto const here = situation.map.cell_at(robot.pose.position);
  constexpr double passed_m = 0.5;
  while (at_ < way_.size() && (length_of(way_[at_] - here) * cell_m < passed_m || robot.is_blocked ||
                               (robot.has_arrived && !situation.map.is_standable(way_[at_]))))
    ++at_;
  // As far along the way as the robot's own map goes already; noise may have drawn a wall where the way is.
  constexpr std::size_t most_ahead = 8;
  while (at_ < way_.size() && !situation.roads.node_near(way_[at_])) ++at_;
  if (at_ == way_.size()) return rest_.decide(situation);
  auto goal = at_;
  for (auto i = at_; i < std::min(at_ + most_ahead, way_.size()) && situation.map.is_standable(way_[i]); ++i) goal = i;
  if (!situation.map.is_standable(way_[goal]))
    return {{.kind = Order::Kind::go, .goal = situation.roads.place_of(*situation.roads.node_near(way_[goal]))}};
  return {{.kind = Order::Kind::go, .goal = way_[goal]}};
}

}  // namespace lapwing::explore
