#include "explore/strategy/nearest_frontier.hpp"

#include <algorithm>

namespace lapwing::explore {

namespace {

constexpr double look_every_s = 3.0;

}  // namespace

std::vector<Order> NearestFrontier::decide(Situation const& situation) {
  auto const& robots = situation.robots;
  chosen_.resize(robots.size());
  std::vector<Order> orders(robots.size());
  bool is_due = situation.time_s >= next_look_s_;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!chosen_[i] || robots[i].is_out) continue;
    if ((robots[i].has_arrived || robots[i].is_blocked) && Frontiers::is_open(situation.map, *chosen_[i])) {
      if (robots[i].has_arrived)
        situation.frontiers.give_up(situation.map, *chosen_[i]);
      else
        situation.frontiers.put_off(situation.map, *chosen_[i]);
      chosen_[i].reset();
      is_due = true;
    } else if (robots[i].has_arrived) {
      is_due = true;
    }
  }
  if (!is_due) return orders;
  next_look_s_ = situation.time_s + look_every_s;
  std::vector<Frontier> open;
  bool is_open_known = false;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].is_out) continue;
    auto const root = situation.roads.node_near(situation.map.cell_at(robots[i].pose.position));
    // Somebody stands so near that there is no way anywhere: that is no reason to end.
    if (!root) continue;
    orders[i].kind = Order::Kind::home;
    chosen_[i].reset();
    auto const tree = situation.roads.from(*root);
    if (!is_open_known) {
      open = situation.frontiers.find(situation.map, situation.roads, tree);
      is_open_known = true;
    }
    auto const nearest =
        std::ranges::min_element(open, {}, [&](Frontier const& frontier) { return tree.distance_m[frontier.node]; });
    if (nearest == open.end() || !tree.reaches(nearest->node)) continue;
    orders[i] = {.kind = Order::Kind::go, .goal = nearest->stand};
    chosen_[i] = std::move(*nearest);
    open.erase(nearest);
  }
  return orders;
}

}  // namespace lapwing::explore
