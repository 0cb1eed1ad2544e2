#include "explore/lead/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/position.hpp"

namespace lapwing::explore {

namespace {

constexpr double home_m = 0.5;
constexpr double home_among_others_m = 1.5;  ///< others may stand in the way
constexpr double blocked_after_s = 20.0;
constexpr double stuck_after_s = 600.0;

}  // namespace

base::Result<Explorer> Explorer::begin(KnownMap const& map, ExplorerSettings const& settings,
                                       std::span<Pose const> starts) {
  auto strategy = make_strategy(settings.strategy);
  if (!strategy) return std::unexpected(strategy.error());
  return Explorer(map, settings, starts, std::move(*strategy));
}

Explorer::Explorer(KnownMap const& map, ExplorerSettings const& settings, std::span<Pose const> starts,
                   std::unique_ptr<Strategy> strategy)
    : settings_(settings), strategy_(std::move(strategy)), roads_(map), search_(map), frontiers_(map) {
  for (auto const& start : starts)
    members_.push_back(
        {.start = start, .navigator = Navigator(settings.carrier), .pose = start, .stood_at = start.position});
}

void Explorer::update(KnownMap& map, double time_s, std::span<RobotNow const> robots, std::span<Disc const> moving) {
  time_s_ = time_s;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].pose = robots[i].pose;
    members_[i].driven_m = robots[i].driven_m;
    members_[i].sides = robots[i].sides;
  }
  roads_.update(map, map.take_changes());
  mind_standing();
  if (settings_.energy_m > 0.0) mind_energy(map);
  give_orders(map);
  make_room(map);
  plan_ways(map, moving);
}

std::vector<RobotView> Explorer::views() const {
  std::vector<RobotView> views;
  for (auto const& member : members_) {
    auto const state = member.navigator.state();
    views.push_back({.pose = member.pose,
                     .start = member.start,
                     .sides = member.sides,
                     .goal = member.navigator.goal(),
                     .has_arrived = !member.is_aside && state == Navigator::State::arrived,
                     .is_blocked = !member.is_aside && (member.is_blocked || state == Navigator::State::blocked),
                     .is_out = member.is_out,
                     .driven_m = member.driven_m});
  }
  return views;
}

void Explorer::give_orders(KnownMap const& map) {
  auto const seen = views();
  auto const orders = strategy_->decide({map, roads_, frontiers_, seen, time_s_, settings_.range_m});
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].is_out) continue;
    if (orders[i].kind != Order::Kind::keep) follow(map, members_[i], orders[i]);
  }
  is_explored_ = std::ranges::all_of(
      members_, [](Member const& member) { return member.is_out || member.order.kind == Order::Kind::home; });
}

void Explorer::make_room(KnownMap const& map) {
  if (members_.size() == 1) return;
  std::vector<GivingWay::Member> standing;
  for (auto const& member : members_) {
    bool const wants_on = member.navigator.goal() && member.navigator.state() != Navigator::State::arrived;
    standing.push_back({member.pose.position, wants_on, time_s_ - member.stood_since_s});
  }
  auto const cells = giving_way_.decide(map, roads_, standing, settings_.carrier.radius_m, time_s_);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    auto& member = members_[i];
    bool const was_aside = std::exchange(member.is_aside, cells[i].has_value());
    if (cells[i])
      member.navigator.go_to(*cells[i]);
    else if (was_aside)
      follow(map, member, Order(member.order));
  }
}

void Explorer::plan_ways(KnownMap const& map, std::span<Disc const> moving) {
  constexpr double near_m = 3.0;
  double const apart_m = settings_.carrier.radius_m + settings_.carrier.safe_distance_m + 0.1;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    auto& member = members_[i];
    if (!member.navigator.goal()) continue;
    std::vector<Disc> closed;
    auto const close = [&](Place const& middle, double radius_m) {
      double const far_m = distance_m(middle, member.pose.position);
      if (far_m <= near_m && far_m >= radius_m) closed.push_back({middle, radius_m});
    };
    for (std::size_t j = 0; j < members_.size(); ++j) {
      if (j != i) close(members_[j].pose.position, settings_.carrier.radius_m + apart_m);
    }
    for (auto const& disc : moving) close(disc.middle, disc.radius_m + apart_m);
    Roads const roads{map, roads_, search_};
    member.navigator.plan(roads, member.pose, closed);
    // Where others leave no way, it goes up to them and waits.
    if (member.navigator.state() == Navigator::State::blocked && !closed.empty())
      member.navigator.plan(roads, member.pose, {});
  }
}

