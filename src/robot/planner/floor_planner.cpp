#include "robot/planner/floor_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "explore/floor/ray.hpp"

namespace lapwing::robot {

using explore::Cell;
using explore::Disc;
using explore::Knowledge;
using explore::operator+;  // NOLINT(misc-unused-using-decls): it adds cells below.

namespace {

constexpr double blocked_after_s = 25.0;  ///< the strategy is told then
constexpr double home_within_m = 0.5;
constexpr double give_up_look_s = 30.0;
constexpr double turned_rad = 0.05;
constexpr double mind_within_m = 2.5;  ///< what moves farther away may be gone when the robot gets there
constexpr std::size_t most_obstacles = 200;
/// Farther than the board's own safe distance, which would stop a robot that only just fits.
constexpr double beyond_safe_m = 0.05;
/// A large robot is wary of walls farther off than it keeps.
constexpr double wary_beyond_m = 0.15;
constexpr double set_out_m = 1.0;
constexpr double stands_by_s = 30.0;
/// So long it does not get on before it does something about it, and from one such try to the next.
constexpr double help_after_s = 4.0;
constexpr double help_beside_s = 30.0;  ///< a companion: one of the two makes room sooner
constexpr double measure_every_s = 0.5;
/// What refuses the robot stands within that of its hull, and no farther to the side of where it looks.
constexpr double refuses_within_m = 0.12;
constexpr double refuses_aside_rad = 1.2;

}  // namespace

FloorPlanner::FloorPlanner(PlannerOptions const& options)
    : options_(options), area_(options.cell_m), aside_(options.limits), navigator_(options.limits) {
  begin_anew();
}

void FloorPlanner::begin_anew() {
  double const keep_off_m = options_.limits.radius_m + options_.limits.safe_distance_m + beyond_safe_m;
  known_ = std::make_unique<explore::KnownMap>(
      area_.width(), area_.height(), options_.cell_m,
      explore::KnownMap::Distances{.keep_off_m = keep_off_m,
                                   .wary_m = std::max(options_.wary_m, keep_off_m + wary_beyond_m)});
  roads_ = std::make_unique<explore::RoadMap>(*known_);
  search_ = std::make_unique<explore::GridSearch>(*known_);
  frontiers_ = std::make_unique<explore::Frontiers>(*known_);
  all_frontiers_ = std::make_unique<explore::Frontiers>(*known_);
  theirs_.reset();
  free_cells_ = 0;
  track_ = {};
  // All of these remember cells, which are others now.
  if (auto const* const exploring = std::get_if<ExploreErrand>(&errand_))
    strategy_ = explore::make_strategy(exploring->strategy).value();
  order_ = {};
  look_round_ = {};
  navigator_.stop();
  aside_.stop();
  company_ = {};
}

void FloorPlanner::learn(Cell cell, Knowledge knowledge) {
  if (!known_->contains(cell)) return;
  auto const before = known_->at(cell);
  if (before == knowledge) return;
  if (before == Knowledge::free) --free_cells_;
  if (knowledge == Knowledge::free) ++free_cells_;
  known_->learn(cell, knowledge);
}

void FloorPlanner::learn(map::OccupancyGrid const& grid, map::TileKey key) {
  if (!area_.contains(key)) return;
  auto const tile = grid.tiles().find(key);
  auto const lowest = area_.lowest_cell_of(key);
  int index = 0;
  for (int y = 0; y < map::tile_cells; ++y) {
    for (int x = 0; x < map::tile_cells; ++x, ++index) {
      auto const evidence =
          tile == grid.tiles().end() ? map::Evidence() : tile->second->cells[static_cast<std::size_t>(index)];
      auto const cell = lowest + Cell{x, y};
      bool const is_theirs = theirs_ && !evidence.is_seen();
      learn(cell, is_theirs ? (*theirs_)[cell] : explore::knowledge_of(evidence));
    }
  }
}

void FloorPlanner::learn_all(map::OccupancyGrid const& grid) {
  for (auto const& [key, tile] : grid.tiles()) learn(grid, key);
}

void FloorPlanner::learn(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed) {
  bool const has_grown = area_.grow(changed);
  bool const forgets = std::exchange(learns_anew_, false);
  if (has_grown || forgets) {
    begin_anew();
    learn_all(grid);
    learn_theirs(grid, companions_.tiles());
  } else {
    for (auto const key : changed) learn(grid, key);
  }
  roads_->update(*known_, known_->take_changes());
}

base::Result<> FloorPlanner::begin(Errand errand) {
  if (auto const* const exploring = std::get_if<ExploreErrand>(&errand)) {
    auto made = explore::make_strategy(exploring->strategy);
    if (!made) return std::unexpected(made.error());
    strategy_ = *std::move(made);
    frontiers_ = std::make_unique<explore::Frontiers>(*known_);
    learns_anew_ = !companions_.all().empty();
    companions_.clear();
    waits_since_s_.reset();
  }
  errand_ = std::move(errand);
  order_ = {};
  is_there_ = false;
  look_round_.stop();
  navigator_.stop();
  is_new_ = true;
  recovery_.rest();
  is_recovering_ = false;
  return {};
}

/// Who set it down left it room: what nobody has seen around it and on to its laser is free until it has set out. A
/// laser at the front that looks ahead never sees where the robot stands.
void FloorPlanner::learn_start(explore::Pose const& pose) {
  explore::Shift const ahead(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
  double const room_m = known_->keep_off_m() + 2.0 * options_.cell_m;  // cells are taken whole, at both ends
  double const reach_m = room_m + options_.laser_ahead_m;
  auto const low = known_->cell_at(pose.position - explore::Shift(reach_m, reach_m));
  auto const high = known_->cell_at(pose.position + explore::Shift(reach_m, reach_m));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      auto const place = known_->middle({x, y});
      double const along_m = std::clamp((place - pose.position).v.dot(ahead.v), 0.0, options_.laser_ahead_m);
      bool const is_room = geo::distance_m(place, pose.position + along_m * ahead) <= room_m;
      if (is_room && known_->at({x, y}) == Knowledge::unknown) learn(Cell{x, y}, Knowledge::free);
    }
  }
}

