#include "route/router.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mavlink/signing/signing.hpp"
#include "route/internal/channel.hpp"

namespace lapwing::route {

using namespace std::chrono_literals;

namespace {

/// Far ends that come and go without a word (TCP, serial lines) are noticed so soon.
base::Duration constexpr look_around_period = 100ms;

}  // namespace

void limit_serial_line(EndpointOptions& options) {
  if (options.url.transport != link::Transport::serial || !std::isinf(options.limits.all.bytes_per_s)) return;
  double constexpr bits_per_byte = 10.0;  // with start and stop bit
  double constexpr margin = 0.95;         // clocks differ
  options.limits.all.bytes_per_s = options.url.port_or_baud / bits_per_byte * margin;
}

Router::Router(base::Loop& loop, Options options, base::Logger log)
    : loop_(loop), options_(options), log_(std::move(log)), release_is_due_(loop), scope_(loop) {
  scope_.spawn(keep_looking_around());
  scope_.spawn(keep_releasing());
}

Router::~Router() = default;

base::Result<> Router::open(std::vector<EndpointOptions> endpoints) {
  std::vector<std::unique_ptr<link::ByteLink>> links;
  for (auto const& endpoint : endpoints) {
    auto link = link::open(loop_, endpoint.url);
    if (!link) return std::unexpected(link.error());
    links.push_back(std::move(*link));
  }
  for (std::size_t i = 0; i < endpoints.size(); ++i) {
    limit_serial_line(endpoints[i]);
    add(std::move(endpoints[i]), std::move(links[i]));
  }
  return {};
}

void Router::add(EndpointOptions options, std::unique_ptr<link::ByteLink> link) {
  if (options.name.empty()) options.name = link->name();
  endpoints_.push_back(std::make_unique<Endpoint>(Endpoint{.options = std::move(options), .link = std::move(link)}));
  auto& endpoint = *endpoints_.back();
  endpoint.link->on_drained([this] { flush(); });
  endpoint.link->start([this, &endpoint](link::Peer peer, link::Bytes bytes) { receive(endpoint, peer, bytes); });
  look_around(endpoint);
}

// ---- the way of a packet

void Router::receive(Endpoint& endpoint, link::Peer peer, link::Bytes bytes) {
  auto* channel = find(endpoint, peer);
  if (!channel) channel = meet(endpoint, peer, bytes);
  if (!channel) return;
  auto const now = loop_.now();
  channel->parser.feed_views(bytes, [&](mavlink::FrameView const& frame) { take(*channel, frame, now); });
}

void Router::take(Channel& from, mavlink::FrameView const& frame, base::TimePoint now) {
  auto& endpoint = from.endpoint;
  auto& in = endpoint.counters.in;
  ++in.frames;
  in.bytes += frame.bytes.size();
  from.heard = now;
  if (endpoint.options.is_read_only || endpoint.options.is_sniffer) {
    ++in.read_only;
    return;
  }
  if (!endpoint.options.in.passes(frame)) {
    ++in.filtered;
    return;
  }
  if (options_.drops_duplicates && duplicates_.is_copy(frame, from.id, now)) {
    ++in.duplicates;
    return;
  }
  table_.learn(frame.source, from.id, now);
  bool const is_for_all = frame.target().system == 0 && !mavlink::tells_a_key(frame.message_id);
  if (is_for_all) return send_to_all(from, frame, now);
  if (!send_to_one(from, frame, now)) ++in.unroutable;
}

void Router::send_to_all(Channel const& from, mavlink::FrameView const& frame, base::TimePoint now) {
  for (auto* to : active_) {
    if (to == &from || (&to->endpoint == &from.endpoint && !from.endpoint.options.between_members)) continue;
    to->offer(frame, now);
  }
}

/// To everyone who looks on, too, whether or not the addressee is known; but keys are nobody else's business.
bool Router::send_to_one(Channel const& from, mavlink::FrameView const& frame, base::TimePoint now) {
  bool is_known = false;
  table_.for_each(frame.target(), [&](ChannelId id) {
    if (id == from.id) return;
    channels_[id]->offer(frame, now);
    is_known = true;
  });
  if (mavlink::tells_a_key(frame.message_id)) return is_known;
  for (auto* to : active_) {
    if (to->endpoint.options.is_sniffer) to->offer(frame, now);
  }
  return is_known;
}

/// All that lay ready on a link has been passed on: what was held back for company goes out.
void Router::flush() {
  auto const now = loop_.now();
  auto next = base::TimePoint::max();
  for (auto* channel : active_) {
    if (channel->endpoint.is_dirty) channel->flush();
    next = std::min(next, channel->next_release(now));
  }
  for (auto const& endpoint : endpoints_) {
    if (std::exchange(endpoint->is_dirty, false)) endpoint->link->flush();
  }
  if (next < next_release_) release_is_due_.notify_all();
}

base::Task<> Router::keep_releasing() {
  for (;;) {
    auto const now = loop_.now();
    next_release_ = base::TimePoint::max();
    for (auto* channel : active_) {
      channel->release(now);
      next_release_ = std::min(next_release_, channel->next_release(now));
    }
    flush();
    co_await release_is_due_.wait_until(next_release_);
  }
}

// ---- far ends

internal::Channel* Router::find(Endpoint& endpoint, link::Peer peer) const {
  auto const found = endpoint.channels.find(peer.key);
  return found == endpoint.channels.end() ? nullptr : found->second;
}

/// A far end that spoke for the first time. On a link that does not know its far ends, only what speaks MAVLink is one.
internal::Channel* Router::meet(Endpoint& endpoint, link::Peer peer, link::Bytes bytes) {
  auto const standing = endpoint.link->standing_peers();
  if (std::ranges::find(standing, peer) != standing.end()) return &add_channel(endpoint, peer, true);
  mavlink::FrameParser parser;
  bool speaks_mavlink = false;
  parser.feed_views(bytes, [&](mavlink::FrameView const&) { speaks_mavlink = true; });
  if (speaks_mavlink) return &add_channel(endpoint, peer, false);
  endpoint.parser.junk_bytes += bytes.size();
  return nullptr;
}

internal::Channel& Router::add_channel(Endpoint& endpoint, link::Peer peer, bool is_standing) {
  if (endpoint.channels.size() >= options_.max_far_ends) make_room(endpoint);
  auto free = std::ranges::find_if(channels_, [](auto const& channel) { return !channel; });
  if (free == channels_.end()) free = channels_.emplace(channels_.end());
  auto const id = static_cast<ChannelId>(free - channels_.begin());
  *free = std::make_unique<Channel>(id, endpoint, peer, is_standing, loop_.now());
  endpoint.channels.emplace(peer.key, free->get());
  active_.push_back(free->get());
  log_.info(fmt::format("{} is there", (*free)->name));
  return **free;
}

void Router::make_room(Endpoint& endpoint) {
  Channel* oldest = nullptr;
  for (auto const& [key, channel] : endpoint.channels) {
    if (!oldest || channel->heard < oldest->heard) oldest = channel;
  }
  if (oldest) remove(*oldest, "makes room for another");
}

void Router::remove(Channel& channel, std::string_view why) {
  auto& endpoint = channel.endpoint;
  log_.info(fmt::format("{} {}", channel.name, why));
  channel.abandon();
  internal::add(endpoint.parser, channel.parser.counters());
  endpoint.channels.erase(channel.peer.key);
  table_.forget(channel.id);
  std::erase(active_, &channel);
  channels_[channel.id].reset();
}

/// Takes note of far ends that the link came to know, and of those that are gone.
void Router::look_around(Endpoint& endpoint) {
  auto const standing = endpoint.link->standing_peers();
  for (auto const peer : standing) {
    if (!find(endpoint, peer)) add_channel(endpoint, peer, true);
  }
  std::vector<Channel*> gone;
  for (auto const& [key, channel] : endpoint.channels) {
    bool const stands = std::ranges::find(standing, channel->peer) != standing.end();
    if (!stands && (channel->is_standing || loop_.now() - channel->heard > options_.silent_after))
      gone.push_back(channel);
  }
  for (auto* channel : gone) remove(*channel, channel->is_standing ? "is gone" : "is silent");
}

base::Task<> Router::keep_looking_around() {
  for (;;) {
    co_await loop_.sleep(look_around_period);
    for (auto const& endpoint : endpoints_) look_around(*endpoint);
  }
}

std::vector<EndpointStatus> Router::status() const {
  std::vector<EndpointStatus> all;
  for (auto const& endpoint : endpoints_) {
    auto& status = all.emplace_back(EndpointStatus{.name = endpoint->options.name,
                                                   .url = endpoint->link->name(),
                                                   .state = endpoint->link->state(),
                                                   .far_ends = endpoint->channels.size(),
                                                   .counters = endpoint->counters,
                                                   .parser = endpoint->parser,
                                                   .link = endpoint->link->counters()});
    for (auto const& [key, channel] : endpoint->channels) {
      status.waiting += channel->waiting();
      internal::add(status.parser, channel->parser.counters());
    }
  }
  return all;
}

}  // namespace lapwing::route
