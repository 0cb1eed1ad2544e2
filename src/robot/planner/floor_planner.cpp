#include "robot/planner/floor_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "explore/floor/ray.hpp"
#include "explore/strategy/gain.hpp"

namespace lapwing::robot {

using explore::Cell;
using explore::Disc;
using explore::Knowledge;
using explore::operator+;

namespace {

constexpr double blocked_after_s = 15.0;  ///< the strategy is told then
constexpr double least_move_m = 0.1;
constexpr double gain_reach_m = 5.0;
constexpr double home_within_m = 0.5;
constexpr double mind_within_m = 2.5;  ///< what moves farther away may be gone when the robot gets there
constexpr std::size_t most_obstacles = 200;
/// Farther than the board's own safe distance, which would stop a robot that only just fits.
constexpr double beyond_safe_m = 0.05;
/// Held up on a free way, by its board or by what its laser does not see, it goes back the way it came, and for a while
/// does not come by what is ahead of it there.
constexpr double back_off_after_s = 5.0;
constexpr double back_off_s = 3.0;
constexpr double back_off_m_s = 0.08;
constexpr double bump_ahead_m = 0.12;  ///< of the hull
constexpr double bump_lasts_s = 90.0;
constexpr std::size_t most_bumps = 8;
constexpr int most_back_offs = 8;       ///< about one place, before an errand has failed
constexpr int back_offs_of_a_goal = 3;  ///< before a strategy is told that it is cut off
constexpr double elsewhere_m = 1.0;
constexpr double into_the_open_m = 1.0;

explore::CarrierLimits carrier_limits(Limits const& limits) {
  return {.radius_m = limits.radius_m,
          .safe_distance_m = limits.safe_distance_m,
          .speed_m_s = limits.speed_m_s,
          .near_speed_m_s = limits.near_speed_m_s,
          .acceleration_m_s2 = limits.acceleration_m_s2,
          .turn_rad_s = limits.turn_rad_s};
}

int cells_a_side(PlannerOptions const& options) {
  return 2 * static_cast<int>(std::ceil(0.5 * options.side_m / options.cell_m));
}

}  // namespace

FloorPlanner::FloorPlanner(PlannerOptions const& options)
    : options_(options),
      half_m_(0.5 * cells_a_side(options) * options.cell_m),
      navigator_(carrier_limits(options.limits)) {
  auto const cells = cells_a_side(options);
  known_ = std::make_unique<explore::KnownMap>(
      cells, cells, options.cell_m,
      explore::KnownMap::Distances{
          .keep_off_m = options.limits.radius_m + options.limits.safe_distance_m + beyond_safe_m,
          .wary_m = options.wary_m});
  roads_ = std::make_unique<explore::RoadMap>(*known_);
  search_ = std::make_unique<explore::GridSearch>(*known_);
  frontiers_ = std::make_unique<explore::Frontiers>(*known_);
}

explore::Place FloorPlanner::on_floor(Place const& place) const {
  return {place.x() + half_m_, place.y() + half_m_};
}

Place FloorPlanner::on_map(explore::Place const& place) const {
  return {place.x() - half_m_, place.y() - half_m_};
}

void FloorPlanner::learn(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& changed) {
  auto const shift = known_->width() / 2;
  for (auto const key : changed) {
    auto const tile = grid.tiles().find(key);
    for (int y = 0; y < map::tile_cells; ++y) {
      for (int x = 0; x < map::tile_cells; ++x) {
        Cell const cell{key.x * map::tile_cells + x + shift, key.y * map::tile_cells + y + shift};
        if (!known_->contains(cell)) continue;
        auto const knowledge =
            tile == grid.tiles().end()
                ? Knowledge::unknown
                : explore::knowledge_of(tile->second->cells[static_cast<std::size_t>(y * map::tile_cells + x)]);
        auto const before = known_->at(cell);
        if (before == knowledge) continue;
        if (before == Knowledge::free) --free_cells_;
        if (knowledge == Knowledge::free) ++free_cells_;
        known_->learn(cell, knowledge);
      }
    }
  }
  roads_->update(*known_, known_->take_changes());
}

base::Result<> FloorPlanner::begin(Errand errand) {
  if (auto const* const exploring = std::get_if<ExploreErrand>(&errand)) {
    auto made = explore::make_strategy(exploring->strategy);
    if (!made) return std::unexpected(made.error());
    strategy_ = *std::move(made);
    frontiers_ = std::make_unique<explore::Frontiers>(*known_);
  }
  errand_ = std::move(errand);
  order_ = {};
  navigator_.stop();
  is_new_ = true;
  back_offs_ = 0;
  back_offs_of_goal_ = 0;
  return {};
}

void FloorPlanner::note_standing(Situation const& situation) {
  Place const here(situation.pose.x, situation.pose.y);
  if (!is_new_ && geo::distance_m(here, stood_at_) < least_move_m) return;
  stood_at_ = here;
  stood_since_s_ = situation.time_s;
}

bool FloorPlanner::is_held_up(Situation const& situation, Plan const& plan) const {
  bool const has_way = plan.state == Plan::State::under_way && !plan.way.points.empty();
  return has_way && situation.time_s - stood_since_s_ > back_off_after_s;
}

void FloorPlanner::begin_back_off(Situation const& situation) {
  Place const here(situation.pose.x, situation.pose.y);
  if (geo::distance_m(here, backed_off_at_) > elsewhere_m) {
    backed_off_at_ = here;
    back_offs_ = 0;
  }
  ++back_offs_;
  ++back_offs_of_goal_;
  backs_until_s_ = situation.time_s + back_off_s;
  back_off_yaw_ = situation.pose.yaw;
  double const ahead_m = options_.limits.radius_m + bump_ahead_m;
  Place const bump(here.x() + ahead_m * std::cos(situation.pose.yaw),
                   here.y() + ahead_m * std::sin(situation.pose.yaw));
  bumps_.push_back({bump, situation.time_s + bump_lasts_s});
  if (bumps_.size() > most_bumps) bumps_.erase(bumps_.begin());
}

std::vector<Disc> FloorPlanner::obstacles(Situation const& situation) const {
  std::vector<Disc> discs;
  double const radius_m = options_.limits.radius_m + options_.limits.safe_distance_m + options_.cell_m;
  for (auto const& bump : bumps_)
    if (situation.time_s < bump.until_s) discs.push_back({on_floor(bump.place), radius_m});
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
  if (std::holds_alternative<std::monostate>(errand_)) return {};
  note_standing(situation);
  if (situation.time_s < backs_until_s_)
    return {.state = Plan::State::under_way, .way = {.yaw_rad = back_off_yaw_, .speed_m_s = -back_off_m_s}};
  explore::Pose const pose{on_floor({situation.pose.x, situation.pose.y}), situation.pose.yaw};
  Plan plan;
  if (std::holds_alternative<ExploreErrand>(errand_)) {
    plan = explore(situation, pose);
  } else if (auto const* const driving = std::get_if<DriveErrand>(&errand_)) {
    plan = drive(situation, pose, driving->to, driving->within_m);
  } else {
    plan = drive(situation, pose, Place(0.0, 0.0), home_within_m);
  }
  is_new_ = false;
  if (is_held_up(situation, plan)) begin_back_off(situation);
  if (back_offs_ > most_back_offs && !std::holds_alternative<ExploreErrand>(errand_))
    return {
        .state = Plan::State::failed,
        .reason = fmt::format("it was held up {} times there: something stands in its way that its map does not show",
                              most_back_offs)};
  double const stood_s = situation.time_s - stood_since_s_;
  if (plan.state == Plan::State::under_way && stood_s > options_.give_up_s)
    return {.state = Plan::State::failed,
            .reason = fmt::format("it has not got on for {:.0f} s: something stands in its way", stood_s)};
  return plan;
}

Plan FloorPlanner::explore(Situation const& situation, explore::Pose const& pose) {
  bool const has_stood =
      situation.time_s - stood_since_s_ > blocked_after_s || back_offs_of_goal_ >= back_offs_of_a_goal;
  explore::RobotView const view{.pose = pose,
                                .start = {on_floor({0.0, 0.0}), 0.0},
                                .sides = [&situation] { return situation.sides; },
                                .goal = navigator_.goal(),
                                .has_arrived = navigator_.state() == explore::Navigator::State::arrived,
                                .is_blocked = has_stood || navigator_.state() == explore::Navigator::State::blocked,
                                .is_out = false,
                                .driven_m = situation.driven_m};
  auto const orders = strategy_->decide({*known_, *roads_, *frontiers_, {&view, 1}, situation.time_s});
  auto const& order = orders.front();
  if (order.kind != explore::Order::Kind::keep) order_ = order;
  switch (order.kind) {
    case explore::Order::Kind::go:
      navigator_.go_to(order.goal);
      back_offs_of_goal_ = 0;
      break;
    case explore::Order::Kind::steer: navigator_.stop(); break;
    case explore::Order::Kind::home: return {.state = Plan::State::done};
    case explore::Order::Kind::keep: break;
  }
  if (order_.kind == explore::Order::Kind::steer) {
    bool const is_near = known_->is_near_wall(known_->cell_at(pose.position));
    double const speed = is_near ? options_.limits.near_speed_m_s : options_.limits.speed_m_s;
    return {.state = Plan::State::under_way,
            .way = {.yaw_rad = order_.yaw_rad, .speed_m_s = std::min(speed, order_.speed_m_s)}};
  }
  auto plan = follow(situation, pose);
  plan.state = Plan::State::under_way;  // what cannot be reached is the strategy's to give up
  return plan;
}

template <class Fits>
std::optional<Cell> FloorPlanner::standable_near(Cell middle, double within_m, Fits const& fits) const {
  int const reach = static_cast<int>(within_m / options_.cell_m);
  std::optional<Cell> best;
  double least = reach + 0.5;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      auto const cell = middle + Cell{x, y};
      double const far = std::hypot(x, y);
      if (far >= least || !known_->is_standable(cell) || !fits(cell)) continue;
      best = cell;
      least = far;
    }
  }
  return best;
}

