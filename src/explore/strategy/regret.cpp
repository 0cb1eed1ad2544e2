#include "explore/strategy/regret.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "explore/strategy/sharing.hpp"

namespace lapwing::explore {

bool Regret::is_due(Situation const& situation) {
  auto const& robots = situation.robots;
  double const new_m2 =
      static_cast<double>(situation.map.discovered() - discovered_) * situation.map.cell_m() * situation.map.cell_m();
  bool is_due = new_m2 >= settings_.news_m2;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].is_out) continue;
    if (!targets_[i]) {
      is_due = is_due || situation.time_s >= next_look_s_;
      continue;
    }
    auto const& site = targets_[i]->site;
    if (robots[i].has_arrived) sites_.has_remained(situation, site);
    if (robots[i].is_blocked) {
      for (auto const& frontier : site.frontiers) situation.frontiers.put_off(situation.map, frontier);
    }
    bool const is_open = std::ranges::any_of(site.frontiers, [&](Frontier const& frontier) {
      return frontier.middle == targets_[i]->watched && Frontiers::is_open(situation.map, frontier);
    });
    if (robots[i].has_arrived || robots[i].is_blocked || !is_open) is_due = true;
  }
  return is_due;
}

Regret::Plan Regret::plan(Situation const& situation) {
  Plan plan;
  std::vector<RoadMap::Tree> trees;
  for (std::size_t i = 0; i < situation.robots.size(); ++i) {
    if (situation.robots[i].is_out) continue;
    auto const root = situation.roads.node_near(situation.map.cell_at(situation.robots[i].pose.position));
    if (!root) continue;
    plan.robots.push_back(i);
    trees.push_back(situation.roads.from(*root));
  }
  if (plan.robots.empty()) return plan;
  plan.open = sites_.find(situation, trees.front());
  auto const& open = plan.open;
  TourCosts costs;
  costs.end.assign(open.size(), 0.0);
  costs.between.assign(open.size(), std::vector<double>(open.size(), 0.0));
  for (std::size_t a = 0; a < open.size(); ++a) {
    for (std::size_t b = a + 1; b < open.size(); ++b)
      costs.between[a][b] = costs.between[b][a] = sites_.between_m(situation, trees.front(), open[a], open[b]);
  }
  // The same costs between sites for all; only where they begin differs.
  plan.costs.assign(plan.robots.size(), costs);
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    for (auto const& site : open) {
      auto const& at = situation.robots[plan.robots[k]].pose.position;
      double const straight_m = distance_m(situation.map.middle(site.place), at);
      double const way_m = static_cast<double>(trees[k].distance_m[site.node]) - 4.0 * situation.map.cell_m();
      plan.costs[k].from_start.push_back(std::max(straight_m, way_m));
    }
  }
  return plan;
}

std::size_t Regret::next_of(Situation const& situation, Plan const& plan, std::size_t robot,
                            std::vector<std::size_t> const& mine) const {
  auto const& costs = plan.costs[robot];
  auto const& target = targets_[plan.robots[robot]];
  auto const is_chosen = [&](Site const& site) {
    constexpr double same_m = 0.5;
    return target && std::ranges::any_of(site.frontiers, [&](Frontier const& frontier) {
             return length_of(frontier.middle - target->watched) * situation.map.cell_m() < same_m;
           });
  };
  return *std::ranges::min_element(mine, {}, [&](std::size_t s) {
    double apart_m = settings_.most_apart_m;
    for (auto const other : mine) {
      if (other != s) apart_m = std::min(apart_m, costs.between[other][s]);
    }
    double const kept_m = is_chosen(plan.open[s]) ? settings_.keep_m : 0.0;
    return costs.from_start[s] + settings_.depth_share * plan.open[s].depth_m - settings_.apart_share * apart_m -
           kept_m;
  });
}

std::vector<Order> Regret::decide(Situation const& situation) {
  targets_.resize(situation.robots.size());
  std::vector<Order> orders(situation.robots.size());
  if (!is_due(situation)) return orders;
  discovered_ = situation.map.discovered();
  next_look_s_ = situation.time_s + settings_.look_every_s;
  auto const plan = this->plan(situation);
  if (plan.robots.empty()) return orders;
  std::vector<std::size_t> all(plan.open.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  auto const given = shared_out(plan.costs, all);
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    auto const i = plan.robots[k];
    if (given[k].empty()) {
      orders[i].kind = Order::Kind::home;
      targets_[i].reset();
      continue;
    }
    auto const& site = plan.open[next_of(situation, plan, k, given[k])];
    auto const& first = std::ranges::min(site.frontiers, {}, [&](Frontier const& frontier) {
      return distance_m(situation.map.middle(frontier.middle), situation.robots[i].pose.position);
    });
    targets_[i] = Target{site, first.middle};
    orders[i] = {.kind = Order::Kind::go, .goal = site.place};
  }
  return orders;
}

}  // namespace lapwing::explore
