#include "explore/strategy/tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explore/strategy/gain.hpp"

namespace lapwing::explore {

namespace {

/// Distances of the road map are looked up again after this: new ways may be shorter.
constexpr double distance_lasts_s = 60.0;
/// Farther apart than this, places are joined over where the robot is.
constexpr float searched_m = 30.0F;
/// Frontiers whose stands are nearer to each other are one site.
constexpr double same_site_m = 1.0;

std::uint64_t pair_of(RoadMap::Node a, RoadMap::Node b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

}  // namespace

bool Tour::is_due(Situation const& situation) {
  auto const& robots = situation.robots;
  bool is_due = situation.time_s >= next_look_s_;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!targets_[i] || robots[i].is_out) continue;
    bool const is_open = situation.map.is_frontier(targets_[i]->watched);
    if ((robots[i].has_arrived || robots[i].is_blocked) && is_open) {
      for (auto const& frontier : targets_[i]->site.frontiers) {
        if (frontier.middle != targets_[i]->watched) continue;
        if (robots[i].has_arrived)
          situation.frontiers.give_up(frontier);
        else
          situation.frontiers.put_off(frontier);
      }
    }
    if (robots[i].has_arrived || robots[i].is_blocked || !is_open) is_due = true;
  }
  return is_due;
}

std::vector<Tour::Site> Tour::sites(Situation const& situation, RoadMap::Tree const& reach) const {
  auto open = situation.frontiers.find(situation.map, situation.roads, reach);
  std::ranges::stable_sort(open, {}, [&](Frontier const& frontier) { return reach.distance_m[frontier.node]; });
  std::vector<Site> sites;
  for (auto& frontier : open) {
    double const gain_m2 = unknown_beyond_m2(situation.map, frontier, settings_.gain_reach_m);
    auto const same = std::ranges::find_if(sites, [&](Site const& site) {
      return length_of(site.stand - frontier.stand) * situation.map.cell_m() < same_site_m &&
             std::abs(reach.distance_m[site.node] - reach.distance_m[frontier.node]) < 2.0 * same_site_m;
    });
    if (same == sites.end()) {
      if (sites.size() >= settings_.most_sites) continue;
      sites.push_back({.frontiers = {}, .stand = frontier.stand, .node = frontier.node});
      sites.back().gain_m2 = gain_m2;
      sites.back().frontiers.push_back(std::move(frontier));
    } else {
      same->gain_m2 = std::max(same->gain_m2, gain_m2);
      same->frontiers.push_back(std::move(frontier));
    }
  }
  for (auto& site : sites)
    site.depth_m = std::min(settings_.most_depth_m, settings_.depth_per_m * std::sqrt(site.gain_m2));
  return sites;
}

void Tour::fill_distances(Situation const& situation, std::vector<Site> const& sites) {
  for (auto const& site : sites) {
    bool const is_missing = std::ranges::any_of(sites, [&](Site const& other) {
      auto const found = distances_.find(pair_of(site.node, other.node));
      return found == distances_.end() || situation.time_s - found->second.at_s > distance_lasts_s;
    });
    if (!is_missing) continue;
    auto const tree = situation.roads.from(site.node, searched_m);
    for (auto const& other : sites) {
      auto& known = distances_[pair_of(site.node, other.node)];
      known = {tree.distance_m[other.node], situation.time_s};
    }
  }
}

double Tour::between(Situation const& situation, RoadMap::Tree const& reach, Site const& a, Site const& b) {
  double const straight = length_of(a.stand - b.stand) * situation.map.cell_m();
  if (a.node == b.node) return straight;
  auto const found = distances_.find(pair_of(a.node, b.node));
  double const over_robot =
      static_cast<double>(reach.distance_m[a.node]) + static_cast<double>(reach.distance_m[b.node]);
  if (found == distances_.end()) return over_robot;
  return std::max(straight, std::min(over_robot, static_cast<double>(found->second.distance_m)));
}