/// Where it has driven it can drive again, and where it is it can be.
void FloorPlanner::learn_way(Situation const& situation, explore::Pose const& pose) {
  if (situation.driven_m < set_out_m) learn_start(pose);
  std::vector<explore::Place> places;
  places.reserve(situation.driven.size() + 1);
  for (auto const& at : situation.driven) places.push_back(on_floor({at.x, at.y}));
  places.push_back(pose.position);
  track_.lay(*known_, places);
  roads_->update(*known_, known_->take_changes());
}

/// Along the roads: the navigator draws the next metres alone.
std::optional<double> FloorPlanner::left_m(explore::Pose const& pose) const {
  if (!navigator_.goal()) return std::nullopt;
  auto const& path = navigator_.path();
  // Where the path ends at the goal it is finer than the roads are.
  if (!path.empty() && path.back() == *navigator_.goal()) {
    auto const here = std::ranges::min_element(
        path, {}, [&](Cell cell) { return geo::distance_m(known_->middle(cell), pose.position); });
    return static_cast<double>(path.end() - here) * options_.cell_m;
  }
  return road_m(pose.position, *navigator_.goal());
}

std::optional<double> FloorPlanner::road_m(explore::Place const& from, Cell to) const {
  auto const begin = roads_->node_near(known_->cell_at(from));
  auto const end = roads_->node_near(to);
  if (!begin || !end) return std::nullopt;
  auto const nodes = roads_->way(*begin, *end, {});
  if (nodes.empty()) return std::nullopt;
  double length_m = 0.0;
  auto at = from;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    auto const next = known_->middle(roads_->place_of(nodes[i]));
    length_m += geo::distance_m(at, next);
    at = next;
  }
  return length_m;
}

void FloorPlanner::note_progress(Situation const& situation, explore::Pose const& pose, Plan const& plan) {
  if (is_new_) progress_.begin(situation.time_s);
  if (!is_new_ && situation.time_s < measured_s_ + measure_every_s) return;
  measured_s_ = situation.time_s;
  progress_.note({.time_s = situation.time_s,
                  .goal = plan.goal,
                  .left_m = left_m(pose),
                  .free_m2 = static_cast<double>(free_cells_) * options_.cell_m * options_.cell_m});
  if (progress_.stalled_s(situation.time_s) == 0.0) recovery_.rest();
}

/// The nearest end of the scan before the robot, or where its hull would go next: a sonar may hear what no laser sees.
Place FloorPlanner::what_refuses(Situation const& situation) const {
  auto const& pose = situation.pose;
  Place const here(pose.x, pose.y);
  double nearest_m = options_.limits.radius_m + refuses_within_m;
  Place found(pose.x + nearest_m * std::cos(pose.yaw), pose.y + nearest_m * std::sin(pose.yaw));
  for (auto const& end : situation.seen) {
    double const far_m = geo::distance_m(here, end);
    double const off = geo::wrap_pi(std::atan2(end.y() - pose.y, end.x() - pose.x) - pose.yaw);
    if (far_m >= nearest_m || std::abs(off) > refuses_aside_rad) continue;
    nearest_m = far_m;
    found = end;
  }
  return found;
}

