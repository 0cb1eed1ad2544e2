// How a planner gets past those who are about something on its floor as well.
#include <utility>

#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

namespace {

constexpr double aside_within_m = 0.3;

}  // namespace

void FloorPlanner::meet(std::vector<Companion> const& companions, map::OccupancyGrid const& grid) {
  std::vector<Company::Neighbour> neighbours;
  // It may move the floor's origin.
  if (std::holds_alternative<ExploreErrand>(errand_)) share(companions, grid);
  for (auto const& one : companions) {
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

std::vector<explore::Place> FloorPlanner::wanted_way(explore::Place const& here) const {
  if (std::holds_alternative<ExploreErrand>(errand_) && order_.kind == explore::Order::Kind::steer)
    return explore::way_ahead(here, order_.yaw_rad);
  if (!navigator_.goal() || navigator_.state() == explore::Navigator::State::arrived) return {};
  return explore::way_ahead(*known_, *roads_, here, *navigator_.goal());
}

void FloorPlanner::mind_company(Situation const& situation, explore::Pose const& pose, Plan& plan) {
  if (company_.is_empty()) {
    aside_.stop();
    return;
  }
  double const stood_s = stalled_s(situation.time_s);
  Company::Neighbour const self{.id = options_.id,
                                .explores = std::holds_alternative<ExploreErrand>(errand_),
                                .now = {.at = pose.position, .stood_s = stood_s, .way = wanted_way(pose.position)}};
  auto const decision = company_.decide(*known_, *roads_, self, options_.limits.radius_m, situation.time_s);
  plan.intent.stood_s = stood_s;
  for (auto const& place : self.now.way) plan.intent.way.push_back(on_map(place));
  if (decision.is_own)
    for (auto const& [who, place] : decision.asks) plan.intent.asks[who] = on_map(place);

  auto const own = decision.asks.find(options_.id);
  auto const place = own == decision.asks.end() ? std::nullopt : standable_near(on_map(own->second), aside_within_m);
  if (!place) {
    aside_.stop();
    return;
  }
  aside_.go_to(*place);
  plan.way = follow(aside_, situation, pose).way;
  progress_.begin(situation.time_s);
}

}  // namespace lapwing::robot