std::vector<Order> Tour::decide(Situation const& situation) {
  auto const& robots = situation.robots;
  targets_.resize(robots.size());
  std::vector<Order> orders(robots.size());
  if (!is_due(situation)) return orders;
  next_look_s_ = situation.time_s + settings_.look_every_s;
  if (distances_.size() > 20'000) distances_.clear();

  std::vector<std::size_t> active;
  std::vector<RoadMap::Tree> trees;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].is_out) continue;
    auto const root = situation.roads.node_near(situation.map.cell_at(robots[i].pose.position));
    if (!root) continue;
    active.push_back(i);
    trees.push_back(situation.roads.from(*root));
  }
  if (active.empty()) return orders;
  auto open = sites(situation, trees.front());
  fill_distances(situation, open);

  // The same costs between sites for all; only where they begin differs.
  TourCosts costs;
  costs.between.assign(open.size(), std::vector<double>(open.size(), 0.0));
  for (std::size_t a = 0; a < open.size(); ++a) {
    for (std::size_t b = a + 1; b < open.size(); ++b)
      costs.between[a][b] = costs.between[b][a] = between(situation, trees.front(), open[a], open[b]);
  }
  for (auto const& site : open) costs.end.push_back(-site.depth_m);

  auto const cell_m = situation.map.cell_m();
  std::vector<TourCosts> own(active.size(), costs);
  for (std::size_t k = 0; k < active.size(); ++k) {
    auto const& robot = robots[active[k]];
    for (auto const& site : open) {
      double const straight = distance_m(situation.map.middle(site.stand), robot.pose.position);
      own[k].from_start.push_back(
          std::max(straight, static_cast<double>(trees[k].distance_m[site.node]) - 4.0 * cell_m));
    }
  }
  // Whoever has least to drive takes next what adds least.
  std::vector<std::size_t> large;
  std::vector<std::size_t> small;
  for (std::size_t i = 0; i < open.size(); ++i) (open[i].gain_m2 >= settings_.small_m2 ? large : small).push_back(i);
  bool const is_sweeping = large.empty();
  if (is_sweeping) std::swap(large, small);
  std::vector<std::vector<std::size_t>> given(active.size());
  if (active.size() == 1) {
    given[0] = large;
  } else {
    auto left = large;
    std::vector<double> length(active.size(), 0.0);
    while (!left.empty()) {
      std::size_t best_site = 0;
      std::size_t best_robot = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < active.size(); ++k) {
        for (std::size_t s = 0; s < left.size(); ++s) {
          double add = own[k].from_start[left[s]];
          for (auto const other : given[k]) add = std::min(add, costs.between[other][left[s]]);
          if (length[k] + add >= least) continue;
          least = length[k] + add;
          best_site = s;
          best_robot = k;
        }
      }
      if (least == std::numeric_limits<double>::infinity()) break;
      length[best_robot] = least;
      given[best_robot].push_back(left[best_site]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best_site));
    }
  }
  for (std::size_t k = 0; k < active.size(); ++k) {
    auto const i = active[k];
    auto const& mine = given[k];
    if (mine.empty()) {
      orders[i].kind = Order::Kind::home;
      targets_[i].reset();
      continue;
    }
    auto tour = good_tour(own[k], mine);
    if (targets_[i]) {
      auto const current = std::ranges::find_if(mine, [&](std::size_t s) {
        return std::ranges::any_of(open[s].frontiers, [&](Frontier const& frontier) {
          return length_of(frontier.middle - targets_[i]->watched) * cell_m < 0.5;
        });
      });
      if (current != mine.end() && *current != tour.front()) {
        auto kept = good_tour_from(own[k], mine, *current);
        if (cost_of(own[k], kept) < cost_of(own[k], tour) + settings_.keep_m) tour = std::move(kept);
      }
    }
    auto next = tour.front();
    // What is small is taken along where it lies at the way.
    double least = is_sweeping ? 0.0 : settings_.small_detour_m;
    for (auto const s : small) {
      double const detour = own[k].from_start[s] + costs.between[s][tour.front()] - own[k].from_start[tour.front()];
      if (detour >= least || own[k].from_start[s] > own[k].from_start[tour.front()] + 3.0) continue;
      least = detour;
      next = s;
    }
    auto const& site = open[next];
    auto const& first = std::ranges::min(site.frontiers, {}, [&](Frontier const& frontier) {
      return distance_m(situation.map.middle(frontier.stand), robots[i].pose.position);
    });
    targets_[i] = Target{site, first.middle};
    orders[i] = {.kind = Order::Kind::go, .goal = first.stand};
  }
  return orders;
}

}  // namespace lapwing::explore
