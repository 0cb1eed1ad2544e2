#include "explore/lot/survey_planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "explore/strategy/open_tour.hpp"

namespace lapwing::explore {

namespace {

constexpr double no_way = std::numeric_limits<double>::infinity();
/// More places at once make no better order.
constexpr std::size_t most_stops = 120;
/// Where there is no way.
constexpr double unreachable_s = 1e6;
/// Straight on means: no farther aside than that.
constexpr double straight_m = 0.5;

/// Along and across the rows.
struct RowFrame {
  Eigen::Vector2d along;
  Eigen::Vector2d across;
  Eigen::Vector2d least;
  Eigen::Vector2d size;

  RowFrame(geo::Polygon<geo::SiteFrame> const& area, double axis_rad)
      : along(std::cos(axis_rad), std::sin(axis_rad)), across(-along.y(), along.x()) {
    least.setConstant(no_way);
    Eigen::Vector2d most = -least;
    for (auto const& corner : area.rings.front()) {
      Eigen::Vector2d const at(along.dot(corner.v), across.dot(corner.v));
      least = least.cwiseMin(at);
      most = most.cwiseMax(at);
    }
    size = most - least;
  }
  [[nodiscard]] map::SitePoint at(double u, double v) const {
    return map::SitePoint(Eigen::Vector2d((least.x() + u) * along + (least.y() + v) * across));
  }
};

/// In the middle of as few equal parts as are no longer than `most`.
std::vector<double> parted(double length, double most) {
  auto const parts = static_cast<int>(std::max(1.0, std::ceil(length / most - 1e-9)));
  std::vector<double> middles;
  for (int i = 0; i < parts; ++i) middles.push_back((i + 0.5) * length / parts);
  return middles;
}

map::SitePoint below(AirPlace const& place) {
  return {place.x(), place.y()};
}

}  // namespace

std::string_view to_string(SurveyEnding ending) {
  switch (ending) {
    case SurveyEnding::nothing_more: return "nothing more to learn";
    case SurveyEnding::energy: return "energy";
    case SurveyEnding::time: return "time";
    case SurveyEnding::asked_to: return "asked to";
    case SurveyEnding::out_of_fence: return "out of the fence";
  }
  std::unreachable();
}

double narrowest_axis(geo::Polygon<geo::SiteFrame> const& area) {
  double best_rad = 0.0;
  double least_m = no_way;
  geo::detail::for_each_edge(area.rings.front(), [&](auto const& a, auto const& b) {
    auto const edge = b - a;
    double const axis_rad = std::atan2(edge.y(), edge.x());
    constexpr double better = 1e-6;
    double const across_m = RowFrame(area, axis_rad).size.y();
    if (across_m >= least_m - better) return;
    least_m = across_m;
    best_rad = axis_rad;
  });
  return best_rad;
}

base::Result<SurveyPlanner> SurveyPlanner::make(geo::Polygon<geo::SiteFrame> fence, SurveySettings settings,
                                                LotSettings const& lot) {
  using base::ErrorKind;
  if (auto const fault = geo::lens_fault(settings.camera))
    return base::fail(ErrorKind::invalid_input, fmt::format("the camera's lens is none: {}", *fault));
  if (!(settings.lowest_m > 0.0 && settings.lowest_m <= settings.desired_m &&
        settings.desired_m <= settings.highest_m) ||
      !std::isfinite(settings.highest_m))
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("hover heights of {}, {} and {} m are in no order", settings.lowest_m,
                                  settings.desired_m, settings.highest_m),
                      "give the lowest, the desired and the highest, above the ground");
  if (!(settings.step_m > 0.0 && settings.block_m > 0.0 && settings.flight.speed_m_s > 0.0 &&
        settings.flight.acceleration_m_s2 > 0.0 && settings.flight.climb_m_s > 0.0 && settings.flight.sink_m_s > 0.0 &&
        settings.flight.turn_rad_s > 0.0))
    return base::fail(ErrorKind::invalid_input, "a speed, an acceleration or a step of the survey is not above 0");
  double const margin_m = settings.fence_margin_m;
  double const axis_rad = geo::polygon_fault(fence) ? 0.0 : narrowest_axis(fence);
  auto routes = FenceRoutes::make(std::move(fence), margin_m);
  if (!routes) return std::unexpected(routes.error());
  SurveyPlanner planner(std::move(*routes), settings, lot);
  planner.find_poses(axis_rad);
  if (planner.poses_.empty())
    return base::fail(ErrorKind::invalid_input, "the camera shows no ground well enough from any hover height",
                      "tilt it down, or fly lower");
  return planner;
}

SurveyPlanner::SurveyPlanner(FenceRoutes fence, SurveySettings settings, LotSettings lot)
    : fence_(std::move(fence)), settings_(settings), lot_(std::move(lot)) {}

