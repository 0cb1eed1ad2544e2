#include "perceive/memory/kept_sights.hpp"

#include <algorithm>
#include <ranges>

#include "base/text/json.hpp"
#include "perceive/memory/sight_json.hpp"

namespace lapwing::perceive {

using namespace std::chrono_literals;

namespace {

/// Half of what the map takes for another place, and all of what it takes for another time (`explore::Independence`).
constexpr double same_place_m = 2.0;
constexpr double same_way_rad = 0.3;
constexpr auto same_time = 60s;

}  // namespace

bool KeptSights::tells_again(explore::LotSight const& sight) const {
  auto const& from = sight.view.site_from_camera;
  auto const of_late = [&](Kept const& one) { return sight.at - one.at < same_time; };
  return std::ranges::any_of(kept_ | std::views::reverse | std::views::take_while(of_late), [&](Kept const& one) {
    return geo::distance_m(one.from.origin(), from.origin()) < same_place_m &&
           one.from.rotation().angularDistance(from.rotation()) < same_way_rad;
  });
}

bool KeptSights::add(explore::LotSight const& sight, bool shows_new_ground) {
  if (!shows_new_ground && tells_again(sight)) return false;
  kept_.push_back({sight.at, sight.view.site_from_camera, base::to_text(sight_json(sight)) + "\n"});
  bytes_ += kept_.back().line.size();
  while (kept_.size() > most || bytes_ > most_bytes) drop_oldest();
  return true;
}

void KeptSights::drop_oldest() {
  bytes_ -= kept_.front().line.size();
  kept_.pop_front();
}

void KeptSights::forget_before(base::UtcTime time) {
  while (!kept_.empty() && kept_.front().at < time) drop_oldest();
}

std::string KeptSights::lines() const {
  std::string all;
  all.reserve(bytes_);
  for (auto const& one : kept_) all += one.line;
  return all;
}

}  // namespace lapwing::perceive