std::optional<Cell> FloorPlanner::standable_near(Place const& place, double within_m) const {
  return standable_near(cell_at(place), within_m, [](Cell) { return true; });
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
  return follow(situation, pose);
}

/// Where a loop has moved the map, the robot finds itself nearer to a wall than ways keep, and none begins there: it
/// goes to the nearest place from which there is one, if nothing stands between.
Way FloorPlanner::way_into_the_open(explore::Pose const& pose) const {
  auto const here = known_->cell_at(pose.position);
  if (known_->is_standable(here)) return {};
  auto const is_free = [&](Cell cell) { return known_->at(cell) == Knowledge::free; };
  auto const open =
      standable_near(here, into_the_open_m, [&](Cell cell) { return explore::is_line_clear(here, cell, is_free); });
  if (!open) return {};
  return {.points = {on_map(pose.position), on_map(known_->middle(*open))},
          .speed_m_s = options_.limits.near_speed_m_s};
}

Plan FloorPlanner::follow(Situation const& situation, explore::Pose const& pose) {
  using State = explore::Navigator::State;
  if (!navigator_.goal()) return {.state = Plan::State::under_way};
  explore::Roads const roads{*known_, *roads_, *search_};
  auto const closed = obstacles(situation);
  navigator_.plan(roads, pose, closed);
  // Where others leave no way, it goes up to them and waits.
  if (navigator_.state() == State::blocked && !closed.empty()) navigator_.plan(roads, pose, {});
  Plan plan{.state = Plan::State::under_way, .goal = on_map(known_->middle(*navigator_.goal()))};
  if (navigator_.state() == State::arrived) {
    plan.state = Plan::State::done;
    return plan;
  }
  if (navigator_.state() == State::blocked) {
    plan.way = way_into_the_open(pose);
    return plan;
  }
  bool const is_near = known_->is_near_wall(known_->cell_at(pose.position));
  plan.way.speed_m_s = is_near ? options_.limits.near_speed_m_s : options_.limits.speed_m_s;
  // It keeps count of what has been passed, and so sees when the way is at its end.
  (void)navigator_.steer(*known_, pose, plan.way.speed_m_s);
  if (navigator_.state() == State::arrived) {
    plan.state = Plan::State::done;
    return plan;
  }
  // What lies behind it is left out: the path was made some metres ago.
  auto const& path = navigator_.path();
  auto const here = std::ranges::min_element(
      path, {}, [&](Cell cell) { return geo::distance_m(known_->middle(cell), pose.position); });
  for (auto const cell : std::ranges::subrange(here, path.end()))
    plan.way.points.push_back(on_map(known_->middle(cell)));
  auto const from = known_->cell_at(pose.position);
  auto const can_stand = [&](Cell cell) { return known_->is_standable(cell); };
  plan.way.clear_to = 0;
  for (auto to = here; to != path.end() && explore::is_line_clear(from, *to, can_stand); ++to)
    plan.way.clear_to = static_cast<std::size_t>(to - here);
  plan.way.is_to_the_end = !path.empty() && path.back() == *navigator_.goal();
  return plan;
}

Survey FloorPlanner::survey(slam::Pose2 const& pose) const {
  Survey survey{.free_m2 = static_cast<double>(free_cells_) * options_.cell_m * options_.cell_m};
  auto const root = roads_->node_near(cell_at({pose.x, pose.y}));
  if (!root) return survey;
  // With a memory of its own: what was given up is open all the same.
  explore::Frontiers frontiers(*known_);
  double unknown_m2 = 0.0;
  for (auto const& frontier : frontiers.find(*known_, *roads_, roads_->from(*root))) {
    survey.frontiers.push_back(on_map(known_->middle(frontier.middle)));
    unknown_m2 += explore::unknown_beyond_m2(*known_, frontier, gain_reach_m);
  }
  survey.coverage = survey.free_m2 > 0.0 ? survey.free_m2 / (survey.free_m2 + unknown_m2) : 0.0;
  return survey;
}

}  // namespace lapwing::robot
