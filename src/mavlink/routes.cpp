#include "mavlink/internal/routes.hpp"

#include <algorithm>

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

/// More far ends than any fleet has; a flood of datagrams from random ports must not fill the memory.
std::size_t constexpr max_peers = 1024;
/// A peer that has been silent for this long is not sent heartbeats any more.
base::Duration constexpr forget_after = 60s;
/// Silence after which a peer no longer claims its system id: five heartbeats.
base::Duration constexpr claim_lasts = 5s;
/// How often a peer must have come back. Once or twice can be datagrams of a rebooted vehicle that overtook each other.
int constexpr returns_of_a_conflict = 3;

}  // namespace

PeerState& Routes::hear(PeerRef peer, base::TimePoint now) {
  auto found = peers_.find(peer);
  if (found == peers_.end()) {
    if (peers_.size() >= max_peers) make_room();
    found = peers_.emplace(peer, PeerState{}).first;
  }
  found->second.heard = now;
  return found->second;
}

void Routes::make_room() {
  auto const oldest = std::ranges::min_element(
      peers_, {}, [](auto const& entry) { return std::pair(entry.second.spoke, entry.second.heard); });
  peers_.erase(oldest);
}

Routes::Taken Routes::take(Address source, PeerRef peer, std::uint8_t seq, std::uint16_t checksum,
                           base::TimePoint now) {
  auto& known = sources_[source];
  auto& tracker = known.by_link[peer.link];
  if (known.peer != peer && known.peer.link == peer.link) tracker.restart();
  if (!tracker.take(seq, checksum)) return {};
  known.peer = peer;
  known.heard = now;
  bool const conflict_new = source.component == autopilot_component && claim(claims_[source.system], peer, now);
  return {.fresh = true, .conflict_new = conflict_new};
}

bool Routes::claim(Claims& claims, PeerRef peer, base::TimePoint now) {
  auto& alive = claims.alive;
  if (alive.size() == 1 && alive.back().peer == peer) {
    alive.back().heard = now;
    return false;
  }
  std::erase_if(alive, [now](Claim const& c) { return now - c.heard > claim_lasts; });
  if (alive.size() <= 1) claims.returns = 0;
  auto const before = std::ranges::find(alive, peer, &Claim::peer);
  if (before == alive.end()) {
    alive.push_back({peer, now});
    return false;
  }
  bool const returned = before != std::prev(alive.end());
  std::rotate(before, before + 1, alive.end());
  alive.back().heard = now;
  if (!returned) return false;
  return ++claims.returns == returns_of_a_conflict;
}

std::optional<PeerRef> Routes::route_to(Address target) const {
  if (auto const exact = sources_.find(target); exact != sources_.end()) return exact->second.peer;
  if (auto const main = sources_.find({target.system, autopilot_component}); main != sources_.end())
    return main->second.peer;
  Source const* latest = nullptr;
  for (auto it = sources_.lower_bound({target.system, 0}); it != sources_.end() && it->first.system == target.system;
       ++it)
    if (!latest || it->second.heard > latest->heard) latest = &it->second;
  return latest ? std::optional(latest->peer) : std::nullopt;
}

std::vector<PeerRef> Routes::claimants(std::uint8_t system_id, base::TimePoint now) const {
  std::vector<PeerRef> peers;
  auto const found = claims_.find(system_id);
  if (found == claims_.end()) return peers;
  for (auto const& claim : found->second.alive)
    if (now - claim.heard <= claim_lasts) peers.push_back(claim.peer);
  return peers;
}

std::optional<std::pair<PeerRef, PeerRef>> Routes::conflict(std::uint8_t system_id, base::TimePoint now) const {
  auto const found = claims_.find(system_id);
  if (found == claims_.end() || found->second.returns < returns_of_a_conflict) return std::nullopt;
  auto peers = claimants(system_id, now);
  if (peers.size() < 2) return std::nullopt;
  std::ranges::sort(peers);
  return std::pair(peers[0], peers[1]);
}

std::vector<PeerRef> Routes::talkers(base::TimePoint now) const {
  std::vector<PeerRef> peers;
  for (auto const& [peer, state] : peers_)
    if (state.spoke && now - state.heard < forget_after) peers.push_back(peer);
  return peers;
}

std::optional<base::TimePoint> Routes::last_heard(std::uint8_t system_id) const {
  std::optional<base::TimePoint> latest;
  for (auto it = sources_.lower_bound({system_id, 0}); it != sources_.end() && it->first.system == system_id; ++it)
    latest = std::max(latest.value_or(it->second.heard), it->second.heard);
  return latest;
}

SourceCounters Routes::counters(Address source) const {
  SourceCounters sum;
  auto const found = sources_.find(source);
  if (found == sources_.end()) return sum;
  for (auto const& [link, tracker] : found->second.by_link) sum += tracker.counters();
  return sum;
}

ParserCounters Routes::parser_counters(std::size_t link) const {
  ParserCounters sum;
  for (auto const& [peer, state] : peers_) {
    if (peer.link != link) continue;
    auto const& one = state.parser.counters();
    sum.frames += one.frames;
    sum.crc_errors += one.crc_errors;
    sum.unknown_ids += one.unknown_ids;
    sum.junk_bytes += one.junk_bytes;
  }
  return sum;
}

}  // namespace lapwing::mavlink::internal
