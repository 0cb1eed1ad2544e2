#include "explore/run/exploration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::explore {

namespace {

constexpr int steps_a_look = 5;  ///< the map is kept up twice a second (seed 001)
constexpr double scan_again_m = 0.1;
constexpr double home_m = 0.5;
constexpr double home_among_others_m = 1.5;  ///< others may stand in the way
constexpr double blocked_after_s = 20.0;
constexpr double stuck_after_s = 600.0;
constexpr double sonar_side_m = 5.0;
constexpr double sonar_front_m = 7.5;

}  // namespace

std::string_view to_string(Ending ending) {
  switch (ending) {
    case Ending::explored: return "explored";
    case Ending::energy: return "energy";
    case Ending::stuck: return "stuck";
    case Ending::time: return "time";
  }
  return "";
}

base::Result<Exploration> Exploration::begin(std::shared_ptr<World const> world, Settings const& settings,
                                             std::vector<Pose> starts) {
  auto strategy = make_strategy(settings);
  if (!strategy) return std::unexpected(strategy.error());
  if (starts.empty() || starts.size() != static_cast<std::size_t>(settings.robots))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{} robots have {} places to start", settings.robots, starts.size()));
  for (auto const& start : starts) {
    if (!world->has_room(start.position, settings.carrier.radius_m))
      return base::fail(base::ErrorKind::invalid_input, "a robot would touch a wall where it starts");
  }
  return Exploration(std::move(world), settings, starts, std::move(*strategy));
}

Exploration::Exploration(std::shared_ptr<World const> world, Settings const& settings, std::vector<Pose> const& starts,
                         std::unique_ptr<Strategy> strategy)
    : world_(std::move(world)),
      settings_(settings),
      strategy_(std::move(strategy)),
      random_(settings.seed),
      walkers_(*world_, settings.people, starts, random_) {
  map_ = std::make_unique<KnownMap>(
      world_->width(), world_->height(), world_->cell_m(),
      KnownMap::Distances{.keep_off_m = settings.carrier.radius_m + settings.carrier.safe_distance_m,
                          .wary_m = settings.wary_m});
  roads_ = std::make_unique<RoadMap>(*map_);
  search_ = std::make_unique<GridSearch>(*map_);
  frontiers_ = std::make_unique<Frontiers>(*map_);
  is_counted_ = DenseGrid<std::uint8_t>(world_->width(), world_->height(), 0);
  for (auto const& start : starts)
    robots_.push_back(
        {.carrier = Carrier(start, settings.carrier), .start = start, .navigator = Navigator(settings.carrier)});
}

bool Exploration::step() {
  if (steps_ % steps_a_look == 0) {
    look();
    count_seen();
    mind_standing();
    if (settings_.energy_m > 0.0) mind_energy();
    give_orders();
    make_room();
    plan_ways();
    if (is_over()) return false;
  }
  drive();
  walk();
  check_collisions();
  ++steps_;
  return true;
}

void Exploration::look() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto& robot = robots_[i];
    auto const& pose = robot.carrier.pose();
    if (robot.has_scanned && distance_m(pose.position, robot.scanned_at) < scan_again_m && robots_.size() == 1 &&
        settings_.people == 0)
      continue;
    robot.has_scanned = true;
    robot.scanned_at = pose.position;
    auto const others = others_than(i, 0.0);
    auto const own_scan = scan(*world_, pose, settings_.laser, others, random_);
    map_->add(own_scan, robots_but(i, 0.15));
    if (robot.track.empty() || distance_m(robot.track.back(), pose.position) > 0.05)
      robot.track.push_back(pose.position);
  }
  roads_->update(*map_, map_->take_changes());
}

void Exploration::count_seen() {
  for (auto const index : map_->take_fresh()) {
    if (world_->is_wanted().at_index(index) == 0) continue;
    bool const is_seen = map_->at(map_->cell_of(index)) == Knowledge::free;
    auto& counted = is_counted_.at_index(index);
    if (is_seen == (counted != 0)) continue;
    counted = is_seen ? 1 : 0;
    if (is_seen)
      ++counted_;
    else
      --counted_;
  }
  if (!time_to_99_s_ && coverage() >= 0.99) {
    time_to_99_s_ = time_s();
    travel_to_99_m_ = travel_m();
  }
}

double Exploration::coverage() const {
  return world_->wanted() == 0 ? 1.0 : static_cast<double>(counted_) / static_cast<double>(world_->wanted());
}

double Exploration::travel_m() const {
  double sum = 0.0;
  for (auto const& robot : robots_) sum += robot.carrier.driven_m();
  return sum;
}

std::vector<Disc> Exploration::robots_but(std::size_t robot, double more_m) const {
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (i != robot) discs.push_back({robots_[i].carrier.pose().position, settings_.carrier.radius_m + more_m});
  }
  return discs;
}

