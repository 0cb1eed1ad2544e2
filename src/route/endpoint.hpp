#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/wire/frame.hpp"
#include "route/filter.hpp"
#include "route/shaper.hpp"

namespace lapwing::route {

/// One link of a router and what is to be done on it.
struct EndpointOptions {
  std::string name = {};  ///< for people and metrics; empty: the URL
  link::Url url = {};
  /// Its far ends get everything, whomever it is for, and are not listened to.
  bool is_sniffer = false;
  /// What its far ends send goes nowhere.
  bool is_read_only = false;
  /// Far ends of this endpoint hear what others of it send to all. What is sent to one of them reaches it anyway.
  bool between_members = false;
  /// Several frames in one datagram when several are ready, as autopilots send them: half the work for both ends, and
  /// so the shorter wait under load. None is held back for company. Streams have no datagrams and always do.
  bool coalesces = true;
  Filter in = {};      ///< what comes from the far ends
  Filter out = {};     ///< what goes to them
  Limits limits = {};  ///< of what goes to each of them
};

/// Frames of an endpoint, by what became of each. Every frame that came in or was meant to go out is in one of them.
struct EndpointCounters {
  struct In {
    std::uint64_t frames = 0;  ///< all that came, and that the next ones are part of
    std::uint64_t bytes = 0;
    std::uint64_t filtered = 0;    ///< dropped by the filter
    std::uint64_t read_only = 0;   ///< dropped: the endpoint is read-only
    std::uint64_t duplicates = 0;  ///< dropped: came before over another way
    std::uint64_t unroutable = 0;  ///< dropped: for a system or component that was heard nowhere else
  } in = {};
  struct Out {
    std::uint64_t frames = 0;  ///< given to the link
    std::uint64_t bytes = 0;
    std::uint64_t filtered = 0;    ///< dropped by the filter
    std::uint64_t superseded = 0;  ///< dropped: a newer value came while it waited for the rate limit
    std::uint64_t overflowed = 0;  ///< dropped: too many waited for the rate limit
    std::uint64_t expired = 0;     ///< dropped: it waited for so long that it was worth nothing any more
    std::uint64_t refused = 0;     ///< dropped: the link did not take it
    std::uint64_t abandoned = 0;   ///< dropped: the far end went away while it waited
  } out = {};
};

/// An endpoint as it is now.
struct EndpointStatus {
  std::string name;
  std::string url;
  link::LinkState state = link::LinkState::opening;
  std::size_t far_ends = 0;
  std::size_t waiting = 0;  ///< frames, for the rate limit
  EndpointCounters counters;
  mavlink::ParserCounters parser;
  link::LinkCounters link;
};

}  // namespace lapwing::route
