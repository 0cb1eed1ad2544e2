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
constexpr double no_news_s = 3600.0;
constexpr double no_news_m2 = 0.25;  ///< less than this is none

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
  std::vector<Place> places;
  for (auto const& member : members_) places.push_back(member.pose.position);
  frontiers_.set_moment(time_s, std::move(places));
  roads_.update(map, map.take_changes());
  mind_standing();
  mind_news(map);
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
  bool const are_all_out = std::ranges::all_of(members_, &Member::is_out);
  is_explored_ =
      (are_all_out || !frontiers_.is_any_put_off(map)) && std::ranges::all_of(members_, [](Member const& member) {
        return member.is_out || member.order.kind == Order::Kind::home;
      });
}

std::vector<Place> Explorer::way_of(KnownMap const& map, Member const& member) const {
  auto const& here = member.pose.position;
  if (member.order.kind == Order::Kind::steer) return way_ahead(here, member.order.yaw_rad);
  auto const goal = member.order.kind == Order::Kind::home ? home_of(map, member) : std::optional(member.order.goal);
  if (!goal || !member.navigator.goal()) return {};
  if (!member.is_aside && member.navigator.state() == Navigator::State::arrived) return {};
  return way_ahead(map, roads_, here, *goal);
}

void Explorer::make_room(KnownMap const& map) {
  auto const stands_before_another = [&](Member const& member) {
    if (time_s_ - member.stood_since_s < GivingWay::stands_s) return false;
    return std::ranges::any_of(members_, [&](Member const& other) {
      return &other != &member && distance_m(other.pose.position, member.pose.position) < GivingWay::before_m;
    });
  };
  if (!giving_way_.is_busy() && std::ranges::none_of(members_, stands_before_another)) return;
  std::vector<GivingWay::Member> standing;
  for (auto const& member : members_)
    standing.push_back({member.pose.position, time_s_ - member.stood_since_s, way_of(map, member)});
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
  constexpr double far_m = 20.0;
  double const apart_m = settings_.carrier.radius_m + settings_.carrier.safe_distance_m + 0.1;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    auto& member = members_[i];
    if (!member.navigator.goal()) continue;
    std::vector<Disc> closed;
    auto const close = [&](Place const& middle, double radius_m, bool stays) {
      double const away_m = distance_m(middle, member.pose.position);
      // Between two ways that others bar, a robot that forgot the one before it came to the other would go to and fro.
      if (away_m > (stays ? far_m : near_m)) return;
      // One that is nearer than that already and moves is left out, as it will be gone; one that stays is kept off as
      // far as can be, and never gone through.
      if (away_m >= radius_m || stays) closed.push_back({middle, std::min(radius_m, away_m)});
    };
    for (std::size_t j = 0; j < members_.size(); ++j) {
      bool const stays = time_s_ - members_[j].stood_since_s > blocked_after_s;
      if (j != i) close(members_[j].pose.position, settings_.carrier.radius_m + apart_m, stays);
    }
    for (auto const& disc : moving) close(disc.middle, disc.radius_m + apart_m, false);
    Roads const roads{map, roads_, search_};
    member.navigator.plan(roads, member.pose, closed);
    // Where others leave no way, it goes up to them and waits.
    if (member.navigator.state() == Navigator::State::blocked && !closed.empty())
      member.navigator.plan(roads, member.pose, {});
  }
}

void Explorer::follow(KnownMap const& map, Member& member, Order const& order) {
  if (order.kind != member.order.kind || order.goal != member.order.goal || member.is_blocked) {
    member.ordered_s = time_s_;
    member.is_blocked = false;
  }
  member.order = order;
  if (member.is_aside) return;
  switch (order.kind) {
    case Order::Kind::go: member.navigator.go_to(order.goal); break;
    case Order::Kind::home:
      // To its very place: who stops somewhere near stands where another belongs.
      if (auto const home = home_of(map, member); home && settings_.does_return)
        member.navigator.go_to(*home);
      else
        member.navigator.stop();
      break;
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

void Explorer::mind_news(KnownMap const& map) {
  double const new_m2 = static_cast<double>(map.discovered() - discovered_) * map.cell_m() * map.cell_m();
  if (new_m2 >= no_news_m2) {
    discovered_ = map.discovered();
    news_at_s_ = time_s_;
  }
  if (time_s_ - news_at_s_ < no_news_s) return;
  // The way home may be long, but not endless.
  double longest_m = 0.0;
  for (auto const& member : members_)
    longest_m = std::max(longest_m, distance_m(member.pose.position, member.start.position));
  constexpr double winding = 10.0;
  constexpr double slow_m_s = 0.1;
  if (time_s_ - news_at_s_ > 2.0 * no_news_s + winding * longest_m / slow_m_s) is_stuck_ = true;
  if (is_explored_) return;
  has_no_news_ = true;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].is_out) call_home(map, i);
  }
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
    member.is_blocked = time_s_ - std::max(member.stood_since_s, member.ordered_s) > blocked_after_s;
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
