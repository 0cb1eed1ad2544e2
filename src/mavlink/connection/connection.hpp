#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "link/byte_link.hpp"
#include "mavlink/codec/codec.hpp"
#include "mavlink/connection/command_ledger.hpp"
#include "mavlink/path/link_report.hpp"
#include "mavlink/signing/signing_guard.hpp"

namespace lapwing::mavlink {

namespace internal {
class Echoes;
class ImpossibleValues;
class Listeners;
class Routes;
struct PeerState;
}  // namespace internal

/// A message as it came in. References live for the callback.
struct Received {
  Message const& message;
  Address source;
  PeerRef from;
  base::TimePoint at;
};

/// Two senders use one system id: nobody can be commanded safely under it.
struct Conflict {
  std::uint8_t system_id = 0;
  std::string first;  ///< link and address of each
  std::string second;
};

/// Keeps a handler subscribed while it lives.
class [[nodiscard]] Subscription {
 public:
  using Handler = std::function<void(Received const&)>;
  Subscription() = default;
  explicit Subscription(std::shared_ptr<Handler> handler) : handler_(std::move(handler)) {}

 private:
  std::shared_ptr<Handler> handler_;  // the connection holds it weakly: dropping it during a call is safe
};

/// A MAVLink node: owns links, turns their bytes into messages and messages into bytes.
///
/// Remembers where each system is heard and sends there, from the socket on which it listens. A vehicle may be heard on
/// several links: what they bring is made one stream, commands go over the one that is alive, answers soonest and loses
/// least, bulk over the one that carries most; when it falls silent or refuses, over the next at once. (Which packets
/// are one vehicle's, and which two vehicles' that use one id: internal/same_vehicle.hpp.) Sends MAVLink 2, and MAVLink
/// 1 to a peer that never spoke anything else. Its heartbeat goes to every link that can be spoken to, to every peer
/// that spoke MAVLink, and at once to a new one (vehicles send texts only where they have heard a ground station).
/// Thread-bound to the loop.
class Connection {
 public:
  struct Options {
    Address self{255, 190};
    /// What the heartbeat says, asked each time. Empty: no heartbeats.
    std::function<Heartbeat()> heartbeat = ground_station_heartbeat;
    base::Duration heartbeat_period = std::chrono::seconds(1);
    /// How often each link of each vehicle is asked for its clock (TIMESYNC), which measures the round trip; vehicles
    /// that ask for ours are answered. Zero: neither.
    base::Duration timesync_period = std::chrono::seconds(5);
    /// Sign what is sent, and listen to nobody who does not (signing_guard.hpp). Nothing: signatures do not matter.
    std::optional<KeyRing> keys = std::nullopt;
    SigningTime signed_until = 0;  ///< by this program's last life
  };
  [[nodiscard]] static Heartbeat ground_station_heartbeat();

  Connection(base::Loop& loop, Options options, base::Logger log);
  Connection(Connection const&) = delete;
  Connection& operator=(Connection const&) = delete;
  ~Connection();

  /// Starts `link` at once. Returns its number, which PeerRef::link uses.
  std::size_t add_link(std::unique_ptr<link::ByteLink> link);

  /// Other keys from now on. Times of signatures go on where they were.
  void set_keys(std::optional<KeyRing> keys);
  /// Null while nothing is signed.
  [[nodiscard]] SigningGuard const* signing() const { return guard_ ? &*guard_ : nullptr; }

  /// Sends to where the system is heard best, with `target` written into the message if it has a target.
  /// Errors: lost (never heard, or its link is down), refused (two vehicles use this system id; names both).
  base::Result<> send(Address target, Message message);
  /// The same for a frame made by hand (`raw_message`), which names its addressee already.
  base::Result<> send(Address target, Frame frame);
  /// Sends on every link: to peers that spoke MAVLink and to standing peers. For heartbeats and a simulated vehicle's
  /// telemetry.
  void send_to_all(Message const& message);

  /// Asked before anything is sent to one vehicle: an error is what the sender gets. For an emergency stop, which holds
  /// back whatever would move a vehicle.
  using SendGuard = std::function<base::Result<>(Address, Message const&)>;
  void set_send_guard(SendGuard guard) { send_guard_ = std::move(guard); }

  /// `handler` sees every decoded message from now on (of one system, if given) until the subscription is destroyed.
  Subscription subscribe(Subscription::Handler handler);
  Subscription subscribe(std::uint8_t system_id, Subscription::Handler handler);

