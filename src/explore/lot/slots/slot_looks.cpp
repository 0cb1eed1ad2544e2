#include "explore/lot/slots/slot_looks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

bool comes_before(Look const& a, Look const& b) {
  auto const key = [](Look const& look) {
    return std::tie(look.at, look.by, look.from.v.x(), look.from.v.y(), look.from.v.z(), look.log_likelihood);
  };
  return key(a) < key(b);
}

base::Duration between(base::UtcTime from, base::UtcTime to) {
  return std::chrono::duration_cast<base::Duration>(to - from);
}

/// A prior of exactly 0 or 1 would never learn.
double bounded(double chance) {
  constexpr double surest = 1e-6;
  return std::clamp(chance, surest, 1.0 - surest);
}

}  // namespace

double independence_of(Look const& a, Look const& b, Independence const& independence) {
  double const by_place = geo::distance_m(a.from, b.from) / independence.apart_m;
  double const by_time = std::abs(base::to_seconds(between(a.at, b.at))) / base::to_seconds(independence.apart_in_time);
  return std::min(1.0, by_place + by_time);
}

bool SlotLooks::add(Look look) {
  if (before_ && look.at < before_->at) return false;
  looks_.insert(std::ranges::upper_bound(looks_, look, comes_before), std::move(look));
  return true;
}

double SlotLooks::novelty_of(Look const& look, Independence const& independence) const {
  double novelty = 1.0;
  if (folded_) novelty = independence_of(look, *folded_, independence);
  for (auto const& other : looks_) novelty = std::min(novelty, independence_of(look, other, independence));
  return novelty;
}

/// By those before it: what it says that they had not.
double SlotLooks::weight_of(std::size_t look, Independence const& independence) const {
  double weight = folded_ ? independence_of(looks_[look], *folded_, independence) : 1.0;
  for (std::size_t i = 0; i < look; ++i)
    weight = std::min(weight, independence_of(looks_[i], looks_[look], independence));
  return weight;
}

SlotLooks::Belief SlotLooks::after(std::size_t looks, Turnover const& turnover,
                                   Independence const& independence) const {
  Belief belief = before_.value_or(Belief{.chance = turnover.taken_share, .at = {}});
  bool is_first = !before_;
  for (std::size_t i = 0; i < looks; ++i) {
    auto const& look = looks_[i];
    if (!is_first)
      belief.chance = aged(belief.chance, turnover.taken_share, between(belief.at, look.at), turnover.memory);
    is_first = false;
    belief.chance = chance_of(log_odds_of(bounded(belief.chance)) + weight_of(i, independence) * look.log_likelihood);
    belief.at = look.at;
  }
  return belief;
}

double SlotLooks::taken_chance(base::UtcTime now, Turnover const& turnover, Independence const& independence) const {
  if (looks_.empty() && !before_) return turnover.taken_share;
  auto const belief = after(looks_.size(), turnover, independence);
  return aged(belief.chance, turnover.taken_share, between(belief.at, now), turnover.memory);
}

void SlotLooks::take_in(SlotLooks const& other) {
  for (auto const& look : other.looks_) add(look);
}

void SlotLooks::fold(Turnover const& turnover, Independence const& independence) {
  if (looks_.size() <= most_kept) return;
  auto const surplus = looks_.size() - most_kept;
  before_ = after(surplus, turnover, independence);
  folded_ = looks_[surplus - 1];
  looks_.erase(looks_.begin(), looks_.begin() + static_cast<std::ptrdiff_t>(surplus));
}

}  // namespace lapwing::explore