void Explorer::follow(KnownMap const& map, Member& member, Order const& order) {
  member.order = order;
  member.is_blocked = false;
  if (member.is_aside) return;
  switch (order.kind) {
    case Order::Kind::go: member.navigator.go_to(order.goal); break;
    case Order::Kind::home: {
      auto const which = static_cast<std::size_t>(&member - members_.data());
      if (auto const home = home_of(map, member); home && settings_.does_return && !is_home(which))
        member.navigator.go_to(*home);
      else
        member.navigator.stop();
      break;
    }
    case Order::Kind::steer: member.navigator.stop(); break;
    case Order::Kind::keep: break;
  }
}

void Explorer::call_home(KnownMap const& map, std::size_t robot) {
  auto& member = members_[robot];
  member.is_out = true;
  follow(map, member, {.kind = Order::Kind::home});
}

std::optional<Cell> Explorer::home_of(KnownMap const& map, Member const& member) const {
  auto const cell = map.cell_at(member.start.position);
  if (map.is_standable(cell)) return cell;
  auto const node = roads_.node_near(cell);
  return node ? std::optional(roads_.place_of(*node)) : std::nullopt;
}

bool Explorer::is_home(std::size_t robot) const {
  auto const& member = members_[robot];
  return distance_m(member.pose.position, member.start.position) <
         (members_.size() == 1 ? home_m : home_among_others_m);
}

bool Explorer::is_over() const {
  if (!is_explored_) return false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (settings_.does_return && !is_home(i)) return false;
  }
  return true;
}

bool Explorer::is_any_low() const {
  return std::ranges::any_of(members_, &Member::is_low);
}

void Explorer::mind_energy(KnownMap const& map) {
  for (auto& member : members_) {
    if (member.is_out) continue;
    auto const home = home_of(map, member);
    auto const here = roads_.node_near(map.cell_at(member.pose.position));
    if (!home || !here) continue;
    auto const end = roads_.node_near(*home);
    if (!end) continue;
    auto const tree = roads_.from(*end);
    double const needed_m = 1.2 * static_cast<double>(tree.distance_m[*here]) + 1.0;
    if (settings_.energy_m - member.driven_m > needed_m) continue;
    member.is_low = member.order.kind != Order::Kind::home;
    member.is_out = true;
    follow(map, member, {.kind = Order::Kind::home});
  }
}

void Explorer::mind_standing() {
  for (auto& member : members_) {
    auto const& place = member.pose.position;
    if (distance_m(place, member.stood_at) > 0.1 || member.order.kind == Order::Kind::keep) {
      member.stood_at = place;
      member.stood_since_s = time_s_;
    }
    member.is_blocked = time_s_ - member.stood_since_s > blocked_after_s;
  }
  is_stuck_ = std::ranges::all_of(members_,
                                  [&](Member const& member) { return time_s_ - member.stood_since_s > stuck_after_s; });
}

Motion Explorer::motion(KnownMap const& map, std::size_t robot, Pose const& pose) {
  auto& member = members_[robot];
  bool const is_near = map.is_near_wall(map.cell_at(pose.position));
  double const speed = is_near ? settings_.carrier.near_speed_m_s : settings_.carrier.speed_m_s;
  if (member.navigator.goal()) return member.navigator.steer(map, pose, speed);
  if (member.order.kind != Order::Kind::steer) return {};
  double const off = geo::wrap_pi(member.order.yaw_rad - pose.yaw_rad);
  return {std::abs(off) > 0.5 ? 0.0 : std::min(speed, member.order.speed_m_s), 2.5 * off};
}

}  // namespace lapwing::explore
