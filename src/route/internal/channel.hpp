#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "route/endpoint.hpp"
#include "route/routing_table.hpp"

/// What a router has for each of its links and for each far end on them.
namespace lapwing::route::internal {

struct Endpoint;

/// One far end: reads its bytes, and lets out what is for it, at the endpoint's pace and in its packing.
class Channel {
 public:
  Channel(ChannelId id, Endpoint& endpoint, link::Peer peer, bool is_standing, base::TimePoint now);

  /// A frame for this far end: filtered, then sent, kept for later or dropped. Counted in any case.
  void offer(mavlink::FrameView const& frame, base::TimePoint now);
  /// Sends what waited and may go now.
  void release(base::TimePoint now);
  /// Gives the link what was held back to share a datagram.
  void flush();
  /// The far end is gone: what waits for it is counted as dropped.
  void abandon();

  [[nodiscard]] base::TimePoint next_release(base::TimePoint now) const;
  [[nodiscard]] std::size_t waiting() const { return shaper_ ? shaper_->waiting() : 0; }

  ChannelId const id;
  Endpoint& endpoint;
  link::Peer const peer;
  std::string const name;  ///< for people; the link forgets it with the far end
  bool const is_standing;  ///< the link knows it; it is gone when the link says so
  base::TimePoint heard;
  mavlink::FrameParser parser;

 private:
  void put(std::span<std::uint8_t const> frame, link::Urgency urgency);
  [[nodiscard]] link::Urgency urgency_of(MessageClass message_class) const;

  std::unique_ptr<Shaper> shaper_;  ///< null: no limits
  bool const is_stream_;
  std::size_t const largest_pack_;
  std::vector<std::uint8_t> pack_;
  std::uint64_t packed_frames_ = 0;
  link::Urgency pack_urgency_ = link::Urgency::batched;
};

struct Endpoint {
  EndpointOptions options;
  std::unique_ptr<link::ByteLink> link;
  EndpointCounters counters = {};
  mavlink::ParserCounters parser = {};  ///< of far ends that are gone, and of what never spoke MAVLink
  std::unordered_map<std::uint64_t, Channel*> channels = {};  ///< by the peer's key
  bool is_dirty = false;                                      ///< the link holds something to flush
};

void add(mavlink::ParserCounters& sum, mavlink::ParserCounters const& more);

}  // namespace lapwing::route::internal
