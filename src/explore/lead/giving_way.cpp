#include "explore/lead/giving_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::explore {

namespace {

constexpr float farthest_m = 25.0F;
constexpr double slow_m_s = 0.1;  ///< ways beside take no longer than at this speed
constexpr double at_least_s = 10.0;

bool is_near_any(Place const& place, std::span<Place const> others, double apart_m) {
  return std::ranges::any_of(others, [&](Place const& other) { return distance_m(place, other) < apart_m; });
}

double length_m(std::span<Place const> way) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum_m += distance_m(way[i - 1], way[i]);
  return sum_m;
}

/// Places no farther from each other than `step_m`, so that none between them is missed.
std::vector<Place> filled(std::span<Place const> way, double step_m) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) {
      auto const leg = way[i] - way[i - 1];
      int const steps = static_cast<int>(leg.length() / step_m);
      for (int k = 1; k <= steps; ++k) places.push_back(way[i - 1] + (k / (steps + 1.0)) * leg);
    }
    places.push_back(way[i]);
  }
  return places;
}

}  // namespace

std::vector<Place> way_ahead(KnownMap const& map, RoadMap const& roads, Place const& from, Cell to) {
  constexpr double looked_ahead_m = 8.0;
  auto const root = roads.node_near(map.cell_at(from));
  auto const end = roads.node_near(to);
  if (!root || !end) return {};
  std::vector<Place> way = {from};
  double so_far_m = 0.0;
  for (auto const node : roads.way(*root, *end, {})) {
    auto const next = map.middle(roads.place_of(node));
    so_far_m += distance_m(way.back(), next);
    way.push_back(next);
    if (so_far_m > looked_ahead_m) return way;
  }
  way.push_back(map.middle(to));
  return way;
}

std::vector<Place> way_ahead(Place const& from, double yaw_rad) {
  constexpr double steered_m = 1.5;
  return {from, from + steered_m * Shift(std::cos(yaw_rad), std::sin(yaw_rad))};
}

bool GivingWay::is_busy() const {
  return std::ranges::any_of(aside_, [](std::optional<Aside> const& aside) { return aside.has_value(); });
}

std::vector<GivingWay::Refuge> GivingWay::refuges(Scene const& scene, std::size_t who,
                                                  std::vector<Place> const& kept_clear, std::vector<Disc> const& closed,
                                                  std::size_t most) {
  auto const root = scene.roads.node_near(scene.map.cell_at(scene.members[who].at));
  if (!root) return {};
  auto const tree = scene.roads.from(*root, farthest_m, closed);
  std::vector<RoadMap::Node> possible;
  for (std::size_t i = 0; i < scene.roads.nodes(); ++i) {
    auto const node = static_cast<RoadMap::Node>(i);
    if (!tree.reaches(node)) continue;
    auto const place = scene.map.middle(scene.roads.place_of(node));
    if (is_near_any(place, kept_clear, scene.apart_m)) continue;
    if (std::ranges::any_of(closed, [&](Disc const& disc) { return distance_m(disc.middle, place) < disc.radius_m; }))
      continue;
    possible.push_back(node);
  }
  std::ranges::stable_sort(possible, {}, [&](RoadMap::Node node) { return tree.distance_m[node]; });
  possible.resize(std::min(possible.size(), most));
  std::vector<Refuge> found;
  for (auto const end : possible) {
    found.push_back({scene.roads.place_of(end), {}});
    auto& way = found.back().way;
    for (auto node = end; node != *root; node = tree.before[node])
      way.push_back(scene.map.middle(scene.roads.place_of(node)));
    way.push_back(scene.members[who].at);
    std::ranges::reverse(way);
  }
  return found;
}

bool GivingWay::can_pass(Scene const& scene, Place const& from, Place const& to, Place const& standing) {
  auto const root = scene.roads.node_near(scene.map.cell_at(from));
  auto const end = scene.roads.node_near(scene.map.cell_at(to));
  return root && end && !scene.roads.way(*root, *end, {{standing, scene.apart_m}}).empty();
}