Recovery::Now FloorPlanner::recovery_now(Situation const& situation) const {
  return {.time_s = situation.time_s,
          .pose = situation.pose,
          .room = situation.room,
          .driven = situation.driven,
          .radius_m = options_.limits.radius_m};
}

std::optional<Way> FloorPlanner::recover(Situation const& situation, Plan const& plan) {
  auto const now = recovery_now(situation);
  if (is_recovering_) {
    if (auto way = recovery_.way(now)) return way;
    is_recovering_ = false;
    recovered_s_ = situation.time_s;
    navigator_.replan();
  }
  bool const has_way = plan.state == Plan::State::under_way && !plan.way.points.empty();
  bool const is_due = situation.time_s - recovered_s_ > help_after_s;
  double const after_s =
      company_.is_beside(on_floor({situation.pose.x, situation.pose.y})) ? help_beside_s : help_after_s;
  if (!has_way || !is_due || progress_.stalled_s(situation.time_s) < after_s) return std::nullopt;
  refusals_.note(what_refuses(situation), situation.time_s);
  progress_.allow_detour();
  recovery_.begin(now);
  is_recovering_ = true;
  return recovery_.way(now);
}

Plan FloorPlanner::given_up(Situation const& situation) const {
  double const stalled_s = progress_.stalled_s(situation.time_s);
  if (std::holds_alternative<ExploreErrand>(errand_)) return done_exploring();
  return {.state = Plan::State::failed,
          .reason = fmt::format("it has not got on for {:.0f} s: something stands in its way", stalled_s)};
}

std::vector<Disc> FloorPlanner::obstacles(Situation const& situation) const {
  std::vector<Disc> discs;
  double const radius_m = options_.limits.radius_m + options_.limits.safe_distance_m + options_.cell_m;
  for (auto const& place : refusals_.at(situation.time_s)) discs.push_back({on_floor(place), radius_m});
  auto const here = on_floor({situation.pose.x, situation.pose.y});
  for (auto const& end : situation.seen) {
    if (discs.size() == most_obstacles) break;
    auto const place = on_floor(end);
    double const far_m = geo::distance_m(place, here);
    if (far_m > mind_within_m || far_m < radius_m) continue;
    auto const cell = known_->cell_at(place);
    bool is_wall = false;
    // A wall's own ends fall a cell or two before it.
    for (int y = -3; y <= 3 && !is_wall; ++y)
      for (int x = -3; x <= 3 && !is_wall; ++x) is_wall = known_->at(cell + Cell{x, y}) != Knowledge::free;
    if (is_wall) continue;
    bool const is_covered = std::ranges::any_of(
        discs, [&](Disc const& disc) { return geo::distance_m(disc.middle, place) < 0.5 * radius_m; });
    if (!is_covered) discs.push_back({place, radius_m});
  }
  return discs;
}

Plan FloorPlanner::plan(Situation const& situation) {
  explore::Pose const pose{on_floor({situation.pose.x, situation.pose.y}), situation.pose.yaw};
  learn_way(situation, pose);
  if (std::holds_alternative<std::monostate>(errand_)) return {};
  if (stands_at_first(situation.time_s)) return {.state = Plan::State::under_way};
  Plan plan;
  if (std::holds_alternative<ExploreErrand>(errand_)) {
    plan = explore(situation, pose);
  } else if (auto const* const driving = std::get_if<DriveErrand>(&errand_)) {
    plan = drive(situation, pose, driving->to, driving->within_m);
  } else if (auto const* const looking = std::get_if<LookErrand>(&errand_)) {
    plan = look(situation, pose, *looking);
  } else {
    plan = drive(situation, pose, Place(0.0, 0.0), home_within_m);
  }
  note_progress(situation, pose, plan);
  is_new_ = false;
  if (plan.state != Plan::State::under_way) return plan;
  if (progress_.stalled_s(situation.time_s) > give_up_s()) return given_up(situation);
  if (auto way = recover(situation, plan)) plan.way = *std::move(way);
  mind_company(situation, pose, plan);
  return plan;
}

