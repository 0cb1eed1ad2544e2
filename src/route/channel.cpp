#include "route/internal/channel.hpp"

#include <fmt/format.h>

namespace lapwing::route::internal {

namespace {

/// Fits an Ethernet frame with IP and UDP heads, tunnels included.
std::size_t constexpr largest_pack = 1400;

bool is_stream(link::Transport transport) {
  return transport == link::Transport::tcp_in || transport == link::Transport::tcp_out ||
         transport == link::Transport::serial;
}

}  // namespace

void add(mavlink::ParserCounters& sum, mavlink::ParserCounters const& more) {
  sum.frames += more.frames;
  sum.crc_errors += more.crc_errors;
  sum.unknown_ids += more.unknown_ids;
  sum.junk_bytes += more.junk_bytes;
}

Channel::Channel(ChannelId number, Endpoint& on, link::Peer far_end, bool standing, base::TimePoint now)
    : id(number),
      endpoint(on),
      peer(far_end),
      name(fmt::format("{}: {}", on.options.name, on.link->peer_name(far_end))),
      is_standing(standing),
      heard(now),
      shaper_(on.options.limits.any() ? std::make_unique<Shaper>(on.options.limits) : nullptr),
      is_stream_(is_stream(on.options.url.transport)),
      largest_pack_(on.options.coalesces || is_stream_ ? largest_pack : 0) {
  pack_.reserve(largest_pack);
}

void Channel::offer(mavlink::FrameView const& frame, base::TimePoint now) {
  auto& out = endpoint.counters.out;
  if (!endpoint.options.out.passes(frame)) {
    ++out.filtered;
    return;
  }
  if (!shaper_) return put(frame.bytes, is_stream_ ? urgency_of(class_of(frame)) : link::Urgency::batched);
  switch (shaper_->offer(frame, now)) {
    case Shaper::Verdict::go: put(frame.bytes, urgency_of(class_of(frame))); break;
    case Shaper::Verdict::waits: break;
    case Shaper::Verdict::replaced: ++out.superseded; break;
    case Shaper::Verdict::displaced:
    case Shaper::Verdict::refused: ++out.overflowed; break;
  }
  out.expired += shaper_->take_expired();
}

void Channel::release(base::TimePoint now) {
  if (!shaper_) return;
  while (auto const frame = shaper_->release(now)) put(frame->bytes, urgency_of(frame->message_class));
  endpoint.counters.out.expired += shaper_->take_expired();
}

base::TimePoint Channel::next_release(base::TimePoint now) const {
  return shaper_ ? shaper_->next_release(now) : base::TimePoint::max();
}

/// The link of a slow stream drops the oldest of what is perishable; datagrams do not queue.
link::Urgency Channel::urgency_of(MessageClass message_class) const {
  return is_stream_ && message_class != MessageClass::command ? link::Urgency::perishable : link::Urgency::batched;
}

/// Only what is equally urgent goes together; all in the order in which it came, as gaps in the numbers of packets
/// count as losses.
void Channel::put(std::span<std::uint8_t const> frame, link::Urgency urgency) {
  endpoint.is_dirty = true;
  if (urgency != pack_urgency_ || pack_.size() + frame.size() > largest_pack_) flush();
  pack_urgency_ = urgency;
  pack_.insert(pack_.end(), frame.begin(), frame.end());
  ++packed_frames_;
}

void Channel::flush() {
  if (pack_.empty()) return;
  auto& out = endpoint.counters.out;
  if (endpoint.link->send(peer, pack_, pack_urgency_)) {
    out.frames += packed_frames_;
    out.bytes += pack_.size();
  } else {
    out.refused += packed_frames_;
  }
  pack_.clear();
  packed_frames_ = 0;
}

void Channel::abandon() {
  endpoint.counters.out.abandoned += waiting() + packed_frames_;
}

}  // namespace lapwing::route::internal