bool GivingWay::clear(Scene& scene, std::vector<Place> const& way, std::size_t leader, std::vector<Place>& kept_clear,
                      Moves& moves) {
  scene.leads[leader] = true;
  auto const places = filled(way, scene.apart_m / 2.0);
  kept_clear.insert(kept_clear.end(), places.begin(), places.end());
  double const leader_s = length_m(way) / slow_m_s;
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    auto const& member = scene.members[i];
    if (scene.leads[i] || moves[i] || !is_near_any(member.at, places, scene.apart_m)) continue;
    // Around all others if it can, else they move, too; never through the one that it makes room for.
    std::vector<Disc> closed = {{scene.members[leader].at, scene.apart_m}};
    auto all_closed = closed;
    for (std::size_t j = 0; j < scene.members.size(); ++j) {
      if (j != i && j != leader) all_closed.push_back({scene.members[j].at, scene.apart_m});
    }
    auto found = refuges(scene, i, kept_clear, all_closed, 1);
    if (found.empty()) found = refuges(scene, i, kept_clear, closed, 1);
    if (found.empty()) return false;
    auto const& away = found.front().way;
    double const until_s = scene.time_s + at_least_s + leader_s + length_m(away) / slow_m_s;
    moves[i] = Aside{found.front().cell, leader, member.at, until_s};
    if (!clear(scene, away, i, kept_clear, moves)) return false;
  }
  return true;
}

bool GivingWay::lead(Scene scene, std::size_t leader) {
  auto const leads = scene.leads;
  std::vector<Place> kept_clear;
  Moves moves = aside_;
  if (clear(scene, scene.members[leader].way, leader, kept_clear, moves)) {
    bool is_new = false;
    for (std::size_t i = 0; i < moves.size(); ++i) is_new = is_new || (moves[i] && !aside_[i]);
    aside_ = std::move(moves);
    return is_new;
  }
  // Whoever stands nearest in its way leaves first, and the leader makes room for that one.
  auto const nearest = nearest_before(scene, leader);
  if (!nearest) return false;
  auto const& wanted = scene.members[leader].way;
  constexpr std::size_t most_tried = 40;
  for (auto const& out : refuges(scene, *nearest, filled(wanted, scene.apart_m / 2.0), {}, most_tried)) {
    kept_clear.clear();
    moves = aside_;
    scene.leads = leads;
    double const out_s = 3.0 * length_m(out.way) / slow_m_s + length_m(wanted) / slow_m_s;
    moves[*nearest] = Aside{out.cell, leader, scene.members[*nearest].at, scene.time_s + at_least_s + out_s};
    if (!clear(scene, out.way, *nearest, kept_clear, moves)) continue;
    // From where the leader waits it must come by the other.
    auto const waits_at = moves[leader] ? scene.map.middle(moves[leader]->to) : scene.members[leader].at;
    if (!can_pass(scene, waits_at, wanted.back(), scene.map.middle(out.cell))) continue;
    // It waits until the other is out, and no longer.
    if (moves[leader]) moves[leader]->until_s = scene.time_s + at_least_s + 2.0 * length_m(out.way) / slow_m_s;
    aside_ = std::move(moves);
    return true;
  }
  return false;
}

std::optional<std::size_t> GivingWay::nearest_before(Scene const& scene, std::size_t leader) const {
  std::optional<std::size_t> nearest;
  double least_m = before_m;
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    double const far_m = distance_m(scene.members[i].at, scene.members[leader].at);
    if (i == leader || aside_[i] || far_m >= least_m) continue;
    nearest = i;
    least_m = far_m;
  }
  return nearest;
}

