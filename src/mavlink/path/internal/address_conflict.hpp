#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mavlink/path/link_report.hpp"
#include "mavlink/path/same_vehicle.hpp"

namespace lapwing::mavlink::internal {

/// The far ends at which the autopilot of one system id is heard: one vehicle, several links to one, or several
/// vehicles.
///
/// The first is the *established* one. A vehicle that rebooted speaks from a new address and never again from the old
/// one; then the new one is established when the old has been silent for a moment. Two that both go on must prove that
/// they are one vehicle (same_vehicle.hpp); those that do not within 6 s are in conflict.
class AddressConflict {
 public:
  struct Claim {
    PeerRef peer;
    base::TimePoint heard{};
    base::TimePoint since{};  ///< when it (re)appeared beside another
    int returns = 0;          ///< how often it spoke after another had
    Fingerprint fingerprint{};
    SameVehicle same_vehicle{};  ///< to the established one
  };

  /// The autopilot spoke at `peer`. Cheap while there is one.
  void hear(PeerRef peer, base::TimePoint now);
  /// One packet, with a clock in it, came over both.
  void note_copy(PeerRef a, PeerRef b);
  /// Compares fingerprints; call twice a second. True when a conflict is new.
  [[nodiscard]] bool compare(base::TimePoint now);

  [[nodiscard]] bool are_several() const { return claims_.size() > 1; }
  [[nodiscard]] Claim* find(PeerRef peer);
  [[nodiscard]] Claim const* find(PeerRef peer) const;
  [[nodiscard]] std::optional<PeerRef> established(base::TimePoint now) const;
  /// It is the established far end, or proven to lead to the same vehicle.
  [[nodiscard]] bool is_proven(PeerRef peer, base::TimePoint now) const;
  /// Both are known to lead to one vehicle.
  [[nodiscard]] bool are_one(PeerRef a, PeerRef b) const;
  /// Heard not long ago, and not proven to be one.
  [[nodiscard]] bool is_contested(base::TimePoint now) const;
  /// Two that both go on, and are not one, as `compare` found it.
  [[nodiscard]] std::optional<std::pair<PeerRef, PeerRef>> const& conflict() const { return conflict_; }
  /// All that were heard not long ago.
  [[nodiscard]] std::vector<PeerRef> alive(base::TimePoint now) const;

 private:
  void establish(base::TimePoint now);
  [[nodiscard]] std::optional<std::pair<PeerRef, PeerRef>> find_conflict(base::TimePoint now) const;
  [[nodiscard]] bool is_like_first(PeerRef peer) const;

  std::vector<Claim> claims_;  ///< the established one first
  PeerRef last_{};             ///< who spoke last
  std::optional<std::pair<PeerRef, PeerRef>> conflict_;
};

}  // namespace lapwing::mavlink::internal