void SurveyPlanner::find_poses(double axis_rad) {
  axis_rad_ = axis_rad;
  std::vector<double> heights = {settings_.lowest_m, settings_.desired_m, settings_.highest_m};
  heights.erase(std::ranges::unique(heights).begin(), heights.end());
  for (double const height_m : heights) {
    for (double const turned : {0.0, 0.5 * std::numbers::pi}) {
      double const yaw_rad = geo::wrap_pi(axis_rad + turned);
      geo::GroundView const view{.lens = settings_.camera,
                                 .site_from_camera = geo::camera_at({0.0, 0.0, height_m}, yaw_rad, settings_.tilt_rad)};
      auto const ground = well_seen_ground(view, lot_);
      if (ground.rings.empty()) continue;
      double const coarsest_m =
          geo::ground_sampling(view, settings_.camera.middle).value_or(geo::GroundSampling{}).coarsest_m;
      Reach reach(ground.rings.front(), lot_.edge_m);
      double const least_m = 2.0 * lot_.edge_m + settings_.block_m;
      if (reach.extent_m(0.0) < least_m || reach.extent_m(0.5 * std::numbers::pi) < least_m) continue;
      poses_.push_back({height_m, yaw_rad, std::move(reach), settings_.errors.slot_error_at(coarsest_m)});
    }
  }
}

AirPlace SurveyPlanner::air_place(Stop const& stop) const {
  return {stop.place.x(), stop.place.y(), settings_.ground_up_m + poses_[stop.pose].height_m};
}

LotBits::Viewpoint SurveyPlanner::viewpoint(Stop const& stop) const {
  auto const& pose = poses_[stop.pose];
  return {.place = air_place(stop), .reach = &pose.reach, .slot_error = pose.slot_error};
}

/// Which tells most of fresh ground in a second of flying along a row.
std::size_t SurveyPlanner::row_pose() const {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    double const across_m = poses_[i].reach.extent_m(axis_rad_ + 0.5 * std::numbers::pi) - 2.0 * lot_.edge_m;
    double const rate = across_m * LotBits::fresh_a_m2(lot_, settings_.errors, poses_[i].slot_error);
    if (rate <= most) continue;
    most = rate;
    best = i;
  }
  return best;
}

std::vector<SurveyPlanner::Stop> SurveyPlanner::rows(LotMap const& lot, LotBits& bits) const {
  std::vector<Stop> stops;
  auto const pose = row_pose();
  RowFrame const frame(lot.area(), axis_rad_);
  double const along_m = poses_[pose].reach.extent_m(axis_rad_) - 2.0 * lot_.edge_m;
  double const across_m = poses_[pose].reach.extent_m(axis_rad_ + 0.5 * std::numbers::pi) - 2.0 * lot_.edge_m;
  double const least =
      settings_.row_share * along_m * across_m * LotBits::fresh_a_m2(lot_, settings_.errors, poses_[pose].slot_error);
  for (double const v : parted(frame.size.y(), across_m)) {
    for (double const u : parted(frame.size.x(), along_m)) {
      Stop stop{.place = frame.at(u, v), .pose = pose};
      if (!fence_.contains(stop.place)) continue;
      stop.bits = bits.from(viewpoint(stop));
      if (stop.bits < least) continue;
      bits.take(viewpoint(stop));
      stops.push_back(stop);
    }
  }
  return stops;
}

std::vector<SurveyPlanner::Stop> SurveyPlanner::rest(LotMap const& lot, LotBits& bits) const {
  std::vector<Stop> thought;
  RowFrame const frame(lot.area(), axis_rad_);
  for (double const v : parted(frame.size.y(), settings_.step_m)) {
    for (double const u : parted(frame.size.x(), settings_.step_m)) {
      auto const place = frame.at(u, v);
      if (!fence_.contains(place)) continue;
      for (std::size_t pose = 0; pose < poses_.size(); ++pose) {
        Stop stop{.place = place, .pose = pose};
        stop.bits = bits.from(viewpoint(stop));
        if (stop.bits >= settings_.least_bits) thought.push_back(stop);
      }
    }
  }
  // The greatest first, each counted again when its turn comes: others may have taken what it shows (Minoux 1978).
  auto const is_less = [](Stop const& a, Stop const& b) { return a.bits < b.bits; };
  std::ranges::make_heap(thought, is_less);
  std::vector<Stop> stops;
  while (!thought.empty() && stops.size() < most_stops) {
    std::ranges::pop_heap(thought, is_less);
    auto stop = thought.back();
    thought.pop_back();
    double const bits_now = bits.from(viewpoint(stop));
    if (bits_now < settings_.least_bits) continue;
    constexpr double the_same = 1e-9;
    if (bits_now < stop.bits - the_same) {
      stop.bits = bits_now;
      thought.push_back(stop);
      std::ranges::push_heap(thought, is_less);
      continue;
    }
    bits.take(viewpoint(stop));
    stops.push_back(stop);
  }
  return stops;
}

