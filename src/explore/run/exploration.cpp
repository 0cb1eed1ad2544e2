#include "explore/run/exploration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::explore {

namespace {

constexpr int steps_a_look = 5;  ///< the map is kept up twice a second (seed 001)
constexpr double scan_again_m = 0.1;
constexpr double sonar_side_m = 5.0;
constexpr double sonar_front_m = 7.5;

KnownMap::Distances distances_of(Settings const& settings) {
  return {.keep_off_m = settings.carrier.radius_m + settings.carrier.safe_distance_m, .wary_m = settings.wary_m};
}

}  // namespace

std::string_view to_string(Ending ending) {
  switch (ending) {
    case Ending::explored: return "explored";
    case Ending::energy: return "energy";
    case Ending::no_news: return "no news";
    case Ending::stuck: return "stuck";
    case Ending::time: return "time";
  }
  return "";
}

base::Result<Exploration> Exploration::begin(std::shared_ptr<World const> world, Settings const& settings,
                                             std::vector<Pose> starts) {
  if (starts.empty() || starts.size() != static_cast<std::size_t>(settings.robots))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{} robots have {} places to start", settings.robots, starts.size()));
  for (auto const& start : starts) {
    if (!world->has_room(start.position, settings.carrier.radius_m))
      return base::fail(base::ErrorKind::invalid_input, "a robot would touch a wall where it starts");
  }
  Exploration exploration(std::move(world), settings, starts);
  ExplorerSettings const leading{.strategy = settings.strategy,
                                 .carrier = settings.carrier,
                                 .range_m = settings.laser.range_m,
                                 .energy_m = settings.energy_m,
                                 .does_return = settings.does_return};
  if (settings.strategy == known_floor) {
    if (starts.size() > 1)
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("`{}` leads one robot, not {}", known_floor, starts.size()));
    auto strategy = std::make_unique<KnownFloor>(exploration.true_floor(), starts.front().position);
    exploration.explorer_ = std::make_unique<Explorer>(*exploration.map_, leading, starts, std::move(strategy));
    return exploration;
  }
  auto explorer = Explorer::begin(*exploration.map_, leading, starts);
  if (!explorer) return std::unexpected(explorer.error());
  exploration.explorer_ = std::make_unique<Explorer>(std::move(*explorer));
  return exploration;
}

TrueFloor Exploration::true_floor() const {
  TrueFloor floor{KnownMap(world_->width(), world_->height(), world_->cell_m(), distances_of(settings_)),
                  world_->is_wanted(), settings_.laser.range_m};
  for (std::size_t i = 0; i < floor.is_wanted.size(); ++i) {
    auto const cell = floor.map.cell_of(i);
    floor.map.learn(cell, world_->is_free_at(cell) ? Knowledge::free : Knowledge::wall);
  }
  return floor;
}

Exploration::Exploration(std::shared_ptr<World const> world, Settings const& settings, std::vector<Pose> const& starts)
    : world_(std::move(world)),
      settings_(settings),
      random_(settings.seed),
      walkers_(*world_, settings.people, starts, random_) {
  map_ = std::make_unique<KnownMap>(world_->width(), world_->height(), world_->cell_m(), distances_of(settings));
  is_counted_ = DenseGrid<std::uint8_t>(world_->width(), world_->height(), 0);
  for (auto const& start : starts) robots_.push_back({.carrier = Carrier(start, settings.carrier), .start = start});
}

bool Exploration::step() {
  if (steps_ % steps_a_look == 0) {
    look();
    count_seen();
    lead();
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
    auto own_scan = scan(*world_, pose, settings_.laser, others, random_);
    own_scan.time_s = time_s();
    map_->add(own_scan, robots_but(i, 0.15));
    if (robot.track.empty() || distance_m(robot.track.back(), pose.position) > 0.05)
      robot.track.push_back(pose.position);
  }
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

SideDistances Exploration::sides_of(std::size_t robot) const {
  auto const pose = robots_[robot].carrier.pose();
  auto const others = others_than(robot, 0.0);
  auto const at = [&](double yaw, double range_m) {
    return sonar_m(*world_, pose.position, pose.yaw_rad + yaw, range_m, others);
  };
  constexpr double right_angle = std::numbers::pi / 2.0;
  return {at(right_angle, sonar_side_m), at(0.0, sonar_front_m), at(-right_angle, sonar_side_m)};
}

void Exploration::lead() {
  std::vector<RobotNow> now;
  for (std::size_t i = 0; i < robots_.size(); ++i)
    now.push_back({robots_[i].carrier.pose(), robots_[i].carrier.driven_m(), [this, i] { return sides_of(i); }});
  auto const people = walkers_.discs();
  explorer_->update(*map_, time_s(), now, people);
}

void Exploration::drive() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    auto& robot = robots_[i];
    auto const pose = robot.carrier.pose();
    double const apart_m = settings_.carrier.radius_m + settings_.carrier.safe_distance_m;
    auto others = others_than(i, apart_m);
    // Others may still come as far as their brakes let them: who counts on less meets them half way.
    for (std::size_t j = 0; j < robots_.size(); ++j) {
      if (j == i) continue;
      for (auto const& place : robots_[j].carrier.braking_places(step_s))
        others.push_back({place, settings_.carrier.radius_m + apart_m});
    }
    double const wanted_m = settings_.carrier.radius_m + settings_.carrier.safe_distance_m;
    // Ways out of where nobody may stand lead over what the robot fits on, even where it has all its room now.
    bool const may_stand = map_->is_standable(map_->cell_at(pose.position));
    double const kept_m = may_stand ? wanted_m : settings_.carrier.radius_m + 0.01;
    auto const wanted = explorer_->motion(*map_, i, pose);
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

bool Exploration::is_over() const {
  return time_s() >= settings_.most_time_s || explorer_->is_stuck() || explorer_->is_over();
}

RunReport Exploration::report() const {
  RunReport report;
  bool are_home = true;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    report.starts.push_back(robots_[i].start);
    report.longest_travel_m = std::max(report.longest_travel_m, robots_[i].carrier.driven_m());
    are_home = are_home && explorer_->is_home(i);
  }
  report.travel_m = travel_m();
  report.time_s = time_s();
  report.coverage = coverage();
  bool const is_explored = explorer_->is_explored();
  bool const is_low = explorer_->is_any_low();
  bool const has_no_news = explorer_->has_no_news();
  report.is_finished = is_explored && !is_low && !has_no_news && are_home;
  if (time_s() >= settings_.most_time_s) report.ending = Ending::time;
  if (explorer_->is_stuck()) report.ending = Ending::stuck;
  if (is_explored) report.ending = is_low ? Ending::energy : has_no_news ? Ending::no_news : Ending::explored;
  report.travel_to_99_m = travel_to_99_m_;
  report.time_to_99_s = time_to_99_s_;
  report.collisions = collisions_;
  return report;
}

}  // namespace lapwing::explore
