#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mavlink/connection.hpp"
#include "mavlink/internal/sequence.hpp"

namespace lapwing::mavlink::internal {

/// A far end, whatever speaks behind it.
struct PeerState {
  FrameParser parser;
  std::uint8_t next_seq = 0;  ///< each peer sees a sequence without gaps
  bool spoke = false;         ///< at least one valid frame came from it
  bool spoke_v2 = false;
  base::TimePoint heard{};
};

/// Who speaks MAVLink where: far ends, sources behind them, and which far ends claim to be the same system.
class Routes {
 public:
  /// The state of a far end; made when new. Bounded: the one silent for longest makes room, those that never spoke
  /// MAVLink first.
  [[nodiscard]] PeerState& hear(PeerRef peer, base::TimePoint now);
  /// The same for sending: nothing is forgotten for it.
  [[nodiscard]] PeerState& speak_to(PeerRef peer) { return peers_[peer]; }

  struct Taken {
    bool fresh = false;         ///< not a duplicate
    bool conflict_new = false;  ///< with this frame two peers are known to use one system id
  };
  /// Notes a frame of `source` that came from `peer`.
  Taken take(Address source, PeerRef peer, std::uint8_t seq, std::uint16_t checksum, base::TimePoint now);

  /// Where to send for `target`: its component, else the system's autopilot, else whoever of the system spoke last.
  [[nodiscard]] std::optional<PeerRef> route_to(Address target) const;
  /// Every peer that claimed the system not long before `now`.
  [[nodiscard]] std::vector<PeerRef> claimants(std::uint8_t system_id, base::TimePoint now) const;
  /// The two peers that keep claiming the system, at `now`.
  [[nodiscard]] std::optional<std::pair<PeerRef, PeerRef>> conflict(std::uint8_t system_id, base::TimePoint now) const;
  /// Peers that spoke MAVLink not long before `now`.
  [[nodiscard]] std::vector<PeerRef> talkers(base::TimePoint now) const;
  /// When any component of the system was heard last.
  [[nodiscard]] std::optional<base::TimePoint> last_heard(std::uint8_t system_id) const;
  [[nodiscard]] SourceCounters counters(Address source) const;
  [[nodiscard]] ParserCounters parser_counters(std::size_t link) const;

 private:
  struct Source {
    PeerRef peer;
    base::TimePoint heard{};
    std::map<std::size_t, SequenceTracker> by_link;
  };
  struct Claim {
    PeerRef peer;
    base::TimePoint heard;
  };
  /// Peers that recently spoke as the autopilot of one system. A vehicle that rebooted speaks from a new address and
  /// never again from the old one; two vehicles take turns, so that a peer comes back after the other was heard.
  struct Claims {
    std::vector<Claim> alive;  ///< the last to speak at the end
    int returns = 0;
  };
  bool claim(Claims& claims, PeerRef peer, base::TimePoint now);
  void make_room();

  std::map<PeerRef, PeerState> peers_;
  std::map<Address, Source> sources_;
  std::map<std::uint8_t, Claims> claims_;
};

}  // namespace lapwing::mavlink::internal
