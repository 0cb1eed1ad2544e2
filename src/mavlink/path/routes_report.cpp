// What `Routes` tells of itself.
#include <algorithm>

#include "mavlink/path/routes.hpp"

namespace lapwing::mavlink::internal {

std::optional<base::TimePoint> Routes::last_heard(Address source) const {
  auto const found = sources_.find(source);
  if (found == sources_.end()) return std::nullopt;
  std::optional<base::TimePoint> last;
  for (auto const& path : found->second.paths)
    if (!last || path.meter.last_heard() > *last) last = path.meter.last_heard();
  return last;
}

SourceCounters Routes::counters(Address source) const {
  SourceCounters sum;
  auto const found = sources_.find(source);
  if (found == sources_.end()) return sum;
  for (auto const& path : found->second.paths) sum += path.sequence.counters();
  for (auto const& [link, gone] : found->second.gone) sum += gone;
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

SourceReport Routes::report(Address address, Source const& source, Path const& path, base::TimePoint now) const {
  auto const rates = path.meter.rates(path.sequence.counters(), now);
  auto const routes = routes_to(address, Traffic::command, now);
  return {.source = address,
          .from = path.peer,
          .address = {},
          .counters = path.sequence.counters(),
          .messages_per_s = rates.messages_per_s,
          .bytes_per_s = rates.bytes_per_s,
          .loss = rates.loss,
          .round_trip = path.meter.round_trip(),
          .age = now - path.meter.last_heard(),
          .is_alive = path.is_alive(now),
          .is_route = source.paths.size() == 1 || (!routes.empty() && routes.front() == path.peer)};
}

void Routes::report(std::vector<LinkReport>& links, base::TimePoint now) const {
  for (auto& link : links) link.frames = parser_counters(link.number);
  for (auto const& [address, source] : sources_) {
    for (auto const& path : source.paths) {
      auto const one = report(address, source, path, now);
      auto& link = links[path.peer.link];
      link.counters += one.counters;
      // The mean of the losses, each by the messages that came; summed here, divided below.
      link.loss += one.loss * one.messages_per_s;
      link.messages_per_s += one.messages_per_s;
      link.bytes_per_s += one.bytes_per_s;
      if (one.round_trip && (!link.round_trip || *one.round_trip < *link.round_trip)) link.round_trip = one.round_trip;
      if (!link.age || one.age < *link.age) link.age = one.age;
      link.sources.push_back(one);
    }
    for (auto const& [number, gone] : source.gone) links[number].counters += gone;
  }
  for (auto const& [number, gone] : gone_) links[number].counters += gone;
  for (auto& link : links)
    if (link.messages_per_s > 0.0) link.loss /= link.messages_per_s;
}

}  // namespace lapwing::mavlink::internal
