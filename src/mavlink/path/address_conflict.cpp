#include "mavlink/path/internal/address_conflict.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

/// Silence after which a far end no longer claims the system id: five heartbeats.
base::Duration constexpr claim_lasts = 5s;
/// What it proved is remembered for longer: a radio in a valley comes back.
base::Duration constexpr proof_lasts = 60s;
/// A newcomer is believed to be the vehicle itself, rebooted, when the established far end misses a heartbeat.
base::Duration constexpr missed_heartbeat = 1500ms;
/// Time to prove that two are one: many round trips of a slow radio that loses half.
base::Duration constexpr time_to_prove = 6s;
/// The same when something speaks for it already and nothing against it.
base::Duration constexpr time_to_finish = 20s;
/// A flood from many addresses must not fill the memory.
std::size_t constexpr most_claims = 8;
/// How often a far end must have come back. Once or twice can be datagrams of a rebooted vehicle that overtook each
/// other.
int constexpr returns_of_a_conflict = 3;

bool is_alive(AddressConflict::Claim const& claim, base::TimePoint now) {
  return now - claim.heard <= claim_lasts;
}

bool is_one(AddressConflict::Claim const& claim) {
  return claim.same_vehicle.verdict() == Verdict::one;
}

}  // namespace

void AddressConflict::hear(PeerRef peer, base::TimePoint now) {
  if (claims_.size() == 1 && claims_.front().peer == peer) {
    claims_.front().heard = now;
    return;
  }
  std::erase_if(claims_, [now](Claim const& c) { return now - c.heard > proof_lasts; });
  auto* claim = find(peer);
  if (!claim) {
    if (claims_.size() == most_claims)
      claims_.erase(std::ranges::min_element(claims_.begin() + 1, claims_.end(), {}, &Claim::heard));
    claim = &claims_.emplace_back(Claim{.peer = peer, .heard = now, .since = now});
  }
  if (!is_alive(*claim, now)) {
    claim->since = now;
    claim->returns = 0;
  }
  if (last_ != peer) ++claim->returns;
  claim->heard = now;
  last_ = peer;
  establish(now);
}

/// Makes way at the front when the established one is gone: for one that proved to be the same vehicle, else for the
/// one that spoke last.
void AddressConflict::establish(base::TimePoint now) {
  if (claims_.size() < 2 || now - claims_.front().heard <= missed_heartbeat) return;
  auto next = std::find_if(claims_.begin() + 1, claims_.end(),
                           [now](Claim const& c) { return is_one(c) && now - c.heard <= missed_heartbeat; });
  bool const is_same_vehicle = next != claims_.end();
  if (!is_same_vehicle) next = std::ranges::max_element(claims_, {}, &Claim::heard);
  if (next == claims_.begin()) return;
  // Likenesses are to the one in front. That of the two stays; a third's holds on only if they are one vehicle.
  claims_.front().same_vehicle = next->same_vehicle;
  if (!is_same_vehicle)
    for (auto claim = claims_.begin() + 1; claim != claims_.end(); ++claim)
      if (claim != next) claim->same_vehicle = {};
  std::rotate(claims_.begin(), next, next + 1);
}

bool AddressConflict::compare(base::TimePoint now) {
  for (std::size_t i = 1; i < claims_.size(); ++i)
    if (is_alive(claims_[i], now)) claims_[i].same_vehicle.compare(claims_[0].fingerprint, claims_[i].fingerprint, now);
  bool const is_new = !conflict_;
  conflict_ = find_conflict(now);
  return is_new && conflict_;
}

AddressConflict::Claim* AddressConflict::find(PeerRef peer) {
  return const_cast<Claim*>(std::as_const(*this).find(peer));
}

AddressConflict::Claim const* AddressConflict::find(PeerRef peer) const {
  auto const found = std::ranges::find(claims_, peer, &Claim::peer);
  return found == claims_.end() ? nullptr : &*found;
}

void AddressConflict::note_copy(PeerRef a, PeerRef b) {
  auto const front = claims_.empty() ? PeerRef{} : claims_.front().peer;
  if (a != front && b != front) return;
  if (auto* other = find(a == front ? b : a); other && other != &claims_.front()) other->same_vehicle.note_copy();
}

std::optional<PeerRef> AddressConflict::established(base::TimePoint now) const {
  Claim const* last = nullptr;
  for (auto const& claim : claims_) {
    bool const is_same = &claim == &claims_.front() || is_one(claim);
    if (is_same && now - claim.heard <= missed_heartbeat) return claim.peer;
    if (!last || claim.heard > last->heard) last = &claim;
  }
  return last ? std::optional(last->peer) : std::nullopt;
}

bool AddressConflict::is_like_first(PeerRef peer) const {
  if (!claims_.empty() && claims_.front().peer == peer) return true;
  auto const* claim = find(peer);
  return claim && is_one(*claim);
}

bool AddressConflict::is_proven(PeerRef peer, base::TimePoint now) const {
  auto const main = established(now);
  return main && (peer == *main || (is_like_first(peer) && is_like_first(*main)));
}

bool AddressConflict::are_one(PeerRef a, PeerRef b) const {
  return a == b || (is_like_first(a) && is_like_first(b));
}

bool AddressConflict::is_contested(base::TimePoint now) const {
  if (!are_several() || !is_alive(claims_.front(), now)) return false;
  return std::any_of(claims_.begin() + 1, claims_.end(),
                     [now](Claim const& c) { return is_alive(c, now) && !is_one(c); });
}

std::optional<std::pair<PeerRef, PeerRef>> AddressConflict::find_conflict(base::TimePoint now) const {
  if (!are_several() || !is_alive(claims_.front(), now)) return std::nullopt;
  for (auto const& claim : claims_) {
    if (&claim == &claims_.front() || is_one(claim) || !is_alive(claim, now)) continue;
    if (claim.returns < returns_of_a_conflict || claims_.front().returns < returns_of_a_conflict - 1) continue;
    auto const time = claim.same_vehicle.is_likely_one() ? time_to_finish : time_to_prove;
    bool const had_time = now - std::max(claim.since, claims_.front().since) >= time;
    if (!had_time && claim.same_vehicle.verdict() != Verdict::two) continue;
    return std::minmax(claim.peer, claims_.front().peer);
  }
  return std::nullopt;
}

std::vector<PeerRef> AddressConflict::alive(base::TimePoint now) const {
  std::vector<PeerRef> peers;
  for (auto const& claim : claims_)
    if (is_alive(claim, now)) peers.push_back(claim.peer);
  return peers;
}

}  // namespace lapwing::mavlink::internal