bool FloorPlanner::stands_at_first(double time_s) {
  if (!options_.looks_round || !std::holds_alternative<ExploreErrand>(errand_)) return false;
  if (!stands_since_s_) stands_since_s_ = time_s;
  constexpr double until_still_s = 15.0;
  return time_s - *stands_since_s_ < until_still_s;
}

/// First where it is, as others mostly open something soon; then it goes home, where it is in nobody's way.
Plan FloorPlanner::wait_for_companions(Situation const& situation, explore::Pose const& pose) {
  progress_.begin(situation.time_s);
  if (!waits_since_s_) waits_since_s_ = situation.time_s;
  if (situation.time_s - *waits_since_s_ < stands_by_s) return {.state = Plan::State::under_way, .waits = true};
  auto plan = drive(situation, pose, Place(0.0, 0.0), home_within_m);
  plan.state = Plan::State::under_way;
  plan.waits = true;
  return plan;
}

Plan FloorPlanner::explore(Situation const& situation, explore::Pose const& pose) {
  if (learns_anew_) return {.state = Plan::State::under_way};
  bool const has_come = is_new_ || navigator_.state() == explore::Navigator::State::arrived;
  if (options_.looks_round && has_come) look_round_.arrive(*known_, pose);
  if (auto const yaw_rad = look_round_.next(pose.yaw_rad)) {
    progress_.begin(situation.time_s);
    return {.state = Plan::State::under_way, .way = {.yaw_rad = yaw_rad, .turn_rad_s = LookRound::turn_rad_s}};
  }
  bool const has_stood = stalled_s(situation.time_s) > blocked_after_s;
  explore::RobotView view{.pose = pose,
                          .start = {on_floor({0.0, 0.0}), 0.0},
                          .sides = [&situation] { return situation.sides; },
                          .goal = navigator_.goal(),
                          .has_arrived = navigator_.state() == explore::Navigator::State::arrived,
                          .is_blocked = has_stood || navigator_.state() == explore::Navigator::State::blocked,
                          .is_out = false,
                          .driven_m = situation.driven_m};
  find_sharers(pose, situation.time_s);
  auto const [robots, mine] = views(std::move(view));
  std::vector<explore::Place> places;
  for (auto const& robot : robots) places.push_back(robot.pose.position);
  frontiers_->set_moment(situation.time_s, std::move(places));
  auto const orders = strategy_->decide({*known_, *roads_, *frontiers_, robots, situation.time_s});
  auto const& order = orders[mine];
  if (order.kind != explore::Order::Kind::keep) order_ = order;
  switch (order.kind) {
    case explore::Order::Kind::go:
      if (navigator_.goal() != order.goal) goal_since_s_ = situation.time_s;
      navigator_.go_to(order.goal);
      break;
    case explore::Order::Kind::steer:
    case explore::Order::Kind::home: navigator_.stop(); break;
    case explore::Order::Kind::keep: break;
  }
  if (order_.kind == explore::Order::Kind::home) {
    // Whoever stood in the way may leave it: it waits for that where it is.
    if (frontiers_->is_any_put_off(*known_)) return {.state = Plan::State::under_way};
    if (std::ranges::any_of(companions_.all(), [](Companion const& one) { return one.explores && !one.waits; }))
      return wait_for_companions(situation, pose);
    return done_exploring();
  }
  waits_since_s_.reset();
  if (order_.kind == explore::Order::Kind::steer) {
    bool const is_near = known_->is_near_wall(known_->cell_at(pose.position));
    double const speed = is_near ? options_.limits.near_speed_m_s : options_.limits.speed_m_s;
    return {.state = Plan::State::under_way,
            .way = {.yaw_rad = order_.yaw_rad, .speed_m_s = std::min(speed, order_.speed_m_s)}};
  }
  auto plan = follow(navigator_, situation, pose);
  plan.state = Plan::State::under_way;  // what cannot be reached is the strategy's to give up
  return plan;
}

std::optional<Cell> FloorPlanner::standable_near(Place const& place, double within_m) const {
  auto const middle = cell_at(place);
  int const reach = static_cast<int>(within_m / options_.cell_m);
  std::optional<Cell> best;
  double least = reach + 0.5;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      auto const cell = middle + Cell{x, y};
      double const far = std::hypot(x, y);
      if (far >= least || !known_->is_standable(cell)) continue;
      best = cell;
      least = far;
    }
  }
  return best;
}

