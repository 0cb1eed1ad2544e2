#include "mavlink/path/routes.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

/// More far ends than any fleet has; a flood of datagrams from random ports must not fill the memory.
std::size_t constexpr max_peers = 1024;
/// The same for sources: a hundred vehicles with twenty components each. A flood can make up 65 536.
std::size_t constexpr max_sources = 2048;
/// One that said less has not shown that it is there to stay.
std::uint64_t constexpr few_messages = 5;
/// The same for one source.
std::size_t constexpr max_paths = 8;
/// A far end that has been silent for this long is not sent heartbeats any more, and one of several paths is forgotten.
base::Duration constexpr forget_after = 60s;
/// Of a far end that has not answered TIMESYNC: a slow radio's.
base::Duration constexpr assumed_round_trip = 300ms;
/// So many TIMESYNC requests go out quickly, to have a round trip soon where packets get lost.
std::size_t constexpr quick_asks = 5;
base::Duration constexpr quick_period = 1s;
/// What either end takes to turn an answer round; keeps differences of a millisecond from deciding.
base::Duration constexpr turn_round = 50ms;
/// A path that brings telemetry and takes no commands is worse than any other, but better than none.
double constexpr deaf_costs = 100.0;

std::size_t wire_size(Frame const& frame) {
  std::size_t constexpr v1 = 8;
  std::size_t constexpr v2 = 12;
  return frame.payload_size + (frame.version == 1 ? v1 : v2) + (frame.is_signed() ? frame.signature.size() : 0);
}

/// Bytes of a typical exchange.
double size_of(Traffic traffic) {
  return traffic == Traffic::bulk ? 10'000.0 : 100.0;
}

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
  auto const peer = oldest->first;
  peers_.erase(oldest);
  forgotten_(peer);
}

// ---- what comes in

Routes::Path* Routes::Source::find(PeerRef peer) {
  auto const found = std::ranges::find(paths, peer, &Path::peer);
  return found == paths.end() ? nullptr : &*found;
}

void Routes::Source::forget(std::vector<Path>::iterator path) {
  gone[path->peer.link] += path->sequence.counters();
  paths.erase(path);
  if (paths.size() == 1) merge.reset();
}

base::TimePoint Routes::Source::last_heard() const {
  auto last = base::TimePoint::min();
  for (auto const& path : paths) last = std::max(last, path.meter.last_heard());
  return last;
}

std::uint64_t Routes::Source::received() const {
  std::uint64_t sum = 0;
  for (auto const& path : paths) sum += path.sequence.counters().received;
  return sum;
}

Routes::Source& Routes::source_of(Address address) {
  auto const found = sources_.find(address);
  if (found != sources_.end()) return found->second;
  if (sources_.size() >= max_sources) make_room_for_source();
  auto& source = sources_[address];
  source.system = &systems_[address.system];
  return source;
}

/// Those that hardly spoke first: while made-up sources pour in, vehicles speak on.
void Routes::make_room_for_source() {
  auto const rank = [](auto const& entry) {
    return std::pair(entry.second.received() > few_messages, entry.second.last_heard());
  };
  auto const oldest = std::ranges::min_element(sources_, {}, rank);
  for (auto const& path : oldest->second.paths) gone_[path.peer.link] += path.sequence.counters();
  for (auto const& [link, counters] : oldest->second.gone) gone_[link] += counters;
  sources_.erase(oldest);
}

Routes::Path& Routes::path_of(Source& source, PeerRef peer) {
  if (auto* path = source.find(peer)) return *path;
  if (source.paths.size() == max_paths)
    source.forget(std::ranges::min_element(source.paths, {}, [](Path const& p) { return p.meter.last_heard(); }));
  auto& path = source.paths.emplace_back();
  path.peer = peer;
  return path;
}

