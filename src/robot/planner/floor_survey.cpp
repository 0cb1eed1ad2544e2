// What a planner knows of its floor as a whole.
#include <fmt/format.h>

#include "explore/strategy/gain.hpp"
#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

namespace {

constexpr double hidden_reach_m = 3.0;

}  // namespace

Survey FloorPlanner::survey() const {
  Survey survey{.free_m2 = static_cast<double>(free_cells_) * options_.cell_m * options_.cell_m};
  // With a memory of its own: what was given up is open all the same, and so is what cannot be reached.
  auto const open = all_frontiers_->find_all(*known_);
  for (auto const& frontier : open) survey.frontiers.push_back(on_map(known_->middle(frontier.middle)));
  double const unknown_m2 = explore::hidden_m2(*known_, open, hidden_reach_m);
  survey.coverage = survey.free_m2 > 0.0 ? survey.free_m2 / (survey.free_m2 + unknown_m2) : 0.0;
  return survey;
}

std::string what_is_left(Survey const& survey) {
  auto const count = survey.frontiers.size();
  if (count == 0) return {};
  return fmt::format("{} {} left unseen", count, count == 1 ? "place is" : "places are");
}

Plan FloorPlanner::done_exploring() const {
  auto const seen = survey();
  Plan plan{.state = Plan::State::done, .reason = what_is_left(seen)};
  if (!plan.reason.empty())
    plan.reason += fmt::format(": it could not get to see {}", seen.frontiers.size() == 1 ? "it" : "them");
  if (area_.is_cut_off()) {
    if (!plan.reason.empty()) plan.reason += "; ";
    plan.reason += fmt::format("the floor goes on beyond the {:.0f} by {:.0f} m in which it plans",
                               area_.width() * options_.cell_m, area_.height() * options_.cell_m);
  }
  return plan;
}

double FloorPlanner::home_m(Place const& from) const {
  Place const home(0.0, 0.0);
  return road_m(on_floor(from), cell_at(home)).value_or(geo::distance_m(from, home));
}

}  // namespace lapwing::robot
