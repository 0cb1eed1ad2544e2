#include "host/car_park/lot_score.hpp"

#include <limits>
#include <optional>

namespace lapwing::host {

namespace {

constexpr double found_within_m = 1.0;
constexpr double invented_beyond_m = 1.5;

struct Nearest {
  std::size_t slot = 0;
  double distance_m = std::numeric_limits<double>::infinity();
};

Nearest nearest_to(map::Slot const& slot, CarParkTruth const& truth) {
  Nearest nearest;
  auto const& ring = slot.outline.rings.front();
  auto const middle = explore::middle_of({ring[0], ring[1], ring[2], ring[3]});
  for (std::size_t i = 0; i < truth.slots.size(); ++i) {
    double const away_m = geo::distance_m(explore::middle_of(truth.slots[i].outline), middle);
    if (away_m < nearest.distance_m) nearest = {i, away_m};
  }
  return nearest;
}

}  // namespace

LotScore score_of(std::vector<map::Slot> const& found, CarParkTruth const& truth) {
  LotScore score{.true_slots = static_cast<int>(truth.slots.size())};
  double sum_m = 0.0;
  std::vector<bool> is_found(truth.slots.size(), false);
  for (auto const& slot : found) {
    auto const nearest = nearest_to(slot, truth);
    if (nearest.distance_m > invented_beyond_m) ++score.invented;
    if (nearest.distance_m > found_within_m || is_found[nearest.slot]) continue;
    is_found[nearest.slot] = true;
    ++score.found;
    sum_m += nearest.distance_m;
    if (slot.state == map::SlotState::unknown) continue;
    ++score.told;
    score.right += (slot.state == map::SlotState::taken) == truth.slots[nearest.slot].is_taken ? 1 : 0;
  }
  if (score.found > 0) score.off_m = sum_m / score.found;
  return score;
}

}  // namespace lapwing::host
