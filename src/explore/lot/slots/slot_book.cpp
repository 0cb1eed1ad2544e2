#include "explore/lot/slots/slot_book.hpp"

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
/// A picture lies about as the one before did, if that is no older.
constexpr base::Duration shift_lasts = std::chrono::seconds(10);
/// A slot that has moved by more is told anew.
constexpr double told_again_m = 0.1;

Look look_of(LotSight const& sight) {
  return {.at = sight.at, .from = sight.view.site_from_camera.origin(), .log_likelihood = 0.0, .by = sight.vehicle};
}

bool is_within(Corners const& outline, geo::Polygon<geo::SiteFrame> const& footprint, double clear_m) {
  return std::ranges::all_of(outline, [&](auto const& corner) {
    return geo::contains(footprint, corner) && geo::distance_to_edge_m(footprint, corner) > clear_m;
  });
}

/// What pictures say of where the other one lies they say of this one, which is the same.
void take_places(KnownSlot& kept, KnownSlot const& other) {
  for (auto find : other.finds) {
    find.in_picture = aligned(find.in_picture, kept.outline);
    kept.finds.push_back(find);
  }
  if (other.fixed_weight > 0.0) kept.fix(aligned(other.fixed, kept.outline), other.fixed_weight);
}

}  // namespace

void SlotBook::know(std::string id, Corners const& outline) {
  constexpr double sure_of_map = 4.0;
  changed_.insert(id);
  slots_.push_back({.id = std::move(id),
                    .outline = outline,
                    .finds = {},
                    .fixed = outline,
                    .fixed_weight = 1.0 / (outline_sigma_m * outline_sigma_m),
                    .told = outline,
                    .there_log_odds = sure_of_map,
                    .is_confirmed = true});
}

double SlotBook::taken_chance(KnownSlot const& slot, base::UtcTime now) const {
  return slot.looks.taken_chance(now, settings_.turnover, settings_.independence);
}

bool SlotBook::is_same(Corners const& a, Corners const& b) const {
  return geo::distance_m(middle_of(a), middle_of(b)) < 0.5 * sides_of(a).width_m &&
         between_axes(axis_of(a), axis_of(b)) < most_turned_rad;
}

/// What is the same: the nearest first, each once.
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
  std::vector<bool> has_found(sight.slots.size(), false);
  std::vector<bool> has_slot(slots_.size(), false);
  std::erase_if(near, [&](Pair const& pair) {
    if (has_found[pair.found] || has_slot[pair.slot]) return true;
    has_found[pair.found] = has_slot[pair.slot] = true;
    return false;
  });
  return near;
}

std::vector<Tie> SlotBook::ties(LotSight const& told, PictureShift const& shift) const {
  std::vector<Tie> ties;
  for (auto const& pair : pairs(shifted(told, shift))) {
    auto const& slot = slots_[pair.slot];
    ties.push_back({.in_picture = middle_of(told.slots[pair.found].outline),
                    .on_map = middle_of(slot.outline),
                    .sigma_m = std::hypot(outline_sigma_m, 1.0 / std::sqrt(slot.weight()))});
  }
  return ties;
}

std::vector<Tie> SlotBook::ground_ties(LotSight const& told) const {
  std::vector<Tie> ties;
  for (auto const& tie : told.tie_points)
    if (auto const there = block_.placed(tie, told.vehicle))
      ties.push_back({.in_picture = tie.here, .on_map = *there, .sigma_m = tie.sigma_m});
  return ties;
}

PictureShift SlotBook::last_shift(LotSight const& sight) const {
  auto const last = last_.find(sight.vehicle);
  bool const lasts = last != last_.end() && std::chrono::abs(sight.at - last->second.at) < shift_lasts;
  return lasts ? last->second.shift : PictureShift{};
}

std::vector<SlotGuess> SlotBook::guesses(base::UtcTime now) const {
  std::vector<SlotGuess> guesses;
  for (auto const& slot : slots_)
    guesses.push_back({.middle = middle_of(slot.outline),
                       .half_width_m = 0.5 * sides_of(slot.outline).width_m,
                       .taken_chance = taken_chance(slot, now)});
  return guesses;
}

