#include "station/viewers.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "base/text/random_name.hpp"
#include "station/feeds/envelope.hpp"

namespace lapwing::station {

namespace {

/// Messages that only together lead to a revision.
struct Step {
  std::vector<HttpServer::Message> messages;
  std::uint64_t revision = 0;
};

std::vector<Step> steps_of(News news, std::string_view feed, std::uint16_t id, std::uint64_t since) {
  std::vector<Step> steps;
  bool begins_whole = news.is_whole;
  auto revision = begins_whole ? 0 : since;
  Step step;
  for (auto& frame : news.frames) {
    if (frame.revision > 0) revision = frame.revision;
    bool const is_last = frame.revision > 0;
    Envelope const envelope{
        .feed = feed, .feed_id = id, .revision = revision, .begins_whole = std::exchange(begins_whole, false)};
    bool const is_binary = frame.is_binary;
    step.messages.push_back({std::make_shared<std::string const>(in_envelope(std::move(frame), envelope)), is_binary});
    if (!is_last) continue;
    step.revision = revision;
    steps.push_back(std::exchange(step, {}));
  }
  LAPWING_ASSERT(step.messages.empty(), feed);
  return steps;
}

}  // namespace

/// What a feed tells those who have all the same of it is encoded once.
struct Viewers::Round {
  base::TimePoint now;
  std::uint64_t since = 0;
  std::optional<std::vector<Step>> steps = std::nullopt;

  std::vector<Step> const& steps_since(std::uint64_t revision, Channel const& channel) {
    if (steps && since == revision) return *steps;
    since = revision;
    auto news = channel.feed->since(revision, now, channel.feed->max_unsent_bytes());
    steps = steps_of(std::move(news), channel.feed->name(), channel.id, revision);
    return *steps;
  }
};

Viewers::Viewers(base::Loop& loop, HttpServer& server, std::vector<std::unique_ptr<Feed>> usual,
                 std::vector<std::unique_ptr<Feed>> further)
    : loop_(loop), server_(server), run_(base::random_name(16)) {
  auto const add = [this](std::unique_ptr<Feed> feed, bool is_usual) {
    LAPWING_ASSERT(!find(feed->name()), feed->name());
    auto const id = static_cast<std::uint16_t>(channels_.size() + 1);
    channels_.push_back({.feed = std::move(feed), .id = id, .is_usual = is_usual});
  };
  for (auto& feed : usual) add(std::move(feed), true);
  for (auto& feed : further) add(std::move(feed), false);
}

FeedList Viewers::feeds() const {
  FeedList list{.run = run_, .feeds = {}};
  for (auto const& channel : channels_)
    list.feeds.push_back({std::string(channel.feed->name()), channel.id, channel.is_usual});
  return list;
}

std::vector<Feed*> Viewers::all_feeds() const {
  std::vector<Feed*> all;
  for (auto const& channel : channels_) all.push_back(channel.feed.get());
  return all;
}

Viewers::Channel const* Viewers::find(std::string_view name) const {
  auto const found = std::ranges::find_if(channels_, [&](auto const& channel) { return channel.feed->name() == name; });
  return found == channels_.end() ? nullptr : &*found;
}

// ---- who watches what

void Viewers::open(SessionId session, bool waits) {
  auto& viewer = viewers_[session];
  viewer.waits = waits;
  if (waits) return;
  for (auto const& channel : channels_)
    if (channel.is_usual) viewer.feeds[channel.id] = {};
  serve_at_once(session, viewer);
}

base::Result<> Viewers::subscribe(SessionId session, Subscribe const& wanted) {
  auto const viewer = viewers_.find(session);
  if (viewer == viewers_.end()) return {};
  std::map<std::uint16_t, Standing> feeds;
  for (auto const& name : wanted.feeds) {
    auto const* const channel = find(name);
    if (!channel) {
      std::string names;
      for (auto const& known : channels_) names += fmt::format("{}{}", names.empty() ? "" : ", ", known.feed->name());
      return base::fail(base::ErrorKind::invalid_input, fmt::format("There is no feed \"{}\".", name),
                        fmt::format("This station has {}.", names));
    }
    auto& standing = feeds[channel->id];
    auto const had = viewer->second.feeds.find(channel->id);
    auto const named = wanted.revisions.find(name);
    if (had != viewer->second.feeds.end()) {
      standing = had->second;
    } else if (wanted.run == run_ && named != wanted.revisions.end() && named->second <= channel->revision) {
      standing.revision = named->second;
    }
  }
  viewer->second.feeds = std::move(feeds);
  return {};
}

void Viewers::begin(SessionId session) {
  auto const viewer = viewers_.find(session);
  if (viewer == viewers_.end() || !std::exchange(viewer->second.waits, false)) return;
  serve_at_once(session, viewer->second);
}

// ---- what they are sent

void Viewers::refresh(Channel& channel, base::TimePoint now) {
  auto const before = std::exchange(channel.revision, channel.feed->refresh(now));
  LAPWING_ASSERT(channel.revision > 0 && channel.revision >= before, channel.feed->name(), channel.revision, before);
}

bool Viewers::is_watched(Channel const& channel) const {
  return std::ranges::any_of(viewers_, [&](auto const& entry) { return entry.second.feeds.contains(channel.id); });
}

void Viewers::send_news(std::string_view group) {
  auto const now = loop_.now();
  for (auto& channel : channels_) {
    if (!channel.feed->name().starts_with(group) || !is_watched(channel)) continue;
    refresh(channel, now);
    Round round{.now = now};
    for (auto& [session, viewer] : viewers_) {
      auto const standing = viewer.feeds.find(channel.id);
      if (standing != viewer.feeds.end() && !viewer.waits) serve(session, standing->second, channel, round);
    }
  }
}

void Viewers::serve_at_once(SessionId session, Viewer& viewer) {
  auto const now = loop_.now();
  for (auto& channel : channels_) {
    auto const standing = viewer.feeds.find(channel.id);
    if (standing == viewer.feeds.end()) continue;
    refresh(channel, now);
    Round round{.now = now};
    serve(session, standing->second, channel, round);
  }
}

void Viewers::go_on(SessionId session) {
  auto const viewer = viewers_.find(session);
  if (viewer == viewers_.end()) return;
  auto const now = loop_.now();
  for (auto const& channel : channels_) {
    auto const standing = viewer->second.feeds.find(channel.id);
    if (standing == viewer->second.feeds.end() || !standing->second.is_cut) continue;
    Round round{.now = now};
    serve(session, standing->second, channel, round);
  }
}

void Viewers::serve(SessionId session, Standing& standing, Channel const& channel, Round& round) {
  if (standing.revision == channel.revision) return;
  HttpServer::Lane const lane{channel.id, channel.feed->max_unsent_bytes()};
  standing.is_cut = true;
  if (server_.unsent_bytes(session, lane.number) >= lane.max_unsent_bytes) return;
  auto const& steps = round.steps_since(standing.revision, channel);
  for (auto const& step : steps) {
    if (!server_.send(session, step.messages, lane)) return;
    standing.revision = step.revision;
  }
  if (steps.empty()) standing.revision = channel.revision;
  standing.is_cut = standing.revision != channel.revision;
}

}  // namespace lapwing::station