std::vector<Disc> Exploration::others_than(std::size_t robot, double more_m) const {
  auto discs = robots_but(robot, more_m);
  for (auto const& disc : walkers_.discs()) discs.push_back({disc.middle, disc.radius_m + more_m});
  return discs;
}

std::vector<RobotView> Exploration::views() const {
  std::vector<RobotView> views;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto const& robot = robots_[i];
    auto const& pose = robot.carrier.pose();
    views.push_back(
        {.pose = pose,
         .start = robot.start,
         .sides = [this, i] { return sides_of(i); },
         .goal = robot.navigator.goal(),
         .has_arrived = !robot.is_aside && robot.navigator.state() == Navigator::State::arrived,
         .is_blocked = !robot.is_aside && (robot.is_blocked || robot.navigator.state() == Navigator::State::blocked),
         .is_out = robot.is_out,
         .driven_m = robot.carrier.driven_m()});
  }
  return views;
}

SideDistances Exploration::sides_of(std::size_t robot) const {
  auto const pose = robots_[robot].carrier.pose();
  auto const others = others_than(robot, 0.0);
  auto const at = [&](double yaw, double range_m) {
    return sonar_m(*world_, pose.position, pose.yaw_rad + yaw, range_m, others);
  };
  constexpr double right_angle = std::numbers::pi / 2.0;
  return {at(right_angle, sonar_side_m), at(0.0, sonar_front_m), at(-right_angle, sonar_side_m)};
}

void Exploration::give_orders() {
  auto const seen = views();
  auto const orders = strategy_->decide({*map_, *roads_, *frontiers_, seen, time_s()});
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (robots_[i].is_out) continue;
    if (orders[i].kind != Order::Kind::keep) follow(robots_[i], orders[i]);
  }
  is_explored_ = std::ranges::all_of(
      robots_, [](Robot const& robot) { return robot.is_out || robot.order.kind == Order::Kind::home; });
}

void Exploration::make_room() {
  if (robots_.size() == 1) return;
  std::vector<GivingWay::Member> members;
  for (auto const& robot : robots_) {
    bool const wants_on = robot.navigator.goal() && robot.navigator.state() != Navigator::State::arrived;
    members.push_back({robot.carrier.pose().position, wants_on, time_s() - robot.stood_since_s});
  }
  auto const cells = giving_way_.decide(*map_, *roads_, members, settings_.carrier.radius_m, time_s());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto& robot = robots_[i];
    bool const was_aside = std::exchange(robot.is_aside, cells[i].has_value());
    if (cells[i])
      robot.navigator.go_to(*cells[i]);
    else if (was_aside)
      follow(robot, Order(robot.order));
  }
}

void Exploration::plan_ways() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto& robot = robots_[i];
    if (!robot.navigator.goal()) continue;
    Roads const roads{*map_, *roads_, *search_};
    auto const& pose = robot.carrier.pose();
    auto near = others_than(i, settings_.carrier.radius_m + settings_.carrier.safe_distance_m + 0.1);
    std::erase_if(near, [&](Disc const& disc) {
      double const far_m = distance_m(disc.middle, pose.position);
      return far_m > 3.0 || far_m < disc.radius_m;
    });
    robot.navigator.plan(roads, pose, near);
    // Where others leave no way, it goes up to them and waits.
    if (robot.navigator.state() == Navigator::State::blocked && !near.empty()) robot.navigator.plan(roads, pose, {});
  }
}

void Exploration::follow(Robot& robot, Order const& order) {
  robot.order = order;
  robot.is_blocked = false;
  if (robot.is_aside) return;
  switch (order.kind) {
    case Order::Kind::go: robot.navigator.go_to(order.goal); break;
    case Order::Kind::home:
      if (auto const home = home_of(robot); home && settings_.does_return && !is_home(robot))
        robot.navigator.go_to(*home);
      else
        robot.navigator.stop();
      break;
    case Order::Kind::steer: robot.navigator.stop(); break;
    case Order::Kind::keep: break;
  }
}

std::optional<Cell> Exploration::home_of(Robot const& robot) const {
  auto const cell = map_->cell_at(robot.start.position);
  if (map_->is_standable(cell)) return cell;
  auto const node = roads_->node_near(cell);
  return node ? std::optional(roads_->place_of(*node)) : std::nullopt;
}

bool Exploration::is_home(Robot const& robot) const {
  return distance_m(robot.carrier.pose().position, robot.start.position) <
         (robots_.size() == 1 ? home_m : home_among_others_m);
}