PlacedSight SlotBook::placed(LotSight const& sight) const {
  auto const ground = ground_ties(sight);
  auto fit = !ground.empty() ? fitted_shift(sight, ground)
                             : FittedShift{.shift = first_shift(sight, guesses(sight.at), last_shift(sight)),
                                           .sigma = expected_shift(sight)};
  constexpr int rounds = 2;  // what is found to be the same depends on how the picture lies
  for (int round = 0; round < rounds; ++round) {
    auto found = ties(sight, fit.shift);
    found.insert(found.end(), ground.begin(), ground.end());
    if (found.empty()) break;
    fit = fitted_shift(sight, found);
  }
  PlacedSight result{.sight = shifted(sight, fit.shift), .shift = fit.shift, .expected = expected_shift(sight)};
  auto& doubt = result.sight.doubt;
  double const height_m = std::max(sight.view.height_m(), 0.1);
  double const by_tilt_m = doubt.angle_rad * height_m;
  doubt.position_m = std::sqrt(std::max(0.0, fit.sigma[0] * fit.sigma[0] - by_tilt_m * by_tilt_m));
  doubt.heading_rad = fit.sigma[2];
  doubt.height_m = fit.sigma[3] * height_m;
  return result;
}

void SlotBook::add(PlacedSight const& placed, geo::Polygon<geo::SiteFrame> const& footprint) {
  auto const& sight = placed.sight;
  auto const look = look_of(sight);
  last_.insert_or_assign(sight.vehicle, LastShift{sight.at, placed.shift});
  Added added{.sight = sight, .number = block_.next_number()};
  std::vector<bool> is_known(sight.slots.size(), false);
  std::vector<SlotSight const*> found_as(slots_.size(), nullptr);
  for (auto const& pair : pairs(sight)) {
    is_known[pair.found] = true;
    found_as[pair.slot] = &sight.slots[pair.found];
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    auto& slot = slots_[i];
    if (!found_as[i] && !is_within(slot.outline, footprint, settings_.clear_m)) continue;
    double const novelty =
        slot.seen.at == base::UtcTime{} ? 1.0 : independence_of(slot.seen, look, settings_.independence);
    if (found_as[i]) {
      found(slot, added, *found_as[i], novelty);
    } else if (novelty >= least_novelty) {
      slot.there_log_odds += novelty * std::log((1.0 - settings_.found_share) / (1.0 - settings_.false_share));
    }
    if (novelty >= least_novelty) slot.seen = look;
    judge(slot);
  }
  for (std::size_t i = 0; i < sight.slots.size(); ++i)
    if (!is_known[i]) begin(added, sight.slots[i]);
  // A drone that hovers tells nothing new of where slots or other pictures lie, and is not to push out those that do.
  if (added.tells_places || sight.ties_later) {
    block_.add(placed);
    block_.settle(slots_);
  }
  join_doubles();
  for (std::size_t i = slots_.size(); i-- > 0;)
    if (slots_[i].there_chance() < settings_.forgotten) drop(i);
  tell_moved();
}

void SlotBook::found(KnownSlot& slot, Added& added, SlotSight const& as, double novelty) {
  if (novelty >= least_novelty) {
    added.tells_places = true;
    slot.there_log_odds += novelty * log_odds_of(std::clamp(as.surety, 1.0 - surest_find, surest_find));
    slot.finds.push_back({.picture = added.number,
                          .in_picture = aligned(as.outline, slot.outline),
                          .weight = novelty / (outline_sigma_m * outline_sigma_m)});
  }
  if (!as.taken_chance) return;
  // It may be the neighbour that was seen, by how far the camera may be off.
  double const sigma_m = std::hypot(ground_doubt_m(added.sight, middle_of(as.outline)), outline_sigma_m);
  double const is_it = chance_within(0.5 * sides_of(slot.outline).width_m, sigma_m);
  double const told = std::clamp(*as.taken_chance, settings_.least_error, 1.0 - settings_.least_error);
  double const chance = is_it * told + (1.0 - is_it) * settings_.detector_prior;
  auto look = look_of(added.sight);
  look.log_likelihood = log_odds_of(chance) - log_odds_of(settings_.detector_prior);
  if (slot.looks.novelty_of(look, settings_.independence) < least_novelty) return;
  if (!slot.looks.add(std::move(look))) return;
  slot.looks.fold(settings_.turnover, settings_.independence);
  if (slot.is_confirmed) changed_.insert(slot.id);
}

void SlotBook::begin(Added& added, SlotSight const& as) {
  KnownSlot slot{.id = fmt::format("{}-{}", settings_.id_prefix, next_++),
                 .outline = as.outline,
                 .finds = {},
                 .there_log_odds = log_odds_of(settings_.slot_prior)};
  found(slot, added, as, 1.0);
  slot.seen = look_of(added.sight);
  judge(slot);
  slots_.push_back(std::move(slot));
}

/// Slots move with the pictures that show them.
void SlotBook::tell_moved() {
  for (auto& slot : slots_) {
    if (!slot.is_confirmed) continue;
    double const moved_m = geo::distance_m(middle_of(slot.outline), middle_of(slot.told));
    if (moved_m > told_again_m) changed_.insert(slot.id);
    if (changed_.contains(slot.id)) slot.told = slot.outline;
  }
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
      take_places(kept, slots_[newer]);
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
