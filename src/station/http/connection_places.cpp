#include "station/http/internal/connection_places.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::station::internal {
namespace {

Places::Standing counted_as(Places::Standing standing) {
  return standing == Places::Standing::newcomer ? Places::Standing::stranger : standing;
}

}  // namespace

std::size_t Places::count(Standing standing, std::string const& address) const {
  auto const found = counts_.find({standing, address});
  return found == counts_.end() ? 0 : found->second;
}

std::optional<Places::Guest> Places::first(Standing standing, std::string const& address) const {
  std::optional<Guest> found;
  std::pair<bool, std::uint64_t> before_others;
  for (auto const& [guest, place] : places_) {
    if (counted_as(place.standing) != standing || place.address != address) continue;
    auto const turn = std::pair(place.standing == Standing::newcomer, place.since);
    if (found && turn >= before_others) continue;
    found = guest;
    before_others = turn;
  }
  return found;
}

std::optional<Places::Guest> Places::first_of_the_largest_crowd(Standing standing) const {
  std::string const* address = nullptr;
  std::size_t most = 0;
  for (auto const& [key, size] : counts_) {
    if (key.first != standing || size <= most) continue;
    most = size;
    address = &key.second;
  }
  return address ? first(standing, *address) : std::nullopt;
}

Places::Entrance Places::enter(std::string address) {
  Entrance entrance;
  if (count(Standing::stranger, address) >= limits_.strangers_per_address)
    entrance.must_leave = first(Standing::stranger, address);
  else if (places_.size() >= limits_.all) {
    entrance.must_leave = first_of_the_largest_crowd(Standing::stranger);
    if (!entrance.must_leave) entrance.must_leave = first_of_the_largest_crowd(Standing::resting);
    if (!entrance.must_leave) return entrance;
  }
  if (entrance.must_leave) leave(*entrance.must_leave);
  ++changes_;
  entrance.guest = Guest{changes_};
  ++counts_[{Standing::stranger, address}];
  places_.emplace(*entrance.guest, Place{std::move(address), Standing::newcomer, changes_});
  return entrance;
}

void Places::set(Guest guest, Standing standing) {
  auto const found = places_.find(guest);
  if (found == places_.end()) return;
  auto place = found->second;
  leave(guest);
  place.standing = standing;
  place.since = ++changes_;
  ++counts_[{counted_as(standing), place.address}];
  places_.emplace(guest, std::move(place));
}

void Places::leave(Guest guest) {
  auto const place = places_.extract(guest);
  if (place.empty()) return;
  auto const counted = counts_.find({counted_as(place.mapped().standing), place.mapped().address});
  if (--counted->second == 0) counts_.erase(counted);
}

}  // namespace lapwing::station::internal