void Exploration::mind_energy() {
  for (auto& robot : robots_) {
    if (robot.is_out) continue;
    auto const home = home_of(robot);
    auto const here = roads_->node_near(map_->cell_at(robot.carrier.pose().position));
    if (!home || !here) continue;
    auto const end = roads_->node_near(*home);
    if (!end) continue;
    auto const tree = roads_->from(*end);
    double const needed_m = 1.2 * static_cast<double>(tree.distance_m[*here]) + 1.0;
    if (settings_.energy_m - robot.carrier.driven_m() > needed_m) continue;
    robot.is_out = true;
    robot.is_low = robot.order.kind != Order::Kind::home;
    robot.order.kind = Order::Kind::home;
    robot.navigator.go_to(*home);
  }
}

void Exploration::mind_standing() {
  for (auto& robot : robots_) {
    auto const& place = robot.carrier.pose().position;
    if (distance_m(place, robot.stood_at) > 0.1 || robot.order.kind == Order::Kind::keep) {
      robot.stood_at = place;
      robot.stood_since_s = time_s();
    }
    robot.is_blocked = time_s() - robot.stood_since_s > blocked_after_s;
  }
  is_stuck_ =
      std::ranges::all_of(robots_, [&](Robot const& robot) { return time_s() - robot.stood_since_s > stuck_after_s; });
}

Motion Exploration::steered(Robot const& robot) const {
  auto const& pose = robot.carrier.pose();
  bool const is_near = map_->is_near_wall(map_->cell_at(pose.position));
  double const speed = is_near ? settings_.carrier.near_speed_m_s : settings_.carrier.speed_m_s;
  if (robot.order.kind == Order::Kind::steer) {
    double const off = geo::wrap_pi(robot.order.yaw_rad - pose.yaw_rad);
    return {std::abs(off) > 0.5 ? 0.0 : std::min(speed, robot.order.speed_m_s), 2.5 * off};
  }
  return {};
}

void Exploration::drive() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto& robot = robots_[i];
    auto const pose = robot.carrier.pose();
    auto const others = others_than(i, settings_.carrier.radius_m + settings_.carrier.safe_distance_m);
    bool const is_near = map_->is_near_wall(map_->cell_at(pose.position));
    double const wanted_m = settings_.carrier.radius_m + settings_.carrier.safe_distance_m;
    double const kept_m = map_->has_room(pose.position, wanted_m) ? wanted_m : settings_.carrier.radius_m + 0.01;
    double const speed = is_near ? settings_.carrier.near_speed_m_s : settings_.carrier.speed_m_s;
    auto const wanted = robot.navigator.goal() ? robot.navigator.steer(*map_, pose, speed) : steered(robot);
    robot.carrier.drive(wanted, step_s, [&](Place const& place) {
      // Whoever stands too near to something already may go where it just fits.
      bool const has_room = map_->is_standable(map_->cell_at(place)) || map_->has_room(place, kept_m);
      if (!has_room) return false;
      return std::ranges::all_of(others, [&](Disc const& disc) {
        double const far_m = distance_m(place, disc.middle);
        return far_m >= disc.radius_m || far_m > distance_m(pose.position, disc.middle);
      });
    });
  }
}

void Exploration::walk() {
  if (settings_.people == 0) return;
  walkers_.step(*world_, step_s, robots_but(robots_.size(), 0.0), random_);
}

void Exploration::check_collisions() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto const& place = robots_[i].carrier.pose().position;
    if (!world_->has_room(place, settings_.carrier.radius_m)) ++collisions_;
    for (auto const& disc : others_than(i, settings_.carrier.radius_m)) {
      if (distance_m(place, disc.middle) < disc.radius_m) ++collisions_;
    }
  }
}

bool Exploration::is_over() {
  if (time_s() >= settings_.most_time_s || is_stuck_) return true;
  return is_explored_ &&
         std::ranges::all_of(robots_, [&](Robot const& robot) { return !settings_.does_return || is_home(robot); });
}

RunReport Exploration::report() const {
  RunReport report;
  for (auto const& robot : robots_) {
    report.starts.push_back(robot.start);
    report.longest_travel_m = std::max(report.longest_travel_m, robot.carrier.driven_m());
  }
  report.travel_m = travel_m();
  report.time_s = time_s();
  report.coverage = coverage();
  bool const is_low = std::ranges::any_of(robots_, &Robot::is_low);
  report.ending = is_explored_ ? (is_low ? Ending::energy : Ending::explored)
                  : is_stuck_  ? Ending::stuck
                               : Ending::time;
  report.is_finished =
      is_explored_ && !is_low && std::ranges::all_of(robots_, [&](Robot const& robot) { return is_home(robot); });
  report.travel_to_99_m = travel_to_99_m_;
  report.time_to_99_s = time_to_99_s_;
  report.collisions = collisions_;
  return report;
}

}  // namespace lapwing::explore
