#include "station/past/recorder.hpp"

#include <limits>
#include <utility>

#include "station/feeds/envelope.hpp"
#include "station/map/grids/grids_feed.hpp"

namespace lapwing::station {

Recorder::Recorder(base::Loop& loop, std::vector<Feed*> const& feeds, map::Store& store, Options options)
    : loop_(loop), store_(store), options_(std::move(options)) {
  for (auto* feed : feeds) tracks_.push_back({.feed = feed, .id = static_cast<std::uint16_t>(tracks_.size() + 1)});
}

void Recorder::keep() {
  if (!store_.is_ready_to_record()) return;
  auto const utc = moment();
  for (auto& track : tracks_)
    if (track.feed->name() != GridsFeed::feed_name) keep(track, loop_.now(), utc);
}

base::Task<> Recorder::keep_grids() {
  if (!store_.is_ready_to_record()) co_return;
  auto const utc = moment();
  for (auto& track : tracks_)
    if (track.feed->name() == GridsFeed::feed_name) keep(track, loop_.now(), utc);
  co_await store_.record_grids(options_.session, utc);
}

/// Pages ask for milliseconds: what is kept lies on one, so that none is asked for twice.
base::UtcTime Recorder::moment() const {
  return base::UtcTime(std::chrono::floor<std::chrono::milliseconds>(loop_.utc_now().time_since_epoch()));
}

bool Recorder::wants_whole(Track const& track, base::TimePoint now) const {
  if (track.revision == 0 || now - track.whole_at >= options_.longest_without_whole) return true;
  return static_cast<double>(track.bytes_since) >= options_.growth * static_cast<double>(track.whole_bytes);
}

void Recorder::keep(Track& track, base::TimePoint now, base::UtcTime utc) {
  auto const revision = track.feed->refresh(now);
  bool const starts_anew = wants_whole(track, now);
  if (revision == track.revision && !starts_anew) return;
  // There is no network to be kept free for others, so each feed may tell all at once.
  auto news = track.feed->since(starts_anew ? 0 : track.revision, now, std::numeric_limits<std::size_t>::max());
  bool begins_whole = news.is_whole;
  std::size_t bytes = 0;
  for (auto& frame : news.frames) {
    bytes += frame.content.size();
    bool const is_binary = frame.is_binary;
    bool const is_whole = std::exchange(begins_whole, false);
    Envelope const envelope{
        .feed = track.feed->name(), .feed_id = track.id, .revision = revision, .begins_whole = is_whole};
    store_.record({.at = utc,
                   .session = options_.session,
                   .feed = std::string(track.feed->name()),
                   .is_whole = is_whole,
                   .is_binary = is_binary,
                   .content = in_envelope(std::move(frame), envelope)});
  }
  track.revision = revision;
  if (!news.is_whole) {
    track.bytes_since += bytes;
    return;
  }
  track.whole_bytes = bytes;
  track.bytes_since = 0;
  track.whole_at = now;
}

}  // namespace lapwing::station