Plan FloorPlanner::drive(Situation const& situation, explore::Pose const& pose, Place const& to, double within_m) {
  // The map grows while it drives, so that what could not be stood on may be by now; once there is a goal it stays.
  auto const goal = navigator_.goal() ? navigator_.goal() : standable_near(to, within_m);
  if (!goal)
    return {.state = Plan::State::failed, .reason = "its map shows no free place there: is it explored, and no wall?"};
  if (!known_->is_standable(*goal)) {
    navigator_.stop();
    auto const other = standable_near(to, within_m);
    if (!other) return {.state = Plan::State::failed, .reason = "the place has turned out not to be free"};
    navigator_.go_to(*other);
  } else {
    navigator_.go_to(*goal);
  }
  return follow(navigator_, situation, pose);
}

double FloorPlanner::give_up_s() const {
  return std::holds_alternative<LookErrand>(errand_) ? std::min(give_up_look_s, options_.give_up_s)
                                                     : options_.give_up_s;
}

double FloorPlanner::stalled_s(double time_s) const {
  if (is_new_) return 0.0;
  double const stalled_s = progress_.stalled_s(time_s);
  bool const explores = std::holds_alternative<ExploreErrand>(errand_);
  return explores ? std::min(stalled_s, time_s - goal_since_s_) : stalled_s;
}

Plan FloorPlanner::look(Situation const& situation, explore::Pose const& pose, LookErrand const& looking) {
  if (!is_there_) {
    auto plan = drive(situation, pose, looking.from, looking.within_m);
    if (plan.state != Plan::State::done) return plan;
    is_there_ = true;
  }
  // Where it has come to stand is not quite where it was to stand.
  auto const& here = situation.pose;
  double const yaw_rad =
      geo::wrap_pi(std::atan2(looking.at.y() - here.y, looking.at.x() - here.x) - looking.bearing_rad);
  if (std::abs(geo::wrap_pi(yaw_rad - here.yaw)) < turned_rad) return {.state = Plan::State::done};
  return {.state = Plan::State::under_way, .way = {.yaw_rad = yaw_rad}};
}

Plan FloorPlanner::follow(explore::Navigator& navigator, Situation const& situation, explore::Pose const& pose) {
  using State = explore::Navigator::State;
  if (!navigator.goal()) return {.state = Plan::State::under_way};
  explore::Roads const roads{*known_, *roads_, *search_};
  auto const closed = obstacles(situation);
  navigator.plan(roads, pose, closed, {});
  // By another way where the nearest one is closed; where all are, it goes up to what stands there and waits.
  if (navigator.state() == State::blocked && !closed.empty()) navigator.plan(roads, pose, closed);
  if (navigator.state() == State::blocked && !closed.empty()) navigator.plan(roads, pose, {});
  Plan plan{.state = Plan::State::under_way, .goal = on_map(known_->middle(*navigator.goal()))};
  if (navigator.state() == State::arrived) {
    plan.state = Plan::State::done;
    return plan;
  }
  if (navigator.state() == State::blocked) return plan;
  bool const is_near = known_->is_near_wall(known_->cell_at(pose.position));
  plan.way.speed_m_s = is_near ? options_.limits.near_speed_m_s : options_.limits.speed_m_s;
  // It keeps count of what has been passed, and so sees when the way is at its end.
  (void)navigator.steer(*known_, pose, plan.way.speed_m_s);
  if (navigator.state() == State::arrived) {
    plan.state = Plan::State::done;
    return plan;
  }
  // What lies behind it is left out: the path was made some metres ago.
  auto const& path = navigator.path();
  auto const here = std::ranges::min_element(
      path, {}, [&](Cell cell) { return geo::distance_m(known_->middle(cell), pose.position); });
  for (auto const cell : std::ranges::subrange(here, path.end()))
    plan.way.points.push_back(on_map(known_->middle(cell)));
  auto const from = known_->cell_at(pose.position);
  // Where it is too near to something already, what it fits on will do, as for the path: from there it would have to
  // aim at the very next cell, which lies in one of eight directions.
  bool const is_too_near = known_->is_too_near(from);
  auto const can_stand = [&](Cell cell) {
    return known_->is_standable(cell) ||
           (is_too_near && known_->has_room(known_->middle(cell), options_.limits.radius_m));
  };
  plan.way.clear_to = 0;
  for (auto to = here; to != path.end() && explore::is_line_clear(from, *to, can_stand); ++to)
    plan.way.clear_to = static_cast<std::size_t>(to - here);
  plan.way.is_to_the_end = !path.empty() && path.back() == *navigator.goal();
  return plan;
}

}  // namespace lapwing::robot
