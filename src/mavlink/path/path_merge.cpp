#include "mavlink/path/internal/path_merge.hpp"

#include <algorithm>

#include "mavlink/wire/message_kinds.hpp"

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

/// Later than that no link in use brings a packet.
base::Duration constexpr window = 2s;

bool is_recent(base::TimePoint then, base::TimePoint now) {
  return then != base::TimePoint::min() && now - then <= window;
}

/// FNV-1a of the whole payload, zeros behind it included: links may trim differently.
std::uint32_t hash_of(Frame const& frame) {
  std::uint32_t hash = 2166136261U;
  for (auto const byte : frame.payload) hash = (hash ^ byte) * 16777619U;
  return hash;
}

}  // namespace

PathMerge::Look PathMerge::look(Frame const& frame, PeerRef from, bool is_one, bool is_best, base::TimePoint now) {
  auto& seen = by_seq_[frame.seq];
  if (seen.from != from && seen.message_id == frame.message_id && seen.hash == frame.checksum &&
      is_recent(seen.at, now))
    return {.is_news = false, .copy_of = seen.from};
  seen = {from, now, frame.message_id, frame.checksum};
  if (!is_one) return {};
  if (is(frame.message_id, Kind::state)) return {.is_news = speaks(frame.message_id, from, is_best, now)};
  if (is(frame.message_id, Kind::event)) return {.is_news = is_first_to_tell(frame, from, now)};
  return {};
}

bool PathMerge::speaks(std::uint32_t message_id, PeerRef from, bool is_best, base::TimePoint now) {
  auto speaker = std::ranges::find(speakers_, message_id, &Speaker::message_id);
  if (speaker == speakers_.end()) speaker = speakers_.insert(speakers_.end(), {message_id, from, now});
  if (speaker->from != from && !is_best && is_recent(speaker->at, now)) return false;
  speaker->from = from;
  speaker->at = now;
  return true;
}

/// Each telling is matched by one of another path, so that a vehicle may say the same twice.
bool PathMerge::is_first_to_tell(Frame const& frame, PeerRef from, base::TimePoint now) {
  auto const hash = hash_of(frame);
  auto const told = std::ranges::find_if(events_, [&](Seen const& event) {
    return event.from != from && event.message_id == frame.message_id && event.hash == hash && is_recent(event.at, now);
  });
  if (told != events_.end()) {
    told->at = base::TimePoint::min();
    return false;
  }
  events_[next_event_++ % events_.size()] = {from, now, frame.message_id, hash};
  return true;
}

}  // namespace lapwing::mavlink::internal
