#include "explore/strategy/sites.hpp"

#include <algorithm>
#include <cmath>

#include "explore/floor/ray.hpp"
#include "explore/strategy/gain.hpp"

namespace lapwing::explore {

namespace {

/// Distances of the road map are looked up again after this: new ways may be shorter.
constexpr double distance_lasts_s = 60.0;
/// Farther apart than this, places are joined over where the robot is.
constexpr float searched_m = 30.0F;

std::uint64_t pair_of(RoadMap::Node a, RoadMap::Node b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

/// Over free cells up to the frontier's, and then into the unknown: not along its edge.
bool does_see_beyond(KnownMap const& map, Cell from, Cell frontier) {
  auto const way = frontier - from;
  double const length = length_of(way);
  double const beyond = std::max(3.0, 0.3 / map.cell_m());
  if (length < 1.0) return true;
  bool is_clear = true;
  walk_line(from.x + 0.5, from.y + 0.5, way.x / length, way.y / length, length + beyond, [&](Cell cell, double at) {
    auto const knowledge = map.at(cell);
    if (at < length - 1.0)
      is_clear = knowledge == Knowledge::free;
    else if (at > length + 1.5)
      is_clear = knowledge == Knowledge::unknown;
    else
      is_clear = knowledge != Knowledge::wall;
    return is_clear;
  });
  return is_clear;
}

}  // namespace

RoadMap::Node Sites::view_of(Situation const& situation, RoadMap::Tree const& reach, Frontier const& frontier) const {
  auto best = frontier.node;
  if (is_near_only_[frontier.middle] != 0 || frontier.is_shut) return best;
  double const most = std::min(settings_.view_m, 0.7 * situation.range_m) / situation.map.cell_m();
  for (auto node = best;; node = reach.before[node]) {
    auto const place = situation.roads.place_of(node);
    if (length_of(place - frontier.middle) > most) break;
    if (does_see_beyond(situation.map, place, frontier.middle)) best = node;
    if (reach.before[node] == node) break;
  }
  return best;
}

std::vector<Site> Sites::find(Situation const& situation, RoadMap::Tree const& reach) {
  auto const& map = situation.map;
  if (is_near_only_.size() == 0) is_near_only_ = DenseGrid<std::uint8_t>(map.width(), map.height(), 0);
  if (distances_.size() > 20'000) distances_.clear();
  auto open = situation.frontiers.find(map, situation.roads, reach);
  struct Seen {
    Frontier frontier;
    RoadMap::Node from = 0;
  };
  std::vector<Seen> all;
  for (auto& frontier : open) {
    auto const from = view_of(situation, reach, frontier);
    all.push_back({std::move(frontier), from});
  }
  std::ranges::stable_sort(all, {}, [&](Seen const& seen) { return reach.distance_m[seen.from]; });
  std::vector<Site> sites;
  for (auto& [frontier, from] : all) {
    auto const place = from == frontier.node ? frontier.stand : situation.roads.place_of(from);
    auto const same = std::ranges::find_if(sites, [&](Site const& site) {
      return length_of(site.place - place) * map.cell_m() < settings_.same_m &&
             std::abs(reach.distance_m[site.node] - reach.distance_m[from]) < 2.0 * settings_.same_m;
    });
    if (same == sites.end() && sites.size() >= settings_.most_sites) continue;
    double const gain_m2 = unknown_beyond_m2(map, frontier, settings_.gain_reach_m);
    if (same == sites.end()) {
      sites.push_back({.frontiers = {}, .place = place, .node = from, .gain_m2 = gain_m2});
      sites.back().frontiers.push_back(std::move(frontier));
    } else {
      same->gain_m2 = std::max(same->gain_m2, gain_m2);
      same->frontiers.push_back(std::move(frontier));
    }
  }
  for (auto& site : sites)
    site.depth_m = std::min(settings_.most_depth_m, settings_.depth_per_m * std::sqrt(site.gain_m2));
  look_up_distances(situation, sites);
  return sites;
}

void Sites::has_remained(Situation const& situation, Site const& site) {
  for (auto const& frontier : site.frontiers) {
    if (!Frontiers::is_open(situation.map, frontier)) continue;
    if (site.place == frontier.stand || is_near_only_[frontier.middle] != 0) {
      if (site.place == frontier.stand) situation.frontiers.give_up(situation.map, frontier);
      continue;
    }
    for (auto const cell : frontier.cells) is_near_only_.at_index(cell) = 1;
  }
}

void Sites::look_up_distances(Situation const& situation, std::vector<Site> const& sites) {
  for (auto const& site : sites) {
    bool const is_missing = std::ranges::any_of(sites, [&](Site const& other) {
      auto const found = distances_.find(pair_of(site.node, other.node));
      return found == distances_.end() || situation.time_s - found->second.at_s > distance_lasts_s;
    });
    if (!is_missing) continue;
    auto const tree = situation.roads.from(site.node, searched_m);
    for (auto const& other : sites)
      distances_[pair_of(site.node, other.node)] = {tree.distance_m[other.node], situation.time_s};
  }
}

double Sites::between_m(Situation const& situation, RoadMap::Tree const& reach, Site const& a, Site const& b) const {
  double const straight_m = length_of(a.place - b.place) * situation.map.cell_m();
  if (a.node == b.node) return straight_m;
  double const over_robot_m =
      static_cast<double>(reach.distance_m[a.node]) + static_cast<double>(reach.distance_m[b.node]);
  auto const found = distances_.find(pair_of(a.node, b.node));
  if (found == distances_.end()) return over_robot_m;
  return std::max(straight_m, std::min(over_robot_m, static_cast<double>(found->second.distance_m)));
}

}  // namespace lapwing::explore
