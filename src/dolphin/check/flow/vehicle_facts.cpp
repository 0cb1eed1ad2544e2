#include "dolphin/check/flow/internal/vehicle_facts.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lapwing::dolphin {

VehicleSet const* VehicleState::find(Variable const* variable) const {
  auto const found = sets_.find(variable);
  return found == sets_.end() ? nullptr : &found->second;
}

void VehicleState::assign(Variable const* variable, VehicleSet set) {
  auto const found = sets_.find(variable);
  old_sets_.emplace_back(variable, found == sets_.end() ? std::nullopt : std::optional(found->second));
  sets_.insert_or_assign(variable, std::move(set));
}

void VehicleState::forget(Variable const* variable) {
  auto const found = sets_.find(variable);
  if (found == sets_.end()) return;
  old_sets_.emplace_back(variable, std::move(found->second));
  sets_.erase(found);
}

PickIndex VehicleState::add(Pick pick) {
  picks_.push_back(std::move(pick));
  releases_.emplace_back();
  return static_cast<PickIndex>(picks_.size() - 1);
}

ReleaseFact VehicleState::release_of(PickIndex index) const {
  auto fact = releases_[index];
  if (fact.is == Released::yes && fact.epoch != epoch_) fact.is = Released::maybe;
  return fact;
}

void VehicleState::release(PickIndex index, Released is, base::Span place) {
  auto& fact = releases_[index];
  if (is == Released::maybe && fact.is != Released::no) return;
  old_releases_.emplace_back(index, fact);
  fact = {is, place, epoch_};
}

void VehicleState::note_pick(std::optional<std::size_t> count) {
  ++epoch_;
  most_picked_ = count && most_picked_ ? std::optional(*most_picked_ + *count) : std::nullopt;
}

/// The epoch goes on: what is released after the mark is forgotten with it, what was released before it is told apart
/// by the epoch it had.
void VehicleState::undo(Mark const& mark) {
  for (; old_sets_.size() > mark.variables; old_sets_.pop_back()) {
    auto& [variable, old] = old_sets_.back();
    if (old) {
      sets_.insert_or_assign(variable, *std::move(old));
    } else {
      sets_.erase(variable);
    }
  }
  for (; old_releases_.size() > mark.releases; old_releases_.pop_back()) {
    releases_[old_releases_.back().first] = old_releases_.back().second;
  }
  most_picked_ = mark.most_picked;
  epoch_ = mark.epoch;
}

std::optional<VehicleSet> united(VehicleSet const& a, VehicleSet const& b) {
  VehicleSet out{{}, {}, a.is_part || b.is_part};
  std::ranges::set_union(a.picks, b.picks, std::back_inserter(out.picks));
  if (out.picks.size() > max_picks_of_a_set) return std::nullopt;
  if (a.most && b.most) out.most = *a.most + *b.most;
  return out;
}

}  // namespace lapwing::dolphin