void SurveyPlanner::leave_to_others(LotBits& bits, std::span<AirPlace const> others) const {
  for (auto const& other : others) {
    // It is not known how the other looks: as one does in rows.
    Stop const stop{.place = below(other), .pose = row_pose()};
    bits.take(viewpoint(stop));
  }
}

double SurveyPlanner::seconds_between(Stop const& a, Stop const& b) const {
  auto const& from = poses_[a.pose];
  auto const& to = poses_[b.pose];
  double const way_m = route_length_m(a.place, fence_.route(a.place, b.place));
  if (!std::isfinite(way_m)) return unreachable_s;
  Eigen::Vector2d const way = b.place.v - a.place.v;
  double const aside_m = std::abs(-std::sin(axis_rad_) * way.x() + std::cos(axis_rad_) * way.y());
  bool const goes_on = a.pose == b.pose && aside_m < straight_m;
  if (goes_on) return way_m / settings_.flight.speed_m_s;
  return seconds_to_move(way_m, to.height_m - from.height_m, to.yaw_rad - from.yaw_rad, settings_.flight);
}

double SurveyPlanner::seconds_to(Stop const& stop, SurveyDrone const& drone) const {
  auto const& pose = poses_[stop.pose];
  double const way_m = route_length_m(below(drone.place), fence_.route(below(drone.place), stop.place));
  if (!std::isfinite(way_m)) return unreachable_s;
  return seconds_to_move(way_m, air_place(stop).z() - drone.place.z(), pose.yaw_rad - drone.yaw_rad, settings_.flight);
}

void SurveyPlanner::keep_worthwhile(std::vector<Stop>& stops, SurveyDrone const& drone) const {
  std::vector<Stop> kept;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    double least_s = seconds_to(stops[i], drone);
    for (std::size_t k = 0; k < stops.size(); ++k)
      if (k != i) least_s = std::min(least_s, seconds_between(stops[k], stops[i]));
    bool const is_near_by = stops[i].bits >= settings_.least_bits_a_s * least_s;
    if (is_near_by && seconds_to(stops[i], drone) < unreachable_s) kept.push_back(stops[i]);
  }
  stops = std::move(kept);
}

std::vector<std::size_t> SurveyPlanner::order(std::vector<Stop> const& stops, SurveyDrone const& drone) const {
  TourCosts costs;
  for (auto const& stop : stops) costs.from_start.push_back(seconds_to(stop, drone));
  for (auto const& a : stops) {
    auto& row = costs.between.emplace_back();
    for (auto const& b : stops) row.push_back(seconds_between(a, b));
  }
  costs.end.assign(stops.size(), 0.0);
  std::vector<std::size_t> all(stops.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return good_tour(costs, all);
}

SurveyGoal SurveyPlanner::goal_of(std::vector<Stop> const& stops, std::vector<std::size_t> const& tour,
                                  SurveyDrone const& drone) const {
  auto last = tour.front();
  double bits = stops[last].bits;
  auto const route = fence_.route(below(drone.place), stops[last].place);
  bool const is_straight = route.size() == 1;
  // What lies straight on is one leg: it is flown without stopping.
  for (std::size_t i = 1; is_straight && i < tour.size(); ++i) {
    auto const& stop = stops[tour[i]];
    auto const& before = stops[last];
    Eigen::Vector2d const leg = before.place.v - stops[tour.front()].place.v;
    Eigen::Vector2d const on = stop.place.v - before.place.v;
    Eigen::Vector2d const way =
        leg.norm() > straight_m ? leg.normalized() : (before.place.v - below(drone.place).v).normalized();
    bool const goes_on =
        stop.pose == before.pose && on.dot(way) > 0.0 && std::abs(way.x() * on.y() - way.y() * on.x()) < straight_m;
    if (!goes_on || fence_.route(below(drone.place), stop.place).size() != 1) break;
    // The first leg leads to the row, those after it along the row.
    if (leg.norm() <= straight_m && (before.place.v - below(drone.place).v).norm() > straight_m) {
      Eigen::Vector2d const to = before.place.v - below(drone.place).v;
      if (std::abs(to.x() * on.y() - to.y() * on.x()) / to.norm() > straight_m) break;
    }
    last = tour[i];
    bits += stop.bits;
  }
  auto const& stop = stops[last];
  auto const& pose = poses_[stop.pose];
  auto const first = is_straight ? stop.place : route.front();
  AirPlace const place(first.x(), first.y(), air_place(stop).z());
  return {.place = place,
          .yaw_rad = pose.yaw_rad,
          .bits = bits,
          .takes_s = seconds_to_move(geo::distance_m(below(drone.place), first), place.z() - drone.place.z(),
                                     pose.yaw_rad - drone.yaw_rad, settings_.flight)};
}

double SurveyPlanner::seconds_home(AirPlace const& place, SurveyBudget const& budget) const {
  auto const route = fence_.route(below(place), budget.home);
  double const way_m = route.empty() ? geo::distance_m(below(place), budget.home) : route_length_m(below(place), route);
  // At each bend it may have to stop.
  double const bends_s = static_cast<double>(std::max<std::size_t>(route.size(), 1) - 1) * settings_.flight.speed_m_s /
                         settings_.flight.acceleration_m_s2;
  return seconds_to_fly(way_m, settings_.flight) + bends_s;
}

map::SitePoint SurveyPlanner::toward_home(AirPlace const& place, SurveyBudget const& budget) const {
  auto const route = fence_.route(below(place), budget.home);
  // Of a bend that is reached the route still says that it is next.
  auto const next = std::ranges::find_if(
      route, [&](auto const& bend) { return geo::distance_m(bend, below(place)) > settings_.arrived_m; });
  return next == route.end() ? budget.home : *next;
}

bool SurveyPlanner::is_within(SurveyGoal const& goal, SurveyDrone const& drone, SurveyBudget const& budget) const {
  double const there_s =
      seconds_to_move(geo::distance_m(below(drone.place), below(goal.place)), goal.place.z() - drone.place.z(),
                      goal.yaw_rad - drone.yaw_rad, settings_.flight);
  return there_s <= budget.time_s && there_s + seconds_home(goal.place, budget) <= budget.flying_s;
}

bool SurveyPlanner::is_worth(SurveyGoal const& goal, LotBits const& bits) const {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    constexpr double same = 1e-3;
    if (std::abs(poses_[i].height_m + settings_.ground_up_m - goal.place.z()) > same ||
        std::abs(geo::wrap_pi(poses_[i].yaw_rad - goal.yaw_rad)) > same)
      continue;
    return bits.from(viewpoint({.place = below(goal.place), .pose = i})) >= settings_.least_bits;
  }
  return false;
}

