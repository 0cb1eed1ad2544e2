#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mavlink/signing/signing.hpp"

namespace lapwing::mavlink {

/// Keys by the names that people gave them, and for whom each holds.
struct KeyRing {
  /// Names of keys: with the first we sign, each is accepted. Two while a key is changed for another: then we sign with
  /// the one that the vehicle signs with.
  using Use = std::vector<std::string>;
  /// Who is heard without a signature: nobody, but for RADIO_STATUS, which radios make and cannot sign.
  struct Unsigned {
    bool local_links = false;          ///< whoever is on a serial line or on this machine
    std::set<std::uint8_t> systems;    ///< these, on every link
    std::set<std::uint32_t> messages;  ///< these, from everybody
    friend bool operator==(Unsigned const&, Unsigned const&) = default;
  };

  std::map<std::string, SigningKey, std::less<>> keys;
  using Vehicles = std::map<std::uint8_t, Use>;
  Vehicles vehicles;                         ///< by system id; goes before
  std::map<std::string, Vehicles> networks;  ///< the same for the vehicles of further networks, by name
  std::map<std::string, Use> links;          ///< by URL; goes before
  Use everybody;
  Unsigned unsigned_frames;
  friend bool operator==(KeyRing const&, KeyRing const&) = default;
};

/// The vehicles of one network; empty: of the one without a name.
[[nodiscard]] KeyRing::Vehicles& vehicles_of(KeyRing& ring, std::string const& network);
/// What holds on one network: its vehicles are `vehicles`, and there are no others.
[[nodiscard]] KeyRing ring_of_network(KeyRing ring, std::string const& network);
/// A ring with one key, for everybody.
[[nodiscard]] KeyRing ring_of(SigningKey const& key);
[[nodiscard]] std::optional<KeyRing> ring_of(std::optional<SigningKey> const& key);
/// The first key of this vehicle, for the vehicle's own use; nothing if it has none.
[[nodiscard]] std::optional<SigningKey> key_for(KeyRing const& ring, std::uint8_t system_id);

/// Whether nobody but who sits at this machine can listen in: a serial line, or loopback. `url` as `link::parse_url`
/// takes it.
[[nodiscard]] bool is_local(std::string const& url);

/// What became of the frames that a guard saw.
struct SigningCounters {
  std::uint64_t accepted = 0;         ///< signed
  std::uint64_t unsigned_frames = 0;  ///< refused
  std::uint64_t wrong_key = 0;        ///< refused
  std::uint64_t replayed = 0;         ///< refused: heard before, or too old
};

/// Signs what goes out, and tells whom to listen to.
///
/// Refuses what carries no signature (unless the ring says otherwise), one of a key that does not hold for its sender,
/// or one whose time has passed: each sender's clock only goes forward, and a sender not heard before is at most a
/// minute behind. Each signature's time is later than every one before, whatever the clock does.
class SigningGuard {
 public:
  /// `signed_until`: no signature's time is earlier. What a program that runs anew must know of its last life.
  explicit SigningGuard(KeyRing ring, SigningTime signed_until = 0) : ring_(std::move(ring)), last_(signed_until) {}

  /// A far end of a link.
  struct Peer {
    std::size_t link = 0;
    std::uint64_t key = 0;
    friend auto operator<=>(Peer const&, Peer const&) = default;
  };
  /// Tells which link has the number that peers name.
  void name_link(std::size_t number, std::string const& url);

  /// `system_id` 0: for whoever is there. Leaves the frame as it is where no key holds, and for who speaks MAVLink 1.
  void sign(Frame& frame, Peer to, std::uint8_t system_id, base::UtcTime now);
  [[nodiscard]] bool accepts(Frame const& frame, Peer from, base::UtcTime now);

  [[nodiscard]] KeyRing const& ring() const { return ring_; }
  void set_ring(KeyRing ring) { ring_ = std::move(ring); }
  /// The name of the key with which this component's last frame was signed; empty: it was not signed; nothing: none was
  /// heard. An autopilot and its camera need not do alike.
  [[nodiscard]] std::optional<std::string> key_of(Address source) const;
  /// This far end is gone.
  void forget(Peer peer) { systems_at_.erase(peer); }
  /// The latest time that was sent or heard. To be kept for the program's next life.
  [[nodiscard]] SigningTime signed_until() const { return last_; }
  [[nodiscard]] SigningCounters const& counters() const { return counters_; }

 private:
  struct Link {
    std::string url;
    bool is_local = false;
  };
  struct Sender {
    Address source;
    std::uint8_t link_id = 0;
    friend auto operator<=>(Sender const&, Sender const&) = default;
  };
  [[nodiscard]] KeyRing::Use const& use_for(std::uint8_t system_id, std::size_t link) const;
  [[nodiscard]] std::string const* last_key_of(std::uint8_t system_id) const;
  [[nodiscard]] std::string const* signed_by(Frame const& frame, std::size_t link) const;
  [[nodiscard]] bool may_be_unsigned(Frame const& frame, std::size_t link) const;
  [[nodiscard]] bool is_late(Frame const& frame, base::UtcTime now);

  KeyRing ring_;
  std::map<std::size_t, Link> links_;
  SigningTime last_;
  std::map<Sender, SigningTime> heard_;
  std::map<Address, std::string> key_of_;
  std::map<Peer, std::set<std::uint8_t>> systems_at_;
  SigningCounters counters_;
};

}  // namespace lapwing::mavlink
