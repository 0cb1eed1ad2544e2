#include "robot/planner/company/company.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::robot {

using explore::GivingWay;

void Company::take(std::vector<Neighbour> neighbours) {
  neighbours_ = std::move(neighbours);
  std::ranges::sort(neighbours_, {}, &Neighbour::id);
}

bool Company::is_beside(explore::Place const& place) const {
  return std::ranges::any_of(
      neighbours_, [&](Neighbour const& one) { return geo::distance_m(one.now.at, place) < GivingWay::before_m; });
}

Company::Decision Company::decide(explore::KnownMap const& map, explore::RoadMap const& roads, Neighbour const& self,
                                  double radius_m, double time_s) {
  std::vector<Neighbour const*> all = {&self};
  for (auto const& one : neighbours_) all.push_back(&one);
  std::ranges::sort(all, {}, &Neighbour::id);
  auto const first_explorer = std::ranges::find_if(all, &Neighbour::explores);
  auto const* const decides = first_explorer != all.end() ? *first_explorer : all.front();
  if (decides != &self) return {.asks = decides->asks, .is_own = false};

  std::vector<std::string> ids;
  std::vector<GivingWay::Member> members;
  for (auto const* one : all) {
    ids.push_back(one->id);
    members.push_back(one->now);
  }
  if (ids != ruled_) {
    rule_ = {};
    ruled_ = std::move(ids);
  }
  Decision decision;
  auto const cells = rule_.decide(map, roads, members, radius_m, time_s);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i]) decision.asks[ruled_[i]] = map.middle(*cells[i]);
  return decision;
}

}  // namespace lapwing::robot