bool SurveyPlanner::is_in_bounds(LotMap const& lot, map::SitePoint const& place, base::UtcTime now) const {
  return fence_.contains(place) && lot.is_in_lot(place, now);
}

SurveyStep SurveyPlanner::next(LotMap const& lot, SurveyDrone const& drone, SurveyBudget const& budget,
                               std::optional<SurveyGoal> const& goal, std::span<AirPlace const> others,
                               base::UtcTime now) const {
  auto const end = [&](SurveyEnding reason) { return SurveyEnd{.reason = reason, .coverage = lot.coverage()}; };
  if (budget.is_asked_to_end) return end(SurveyEnding::asked_to);
  if (budget.time_s <= 0.0) return end(SurveyEnding::time);
  if (!geo::contains(fence_.fence(), below(drone.place))) return end(SurveyEnding::out_of_fence);
  if (seconds_home(drone.place, budget) >= budget.flying_s) return end(SurveyEnding::energy);

  LotBits bits(lot, now, settings_.keeps_watching, settings_.block_m, settings_.errors);
  leave_to_others(bits, others);
  bool const is_under_way = goal && geo::distance_m(drone.place, goal->place) > settings_.arrived_m;
  if (is_under_way && is_worth(*goal, bits) && is_within(*goal, drone, budget) &&
      fence_.route(below(drone.place), below(goal->place)).size() == 1)
    return *goal;

  auto stops = rows(lot, bits);
  keep_worthwhile(stops, drone);
  if (stops.empty()) {
    stops = rest(lot, bits);
    keep_worthwhile(stops, drone);
  }
  if (stops.size() > most_stops) {
    std::ranges::stable_sort(stops, {},
                             [&](Stop const& stop) { return geo::distance_m(stop.place, below(drone.place)); });
    stops.resize(most_stops);
  }
  bool const is_enough = stops.empty();
  if (is_enough && settings_.keeps_watching) return SurveyWait{settings_.watch_again};
  if (is_enough) return end(SurveyEnding::nothing_more);

  auto next = goal_of(stops, order(stops, drone), drone);
  if (is_within(next, drone, budget)) return next;
  // Not so far any more: whatever is worth most in the time that is left.
  std::optional<SurveyGoal> best;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    auto const one = goal_of(stops, {i}, drone);
    if (!is_within(one, drone, budget)) continue;
    if (!best || one.bits / (one.takes_s + 1.0) > best->bits / (best->takes_s + 1.0)) best = one;
  }
  if (best) return *best;
  return end(budget.time_s < budget.flying_s ? SurveyEnding::time : SurveyEnding::energy);
}

}  // namespace lapwing::explore
