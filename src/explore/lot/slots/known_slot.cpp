#include "explore/lot/slots/known_slot.hpp"

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

double KnownSlot::there_chance() const {
  return chance_of(there_log_odds);
}

double KnownSlot::weight() const {
  double sum = fixed_weight;
  for (auto const& find : finds) sum += find.weight;
  return sum;
}

void KnownSlot::fix(Corners const& corners, double weight) {
  double const all = fixed_weight + weight;
  for (std::size_t i = 0; i < corners.size(); ++i)
    fixed[i].v = (fixed_weight * fixed[i].v + weight * corners[i].v) / all;
  fixed_weight = all;
}

}  // namespace lapwing::explore
