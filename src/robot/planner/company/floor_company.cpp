// How a planner gets past those who are about something on its floor as well.
#include <cmath>
#include <utility>

#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

namespace {

constexpr double told_ahead_m = 8.0;
constexpr double steered_m = 1.5;  ///< who follows a wall says no more of where it is going
constexpr double aside_within_m = 0.3;

}  // namespace

void FloorPlanner::meet(std::vector<Companion> companions, map::OccupancyGrid const& grid) {
  std::vector<Company::Neighbour> neighbours;
  auto const frames = companions;
  if (std::holds_alternative<ExploreErrand>(errand_)) share(std::move(companions), grid);
  // Sharing may have moved the floor's origin.
  for (auto const& one : frames) {
    auto const on_ours = [&](Place const& place) {
      auto const at = one.origin * slam::Pose2{place.x(), place.y(), 0.0};
      return on_floor({at.x, at.y});
    };
    Company::Neighbour neighbour{.id = one.id,
                                 .explores = one.explores,
                                 .now = {.at = on_ours({one.pose.x, one.pose.y}), .stood_s = one.intent.stood_s}};
    for (auto const& place : one.intent.way) neighbour.now.way.push_back(on_ours(place));
    for (auto const& [who, place] : one.intent.asks) neighbour.asks[who] = on_ours(place);
    neighbours.push_back(std::move(neighbour));
  }
  company_.take(std::move(neighbours));
}

std::vector<explore::Place> FloorPlanner::wanted_way(explore::Pose const& pose, Plan const& plan) const {
  if (plan.state != Plan::State::under_way) return {};
  auto const& here = pose.position;
  if (std::holds_alternative<ExploreErrand>(errand_) && order_.kind == explore::Order::Kind::steer)
    return {here, here + steered_m * explore::Shift(std::cos(order_.yaw_rad), std::sin(order_.yaw_rad))};
  if (!navigator_.goal() || navigator_.state() == explore::Navigator::State::arrived) return {};
  auto const begin = roads_->node_near(known_->cell_at(here));
  auto const end = roads_->node_near(*navigator_.goal());
  if (!begin || !end) return {};
  std::vector<explore::Place> way = {here};
  double so_far_m = 0.0;
  for (auto const node : roads_->way(*begin, *end, {})) {
    auto const next = known_->middle(roads_->place_of(node));
    so_far_m += geo::distance_m(way.back(), next);
    way.push_back(next);
    if (so_far_m > told_ahead_m) return way;
  }
  way.push_back(known_->middle(*navigator_.goal()));
  return way;
}

void FloorPlanner::mind_company(Situation const& situation, explore::Pose const& pose, Plan& plan) {
  if (company_.is_empty()) {
    aside_.stop();
    return;
  }
  double const stood_s = stalled_s(situation.time_s);
  Company::Neighbour const self{.id = options_.id,
                                .explores = std::holds_alternative<ExploreErrand>(errand_),
                                .now = {.at = pose.position, .stood_s = stood_s, .way = wanted_way(pose, plan)}};
  auto const decision = company_.decide(*known_, *roads_, self, options_.limits.radius_m, situation.time_s);
  plan.intent.stood_s = stood_s;
  for (auto const& place : self.now.way) plan.intent.way.push_back(on_map(place));
  if (decision.is_own)
    for (auto const& [who, place] : decision.asks) plan.intent.asks[who] = on_map(place);

  auto const own = decision.asks.find(options_.id);
  auto const place = own == decision.asks.end() ? std::nullopt : standable_near(on_map(own->second), aside_within_m);
  if (!place || plan.state != Plan::State::under_way) {
    aside_.stop();
    return;
  }
  aside_.go_to(*place);
  plan.way = follow(aside_, situation, pose).way;
  progress_.begin(situation.time_s);
}

}  // namespace lapwing::robot
