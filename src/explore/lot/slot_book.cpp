#include "explore/lot/slot_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

constexpr double most_turned_rad = std::numbers::pi / 6.0;
/// As sure as one may be that a slot is there or not: repainted lots are learned again.
constexpr double most_there = 8.0;
/// The surest that one picture may be of a slot.
constexpr double surest_find = 0.97;
/// What slots' outlines are off by beside the camera's doubt.
constexpr double outline_sigma_m = 0.2;

Look look_of(LotSight const& sight) {
  return {.at = sight.at, .from = sight.view.site_from_camera.origin(), .log_likelihood = 0.0, .by = sight.vehicle};
}

bool is_within(Corners const& outline, geo::Polygon<geo::SiteFrame> const& footprint, double clear_m) {
  return std::ranges::all_of(outline, [&](auto const& corner) {
    return geo::contains(footprint, corner) && geo::distance_to_edge_m(footprint, corner) > clear_m;
  });
}

}  // namespace

double KnownSlot::there_chance() const {
  return chance_of(there_log_odds);
}

void SlotBook::know(std::string id, Corners const& outline) {
  constexpr double sure_of_map = 4.0;
  changed_.insert(id);
  slots_.push_back({.id = std::move(id),
                    .outline = outline,
                    .there_log_odds = sure_of_map,
                    .weight = 1.0 / (outline_sigma_m * outline_sigma_m),
                    .is_confirmed = true});
}

double SlotBook::taken_chance(KnownSlot const& slot, base::UtcTime now) const {
  return slot.looks.taken_chance(now, settings_.turnover, settings_.independence);
}

bool SlotBook::is_same(Corners const& a, Corners const& b) const {
  return geo::distance_m(middle_of(a), middle_of(b)) < 0.5 * sides_of(a).width_m &&
         between_axes(axis_of(a), axis_of(b)) < most_turned_rad;
}

/// What may be the same, the nearest first.
std::vector<SlotBook::Pair> SlotBook::pairs(LotSight const& sight) const {
  std::vector<Pair> near;
  for (std::size_t found = 0; found < sight.slots.size(); ++found) {
    auto const& as = sight.slots[found];
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (!is_same(slots_[slot].outline, as.outline)) continue;
      near.push_back({geo::distance_m(middle_of(slots_[slot].outline), middle_of(as.outline)), slot, found});
    }
  }
  std::ranges::sort(near, {}, [](Pair const& pair) { return std::tie(pair.apart_m, pair.slot, pair.found); });
  return near;
}

void SlotBook::add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint) {
  auto const look = look_of(sight);
  std::vector<bool> is_known(sight.slots.size(), false);
  std::vector<SlotSight const*> found_as(slots_.size(), nullptr);
  for (auto const& pair : pairs(sight)) {
    if (is_known[pair.found] || found_as[pair.slot]) continue;
    is_known[pair.found] = true;
    found_as[pair.slot] = &sight.slots[pair.found];
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    auto& slot = slots_[i];
    if (!found_as[i] && !is_within(slot.outline, footprint, settings_.clear_m)) continue;
    double const novelty =
        slot.seen.at == base::UtcTime{} ? 1.0 : independence_of(slot.seen, look, settings_.independence);
    if (found_as[i]) {
      found(slot, sight, *found_as[i], novelty);
    } else if (novelty >= least_novelty) {
      slot.there_log_odds += novelty * std::log((1.0 - settings_.found_share) / (1.0 - settings_.false_share));
    }
    if (novelty >= least_novelty) slot.seen = look;
    judge(slot);
  }
  for (std::size_t i = 0; i < sight.slots.size(); ++i)
    if (!is_known[i]) begin(sight, sight.slots[i]);
  join_doubles();
  for (std::size_t i = slots_.size(); i-- > 0;)
    if (slots_[i].there_chance() < settings_.forgotten) drop(i);
}

void SlotBook::found(KnownSlot& slot, LotSight const& sight, SlotSight const& as, double novelty) {
  double const sigma_m = std::hypot(ground_doubt_m(sight, middle_of(as.outline)), outline_sigma_m);
  if (novelty >= least_novelty) {
    slot.there_log_odds += novelty * log_odds_of(std::clamp(as.surety, 1.0 - surest_find, surest_find));
    double const weight = novelty / (sigma_m * sigma_m);
    auto const corners = aligned(as.outline, slot.outline);
    for (std::size_t i = 0; i < corners.size(); ++i)
      slot.outline[i].v = (slot.weight * slot.outline[i].v + weight * corners[i].v) / (slot.weight + weight);
    slot.weight += weight;
  }
  if (!as.taken_chance) return;
  // It may be the neighbour that was seen, by how far the camera may be off.
  double const is_it = chance_within(0.5 * sides_of(slot.outline).width_m, sigma_m);
  double const told = std::clamp(*as.taken_chance, settings_.least_error, 1.0 - settings_.least_error);
  double const chance = is_it * told + (1.0 - is_it) * settings_.detector_prior;
  auto look = look_of(sight);
  look.log_likelihood = log_odds_of(chance) - log_odds_of(settings_.detector_prior);
  if (slot.looks.novelty_of(look, settings_.independence) < least_novelty) return;
  if (!slot.looks.add(std::move(look))) return;
  slot.looks.fold(settings_.turnover, settings_.independence);
  if (slot.is_confirmed) changed_.insert(slot.id);
}

void SlotBook::begin(LotSight const& sight, SlotSight const& as) {
  KnownSlot slot{.id = fmt::format("{}-{}", settings_.id_prefix, next_++),
                 .outline = as.outline,
                 .there_log_odds = log_odds_of(settings_.slot_prior)};
  found(slot, sight, as, 1.0);
  slot.seen = look_of(sight);
  judge(slot);
  slots_.push_back(std::move(slot));
}

void SlotBook::judge(KnownSlot& slot) {
  slot.there_log_odds = std::clamp(slot.there_log_odds, -most_there, most_there);
  if (slot.is_confirmed || slot.there_chance() < settings_.confirmed) return;
  slot.is_confirmed = true;
  changed_.insert(slot.id);
}

void SlotBook::join_doubles() {
  for (std::size_t older = 0; older < slots_.size(); ++older) {
    for (std::size_t newer = slots_.size(); --newer > older;) {
      if (!is_same(slots_[older].outline, slots_[newer].outline)) continue;
      auto& kept = slots_[older];
      kept.there_log_odds = std::max(kept.there_log_odds, slots_[newer].there_log_odds);
      kept.looks.take_in(slots_[newer].looks);
      kept.looks.fold(settings_.turnover, settings_.independence);
      judge(kept);
      if (kept.is_confirmed) changed_.insert(kept.id);
      drop(newer);
    }
  }
}

void SlotBook::drop(std::size_t index) {
  auto const& slot = slots_[index];
  changed_.erase(slot.id);
  if (slot.is_confirmed) gone_.insert(slot.id);
  slots_.erase(slots_.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace lapwing::explore