Routes::Taken Routes::take(PeerRef peer, PeerState& state, Frame const& frame, base::TimePoint now) {
  auto& source = source_of(frame.source);
  auto& path = path_of(source, peer);
  path.meter.heard(wire_size(frame), path.sequence.counters(), now);
  if (!path.sequence.take(frame.seq, frame.checksum)) return {};
  if (auto const unknown = state.parser.counters().unknown_ids; unknown != state.unknown_ids) {
    state.unknown_ids = unknown;
    path.sequence.count_unknown();
  }
  Taken taken{.is_fresh = true, .is_news = true};
  if (frame.source.component == autopilot_component) {
    state.leads_to_autopilot = true;
    source.system->claims.hear(peer, now);
    taken.is_one_of_several = source.system->claims.are_several();
  }
  if (source.paths.size() > 1 && is_told_already(source, peer, frame, now)) {
    path.sequence.count_redundant();
    taken.is_news = false;
  }
  return taken;
}

bool Routes::is_told_already(Source& source, PeerRef peer, Frame const& frame, base::TimePoint now) {
  auto& claims = source.system->claims;
  if (!source.merge) source.merge = std::make_unique<PathMerge>();
  bool const is_one = claims.are_several() && claims.is_proven(peer, now) && !claims.is_contested(now);
  bool const is_best = source.system->choice(Traffic::command).current() == peer;
  auto const look = source.merge->look(frame, peer, is_one, is_best, now);
  if (look.copy_of && is(frame.message_id, Kind::clock)) claims.note_copy(*look.copy_of, peer);
  return !look.is_news;
}

void Routes::identify(PeerRef peer, Address source, Message const& message, base::TimePoint now) {
  auto* claim = systems_[source.system].claims.find(peer);
  auto const* answer = std::get_if<Timesync>(&message);
  if (answer && answer->tc1 != base::Duration{}) {
    auto const& asked = peers_[peer].asked;
    if (std::ranges::find(asked, base::TimePoint(answer->ts1)) == asked.end()) return;
    auto const round_trip = std::max(now - base::TimePoint(answer->ts1), base::Duration{});
    if (auto* path = source_of(source).find(peer)) path->meter.answered(round_trip);
    if (claim) claim->fingerprint.take(*answer, now);
  }
  if (!claim) return;
  if (auto const* version = std::get_if<AutopilotVersion>(&message)) claim->fingerprint.take(*version);
  if (auto const* position = std::get_if<GlobalPosition>(&message)) claim->fingerprint.take(*position, now);
}

// ---- twice a second

std::vector<std::uint8_t> Routes::examine(base::TimePoint now) {
  std::vector<std::uint8_t> conflicts;
  for (auto& [id, system] : systems_)
    if (system.claims.compare(now)) conflicts.push_back(id);
  for (auto& [address, source] : sources_) {
    if (source.paths.size() > 1) {
      auto const silent = std::ranges::find_if(
          source.paths, [now](Path const& path) { return now - path.meter.last_heard() > forget_after; });
      if (silent != source.paths.end()) source.forget(silent);
    }
    if (address.component != autopilot_component) continue;
    for (auto const traffic : {Traffic::command, Traffic::bulk})
      source.system->choice(traffic).consider(candidates(source, traffic, now), now);
  }
  return conflicts;
}

std::vector<Routes::ClockQuestion> Routes::ask_clocks(std::vector<Suspect> const& suspects, base::Duration period,
                                                      base::TimePoint now) {
  std::vector<ClockQuestion> due;
  for (auto& [peer, state] : peers_) {
    if (!state.leads_to_autopilot || now - state.heard > forget_after) continue;
    auto const last = state.asks == 0 ? base::TimePoint::min() : state.asked[(state.asks - 1) % state.asked.size()];
    // Quickly at first: how soon things are said again depends on it.
    bool const is_due =
        state.asks == 0 || now - last >= (state.asks < quick_asks ? std::min(quick_period, period) : period);
    if (!is_due && std::ranges::find(suspects, peer, &Suspect::peer) == suspects.end()) continue;
    due.push_back({peer, now + base::Duration(due.size())});
    state.asked[state.asks++ % state.asked.size()] = due.back().asked;
  }
  for (auto& [address, source] : sources_) {
    if (address.component != autopilot_component) continue;
    for (auto& path : source.paths)
      if (std::ranges::binary_search(due, path.peer, {}, &ClockQuestion::peer)) path.meter.asked();
  }
  return due;
}

