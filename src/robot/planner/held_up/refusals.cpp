#include "robot/planner/held_up/refusals.hpp"

#include <algorithm>

namespace lapwing::robot {

namespace {

constexpr double same_m = 0.25;
constexpr double first_lasts_s = 40.0;
constexpr double most_lasts_s = 320.0;
constexpr std::size_t most_known = 50;

}  // namespace

void Refusals::note(Place const& place, double time_s) {
  auto const same =
      std::ranges::find_if(known_, [&](Refusal const& one) { return geo::distance_m(one.place, place) < same_m; });
  if (same != known_.end()) {
    same->lasts_s = std::min(2.0 * same->lasts_s, most_lasts_s);
    same->until_s = time_s + same->lasts_s;
    return;
  }
  if (known_.size() == most_known) known_.erase(std::ranges::min_element(known_, {}, &Refusal::until_s));
  known_.push_back({place, time_s + first_lasts_s, first_lasts_s});
}

std::vector<Place> Refusals::at(double time_s) const {
  std::vector<Place> places;
  for (auto const& one : known_)
    if (time_s < one.until_s) places.push_back(one.place);
  return places;
}

}  // namespace lapwing::robot
