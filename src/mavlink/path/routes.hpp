#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mavlink/connection/connection.hpp"
#include "mavlink/path/internal/address_conflict.hpp"
#include "mavlink/path/internal/path_merge.hpp"
#include "mavlink/path/internal/path_meter.hpp"
#include "mavlink/path/internal/path_selector.hpp"
#include "mavlink/path/internal/sequence.hpp"
#include "mavlink/wire/message_kinds.hpp"

namespace lapwing::mavlink::internal {

/// A far end, whatever speaks behind it.
struct PeerState {
  FrameParser parser;
  std::uint8_t next_seq = 0;  ///< each peer sees a sequence without gaps
  bool spoke = false;         ///< at least one valid frame came from it
  bool spoke_v2 = false;
  bool leads_to_autopilot = false;
  std::uint64_t unknown_ids = 0;  ///< as far as they are counted to a source
  base::TimePoint heard{};
  std::array<base::TimePoint, 8> asked{};  ///< the last TIMESYNC requests, a ring
  std::size_t asks = 0;
};

/// Who speaks MAVLink where: far ends, sources behind them, the paths (source and far end) on which each is heard, and
/// which path is the best.
class Routes {
 public:
  /// `forgotten` is told of far ends whose state is erased.
  explicit Routes(std::function<void(PeerRef)> forgotten) : forgotten_(std::move(forgotten)) {}

  /// What a link can carry; call once for each, in order.
  void add_link(std::optional<double> bytes_per_s) { bytes_per_s_.push_back(bytes_per_s); }

  /// The state of a far end; made when new. Bounded: the one silent for longest makes room, those that never spoke
  /// MAVLink first.
  [[nodiscard]] PeerState& hear(PeerRef peer, base::TimePoint now);
  /// The same for sending: nothing is forgotten for it.
  [[nodiscard]] PeerState& speak_to(PeerRef peer) { return peers_[peer]; }

  struct Taken {
    bool is_fresh = false;           ///< not delivered twice by this path
    bool is_news = false;            ///< nor told by another path of the vehicle
    bool is_one_of_several = false;  ///< the autopilot is heard at several far ends: `identify` wants to see it
  };
  /// Notes a frame that came from `peer`. Sources are bounded as far ends are: one that hardly spoke makes room first.
  Taken take(PeerRef peer, PeerState& state, Frame const& frame, base::TimePoint now);
  /// What tells one vehicle from another: TIMESYNC answers, hardware numbers, positions of autopilots.
  void identify(PeerRef peer, Address source, Message const& message, base::TimePoint now);

  /// Compares, chooses, forgets; call twice a second. Systems whose conflict is new.
  std::vector<std::uint8_t> examine(base::TimePoint now);
  struct Suspect {
    std::uint8_t system_id = 0;
    PeerRef peer;
    bool knows_hardware = false;
  };
  /// Whom to ask who they are; those of a known conflict only if told to.
  [[nodiscard]] std::vector<Suspect> suspects(bool with_conflicts, base::TimePoint now) const;
  /// Far ends to send TIMESYNC to: all that lead to an autopilot and were not asked for `period`, and the suspects.
  struct ClockQuestion {
    PeerRef peer;
    base::TimePoint asked;  ///< for ts1: its own for each far end, so that a router's copy of an answer is known as one
  };
  std::vector<ClockQuestion> ask_clocks(std::vector<Suspect> const& suspects, base::Duration period,
                                        base::TimePoint now);

  /// Where to send for `target`, best first: to its component, else to the system's autopilot, else to whoever of the
  /// system spoke last.
  [[nodiscard]] std::vector<PeerRef> routes_to(Address target, Traffic traffic, base::TimePoint now) const;
  /// Between here and the system's autopilot, on its first route for commands; nothing until it is measured.
  [[nodiscard]] std::optional<base::Duration> round_trip(std::uint8_t system_id, base::TimePoint now) const;
  /// Null for a system that was never heard.
  [[nodiscard]] AddressConflict const* claims(std::uint8_t system_id) const;
  /// Peers that spoke MAVLink not long before `now`.
  [[nodiscard]] std::vector<PeerRef> talkers(base::TimePoint now) const;

  [[nodiscard]] std::optional<base::TimePoint> last_heard(Address source) const;
  [[nodiscard]] SourceCounters counters(Address source) const;
  [[nodiscard]] ParserCounters parser_counters(std::size_t link) const;
  /// Fills in everything but names and what the link itself knows.
  void report(std::vector<LinkReport>& links, base::TimePoint now) const;

 private:
  struct System {
    AddressConflict claims;
    std::array<PathSelector, 2> choices;  ///< by Traffic
    [[nodiscard]] PathSelector& choice(Traffic traffic) { return choices[static_cast<std::size_t>(traffic)]; }
    [[nodiscard]] PathSelector const& choice(Traffic traffic) const {
      return choices[static_cast<std::size_t>(traffic)];
    }
  };
  struct Path {
    PeerRef peer;
    SequenceTracker sequence;
    PathMeter meter;
    [[nodiscard]] bool is_alive(base::TimePoint now) const { return meter.is_alive(sequence.counters(), now); }
  };
  struct Source {
    System* system = nullptr;
    std::vector<Path> paths;
    [[nodiscard]] base::TimePoint last_heard() const;
    [[nodiscard]] std::uint64_t received() const;
    std::unique_ptr<PathMerge> merge;            ///< once there are several paths
    std::map<std::size_t, SourceCounters> gone;  ///< by link: of paths that are forgotten
    [[nodiscard]] Path* find(PeerRef peer);
    void forget(std::vector<Path>::iterator path);
  };
  [[nodiscard]] Source& source_of(Address address);
  [[nodiscard]] Path& path_of(Source& source, PeerRef peer);
  [[nodiscard]] bool is_told_already(Source& source, PeerRef peer, Frame const& frame, base::TimePoint now);
  [[nodiscard]] std::vector<Candidate> candidates(Source const& source, Traffic traffic, base::TimePoint now) const;
  [[nodiscard]] double cost_s(Path const& path, Traffic traffic, base::TimePoint now) const;
  [[nodiscard]] SourceReport report(Address address, Source const& source, Path const& path, base::TimePoint now) const;
  [[nodiscard]] Source const* source_for(Address target) const;
  void make_room();
  void make_room_for_source();

  std::function<void(PeerRef)> forgotten_;
  std::vector<std::optional<double>> bytes_per_s_;  ///< of each link
  std::map<PeerRef, PeerState> peers_;
  std::map<std::uint8_t, System> systems_;  ///< before the sources that point into it
  std::map<Address, Source> sources_;
  std::map<std::size_t, SourceCounters> gone_;  ///< by link: of sources that are forgotten
};

}  // namespace lapwing::mavlink::internal