void GivingWay::end_those_passed(Scene const& scene) {
  for (auto& aside : aside_) {
    if (!aside) continue;
    auto const& leader = scene.members[aside->leader];
    bool const is_led_aside = aside_[aside->leader].has_value();
    bool const has_passed = !is_led_aside && distance_m(leader.at, aside->left) > before_m &&
                            !is_near_any(aside->left, filled(leader.way, scene.apart_m / 2.0), scene.apart_m);
    if (aside->until_s < scene.time_s || has_passed) aside.reset();
  }
}

void GivingWay::back_off(Scene const& scene) {
  if (scene.time_s < next_back_off_s_) return;
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    auto const& member = scene.members[i];
    if (member.way.empty() || aside_[i] || member.stood_s < stalls_s) continue;
    std::vector<std::size_t> group;
    for (std::size_t j = 0; j < scene.members.size(); ++j) {
      if (distance_m(scene.members[j].at, member.at) < before_m) group.push_back(j);
    }
    if (group.size() < 2) continue;
    next_back_off_s_ = scene.time_s + back_off_every_s;
    auto const who = group[back_offs_ % group.size()];
    auto const refuge = refuge_far_off(scene, group, who, 1.0 + static_cast<double>(back_offs_ / group.size() % 4));
    ++back_offs_;
    if (!refuge) return;
    // What was decided before did not help: all others of them are free to go on.
    for (auto const each : group) aside_[each].reset();
    auto const first = who != i ? i : group[group.front() == who ? 1 : 0];
    double const until_s = scene.time_s + at_least_s + length_m(refuge->way) / slow_m_s;
    aside_[who] = Aside{refuge->cell, first, scene.members[who].at, until_s};
    return;
  }
}

std::optional<GivingWay::Refuge> GivingWay::refuge_far_off(Scene const& scene, std::span<std::size_t const> group,
                                                           std::size_t who, double far_m) {
  std::vector<Place> ways;
  std::vector<Disc> closed;
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    if (i != who) closed.push_back({scene.members[i].at, scene.apart_m});
  }
  for (auto const each : group) {
    if (each == who) continue;
    auto const way = filled(scene.members[each].way, scene.apart_m / 2.0);
    ways.insert(ways.end(), way.begin(), way.end());
  }
  constexpr std::size_t most_tried = 400;
  auto found = refuges(scene, who, ways, closed, most_tried);
  if (found.empty()) found = refuges(scene, who, {}, closed, most_tried);
  if (found.empty()) return std::nullopt;
  auto const far = std::ranges::find_if(found, [&](Refuge const& each) { return length_m(each.way) >= far_m; });
  return far == found.end() ? found.back() : *far;
}

std::vector<std::optional<Cell>> GivingWay::decide(KnownMap const& map, RoadMap const& roads,
                                                   std::span<Member const> members, double radius_m, double time_s) {
  aside_.resize(members.size());
  led_.resize(members.size());
  Scene scene{map, roads, members, 2.0 * radius_m + 0.2, time_s};
  end_those_passed(scene);
  // Whoever has gone first least often is the first to go first.
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].way.empty() || members[i].stood_s < stands_s || aside_[i]) continue;
    bool const is_somebody_near = std::ranges::any_of(members, [&](Member const& other) {
      return &other != &members[i] && distance_m(other.at, members[i].at) < before_m;
    });
    if (is_somebody_near) waiting.push_back(i);
  }
  std::ranges::stable_sort(waiting, {}, [&](std::size_t i) { return led_[i]; });
  for (auto const leader : waiting) {
    scene.leads.assign(members.size(), false);
    for (auto const& aside : aside_) {
      if (aside) scene.leads[aside->leader] = true;
    }
    if (aside_[leader] || !lead(scene, leader)) continue;
    ++led_[leader];
  }
  back_off(scene);
  std::vector<std::optional<Cell>> cells;
  for (auto const& aside : aside_) cells.push_back(aside ? std::optional(aside->to) : std::nullopt);
  return cells;
}

}  // namespace lapwing::explore
