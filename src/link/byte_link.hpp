#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "link/url.hpp"

namespace lapwing::link {

/// The far end of a link. A link that waits for others (udp in, tcp in) has many; each keeps its key while it stays at
/// the same address. The key means something to its link only.
struct Peer {
  std::uint64_t key = 0;
  friend constexpr auto operator<=>(Peer const&, Peer const&) = default;
};

using Bytes = std::span<std::uint8_t const>;

enum class LinkState {
  opening,  ///< not there yet, or gone and being tried again
  open,
  closed,  ///< for good
};

/// What a sender knows of how soon its bytes are wanted at the far end.
enum class Urgency {
  urgent,   ///< what stops a vehicle: before everything that waits, and in the place of the oldest if there is no room
  prompt,   ///< commands and answers: out now, before all that is perishable and waits
  batched,  ///< the same, but may wait for others until `flush`: many for the price of one
  perishable,  ///< worth little when it is late: telemetry, heartbeats, corrections, setpoints
};

struct LinkCounters {
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t chunks_received = 0;  ///< datagrams, or reads of a stream
  std::uint64_t chunks_sent = 0;
  std::uint64_t send_failures = 0;       ///< chunks that the operating system or a full queue refused
  std::uint64_t perishable_dropped = 0;  ///< chunks that waited for too long, or had to make room in a full queue
  std::uint64_t bytes_queued = 0;        ///< now: accepted, not yet with the operating system
  std::uint64_t overruns = 0;            ///< datagrams that arrived and found the kernel's queue full: never seen here
};

/// A carrier of bytes to one or many peers. Does not know what the bytes mean.
///
/// Thread-bound to its loop. Stream links come back by themselves after the far end went away. Destroying it closes it;
/// it must not be destroyed from within its own callback.
class ByteLink {
 public:
  using Receive = std::function<void(Peer, Bytes)>;
  virtual ~ByteLink() = default;

  /// For people: the URL.
  [[nodiscard]] virtual std::string name() const = 0;
  /// For people: the address of one peer.
  [[nodiscard]] virtual std::string peer_name(Peer peer) const = 0;
  /// Begins to deliver what arrives. Call once.
  virtual void start(Receive receive) = 0;
  /// `drained` is called whenever all that lay ready has been received, before others have their turn: the moment to
  /// `flush`. Call before `start`.
  void on_drained(std::function<void()> drained) { drained_ = std::move(drained); }
  /// Copies the bytes where they have to wait. False when they were dropped (peer unknown, link not open, queue full);
  /// also counted. Where a slow link has a queue, two seconds of the line at most wait in it, and the oldest of what is
  /// perishable is dropped (and counted) when there is no room: each call's bytes as a whole, so hand it whole packets.
  /// True when the bytes are on their way for now.
  virtual bool send(Peer peer, Bytes bytes, Urgency urgency = Urgency::prompt) = 0;
  /// Sends what was `batched`.
  virtual void flush() {}
  /// Peers that may be spoken to before they spoke: the target of udp out, an open serial line, connected TCP ends.
  [[nodiscard]] virtual std::vector<Peer> standing_peers() const = 0;
  [[nodiscard]] virtual LinkState state() const = 0;
  /// Why it is not open; empty when it is.
  [[nodiscard]] virtual std::string last_error() const = 0;
  [[nodiscard]] virtual LinkCounters counters() const = 0;
  /// What the line can carry each way, where that is known and little: a serial line's speed.
  [[nodiscard]] virtual std::optional<double> bytes_per_s() const { return std::nullopt; }

 protected:
  void tell_drained() const {
    if (drained_) drained_();
  }

 private:
  std::function<void()> drained_;
};

/// The link that `url` names. Error (io): the port is taken, the address is not this machine's; says what to do. Far
/// ends that are not there yet (TCP server, serial device) are no error: the link tries again.
[[nodiscard]] base::Result<std::unique_ptr<ByteLink>> open(base::Loop& loop, Url const& url);

}  // namespace lapwing::link