std::vector<Routes::Suspect> Routes::suspects(bool with_conflicts, base::TimePoint now) const {
  std::vector<Suspect> suspects;
  for (auto const& [id, system] : systems_) {
    if (!system.claims.is_contested(now) || (!with_conflicts && system.claims.conflict())) continue;
    for (auto const& peer : system.claims.alive(now))
      suspects.push_back({id, peer, system.claims.find(peer)->fingerprint.hardware.has_value()});
  }
  return suspects;
}

// ---- where to send

/// The time that an exchange takes: each try costs a round trip and the line's time, and both ways must be lucky.
double Routes::cost_s(Path const& path, Traffic traffic, base::TimePoint now) const {
  auto const capacity = bytes_per_s_[path.peer.link];
  double const line_s = capacity ? size_of(traffic) / *capacity : 0.0;
  double const once_s = base::to_seconds(path.meter.round_trip().value_or(assumed_round_trip) + turn_round) + line_s;
  double const arrives = std::max(0.05, 1.0 - path.meter.rates(path.sequence.counters(), now).loss);
  return once_s / (arrives * arrives) * (path.meter.is_deaf() ? deaf_costs : 1.0);
}

/// Paths that are alive and lead to the established vehicle.
std::vector<Candidate> Routes::candidates(Source const& source, Traffic traffic, base::TimePoint now) const {
  auto const& claims = source.system->claims;
  bool const is_proven_only = claims.are_several();
  std::vector<Candidate> found;
  for (auto const& path : source.paths)
    if (path.is_alive(now) && (!is_proven_only || claims.is_proven(path.peer, now)))
      found.push_back({path.peer, source.paths.size() > 1 ? cost_s(path, traffic, now) : 0.0});
  return found;
}

Routes::Source const* Routes::source_for(Address target) const {
  if (auto const exact = sources_.find(target); exact != sources_.end()) return &exact->second;
  if (auto const main = sources_.find({target.system, autopilot_component}); main != sources_.end())
    return &main->second;
  Source const* latest = nullptr;
  for (auto it = sources_.lower_bound({target.system, 0}); it != sources_.end() && it->first.system == target.system;
       ++it)
    if (!latest || it->second.last_heard() > latest->last_heard()) latest = &it->second;
  return latest;
}

std::vector<PeerRef> Routes::routes_to(Address target, Traffic traffic, base::TimePoint now) const {
  auto const* source = source_for(target);
  if (!source) return {};
  if (source->paths.size() == 1) return {source->paths.front().peer};
  auto found = candidates(*source, traffic, now);
  std::ranges::sort(found, {}, &Candidate::cost_s);
  std::vector<PeerRef> routes;
  // What was chosen for the system goes first as long as it lives; then what is best just now.
  auto const chosen = source->system->choice(traffic).current();
  for (auto const& candidate : found) routes.push_back(candidate.peer);
  auto const held = std::ranges::find(routes, chosen, [](PeerRef peer) { return std::optional(peer); });
  if (held != routes.end()) std::rotate(routes.begin(), held, held + 1);
  // When all else fails where it was heard last: perhaps that is the vehicle, restarted.
  auto const last =
      std::ranges::max_element(source->paths, {}, [](Path const& p) { return p.meter.last_heard(); })->peer;
  for (auto const peer : {source->system->claims.established(now).value_or(last), last})
    if (std::ranges::find(routes, peer) == routes.end()) routes.push_back(peer);
  return routes;
}

std::optional<base::Duration> Routes::round_trip(std::uint8_t system_id, base::TimePoint now) const {
  Address const autopilot{system_id, autopilot_component};
  auto const found = sources_.find(autopilot);
  auto const routes = routes_to(autopilot, Traffic::command, now);
  if (found == sources_.end() || routes.empty()) return std::nullopt;
  auto const path = std::ranges::find(found->second.paths, routes.front(), &Path::peer);
  return path == found->second.paths.end() ? std::nullopt : path->meter.round_trip();
}

AddressConflict const* Routes::claims(std::uint8_t system_id) const {
  auto const found = systems_.find(system_id);
  return found == systems_.end() ? nullptr : &found->second.claims;
}

std::vector<PeerRef> Routes::talkers(base::TimePoint now) const {
  std::vector<PeerRef> peers;
  for (auto const& [peer, state] : peers_)
    if (state.spoke && now - state.heard < forget_after) peers.push_back(peer);
  return peers;
}

}  // namespace lapwing::mavlink::internal