  enum class Direction { received, sent };
  /// Shows every frame, unknown messages included, but those that tell a key. For recordings.
  using FrameHook = std::function<void(Direction, Frame const&, base::TimePoint)>;
  void set_frame_hook(FrameHook hook);

  /// Shows each received frame that is new and may be heard, with where it came from. For those who pass frames on.
  using ForwardHook = std::function<void(PeerRef, Frame const&)>;
  void set_forward_hook(ForwardHook hook) { forward_hook_ = std::move(hook); }
  /// Sends packets of somebody else as they are, each by itself and as urgent as it is. False when a link did not take
  /// one of them, or the send guard holds it back.
  bool pass_on(PeerRef to, std::span<std::uint8_t const> packets);

  /// Link and address over which commands to the system go, for people: "udpin://0.0.0.0:14550 from 127.0.0.1:40001".
  [[nodiscard]] std::optional<std::string> whereabouts(std::uint8_t system_id) const;
  /// Set while two peers both keep claiming to be the autopilot of one system and are not proven to lead to one
  /// vehicle. One that falls silent for 5 s has left.
  [[nodiscard]] std::optional<Conflict> conflict(std::uint8_t system_id) const;
  /// The system id was heard from two addresses within seconds: two vehicles, or one that restarted or has two links
  /// and has not been told apart from that yet. Messages are still sent, to the address that was known first.
  [[nodiscard]] bool is_contested(std::uint8_t system_id) const;
  /// On the way over which commands go, as TIMESYNC has measured it (median of the last few); nothing until then.
  [[nodiscard]] std::optional<base::Duration> round_trip(std::uint8_t system_id) const;
  /// When that component was heard last: a companion on another link says nothing of the autopilot's.
  [[nodiscard]] std::optional<base::TimePoint> last_heard(Address source) const;
  /// Both far ends are known to lead to one vehicle of this system id.
  [[nodiscard]] bool are_one(std::uint8_t system_id, PeerRef a, PeerRef b) const;
  /// Summed over all paths.
  [[nodiscard]] SourceCounters counters(Address source) const;
  /// How every link does, in the order of `add_link`. Takes a while for many sources: for once a second, not for every
  /// message.
  [[nodiscard]] std::vector<LinkReport> report() const;
  /// Summed over the peers of one link.
  [[nodiscard]] ParserCounters parser_counters(std::size_t link) const;
  [[nodiscard]] std::vector<std::unique_ptr<link::ByteLink>> const& links() const { return links_; }

  [[nodiscard]] base::Loop& loop() const { return loop_; }
  [[nodiscard]] Address self() const { return options_.self; }
  /// Which commands are on their way: `run_command` keeps it.
  [[nodiscard]] CommandLedger& commands() { return commands_; }

 private:
  Subscription listen(std::optional<std::uint8_t> system_id, Subscription::Handler handler);
  void receive(PeerRef from, link::Bytes bytes);
  void accept(PeerRef from, internal::PeerState& peer, Frame const& frame);
  void look_into(PeerRef from, Frame const& frame);
  [[nodiscard]] std::optional<Message> understand(PeerRef from, Frame const& frame);
  /// `system_id`: who is meant; 0: whoever is there.
  bool send_frame(PeerRef to, Frame& frame, std::uint8_t system_id = 0);
  [[nodiscard]] bool may_be_heard(PeerRef from, Frame const& frame);
  [[nodiscard]] bool is_held_back(Frame const& frame) const;
  void note_passed_on(Frame const& frame);
  base::Task<void> beat();
  base::Task<void> watch();
  void ask_who_they_are(bool with_conflicts);
  [[nodiscard]] std::string describe(PeerRef peer) const;

  base::Loop& loop_;
  Options options_;
  base::Logger log_;
  std::vector<std::unique_ptr<link::ByteLink>> links_;
  std::unique_ptr<internal::Routes> routes_;
  std::unique_ptr<internal::Echoes> echoes_;  ///< ours that may come back
  std::unique_ptr<internal::ImpossibleValues> impossible_;
  std::vector<ImpossibleField> left_out_;  ///< of the message at hand
  std::unique_ptr<internal::Listeners> listeners_;
  FrameHook frame_hook_;
  ForwardHook forward_hook_;
  SendGuard send_guard_;
  CommandLedger commands_;
  std::optional<SigningGuard> guard_;
  bool has_told_of_strangers_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::mavlink
