#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "link/byte_link.hpp"
#include "mavlink/wire/frame.hpp"

/// How links do, in figures: for the operator's panel, `/metrics` and `lapwing doctor`. Plain values;
/// `Connection::report` makes them.
namespace lapwing::mavlink {

/// One far end as the connection knows it.
struct PeerRef {
  std::size_t link = 0;  ///< in the order of `add_link`
  link::Peer peer;
  friend constexpr auto operator<=>(PeerRef const&, PeerRef const&) = default;
};

/// What became of the messages of one source, or of several, since the start.
struct SourceCounters {
  std::uint64_t received = 0;    ///< without duplicates
  std::uint64_t lost = 0;        ///< gaps in the sequence that nothing filled later
  std::uint64_t duplicated = 0;  ///< came twice over this path; dropped
  std::uint64_t redundant = 0;   ///< of `received`: another path had told it already; dropped
  std::uint64_t out_of_order = 0;
  std::uint64_t unknown_ids = 0;  ///< of `received`: no message of our dialect

  SourceCounters& operator+=(SourceCounters const& more);
};

/// One source (system and component) over one path (link and far end).
struct SourceReport {
  Address source{};
  PeerRef from{};
  std::string address;  ///< of the far end, for people: "127.0.0.1:40001"
  SourceCounters counters{};
  double messages_per_s = 0.0;  ///< over the last 10 s, as are the next two
  double bytes_per_s = 0.0;
  double loss = 0.0;                         ///< 0..1
  std::optional<base::Duration> round_trip;  ///< median of the last few TIMESYNC answers; nothing when there are none
  base::Duration age{};                      ///< since the last message
  bool is_alive = false;                     ///< not silent for longer than is usual for it
  bool is_route = false;                     ///< commands for this system go here
};

/// A field of a message in which vehicles told what cannot be. It was left out.
struct ImpossibleValues {
  std::string_view message;  ///< as the dialect calls them
  std::string_view field;
  std::uint64_t count = 0;
};

/// One link with everything that is heard on it.
struct LinkReport {
  std::size_t number = 0;  ///< in the order of `add_link`
  std::string name;        ///< URL
  link::LinkState state = link::LinkState::opening;
  std::string last_error;                    ///< empty when it is open
  link::LinkCounters bytes{};                ///< what went through it, what was dropped before it
  ParserCounters frames{};                   ///< CRC errors, unknown ids, junk (whose they were cannot be told)
  SourceCounters counters{};                 ///< the sum over its sources, those that are gone included
  double messages_per_s = 0.0;               ///< over the last 10 s, as are the next two
  double bytes_per_s = 0.0;                  ///< of messages
  double loss = 0.0;                         ///< 0..1
  std::optional<base::Duration> round_trip;  ///< of its quickest source
  std::optional<base::Duration> age;         ///< since the last message; nothing when none ever came
  std::vector<SourceReport> sources;         ///< by system, component, far end
  std::vector<ImpossibleValues> impossible_values;
};

}  // namespace lapwing::mavlink
