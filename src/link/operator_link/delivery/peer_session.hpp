#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/async/mailbox.hpp"
#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "link/operator_link/carrier/channel.hpp"
#include "link/operator_link/delivery/incoming.hpp"
#include "link/operator_link/delivery/outgoing.hpp"
#include "link/operator_link/wire/json_objects.hpp"

namespace lapwing::link::operator_link {

enum class EventKind : std::uint8_t {
  connected,
  lost,       ///< the connection ended, or the far end fell silent
  refused,    ///< the far end did not let this one in, or this one somebody else
  malformed,  ///< something came that is no message
  crowded,    ///< a queue is full: a message was refused
  relieved,   ///< and has room again
  disk,       ///< a queue's disk does not do what it should
  missing,    ///< the far end's disk has lost messages
};
[[nodiscard]] std::string_view to_string(EventKind kind);

/// Something that an operator may want to know of.
struct Event {
  EventKind kind = EventKind::connected;
  std::string peer;  ///< its name, or its address while it has said none
  std::string text;
};

/// How a session treats silence, and how much it holds.
struct SessionOptions {
  base::Duration link_lost = std::chrono::seconds(3);  ///< who is silent for so long is gone
  Window window{};
  Outgoing::Limits limits{};
};

struct SessionCounters {
  std::uint64_t connections = 0;
  std::uint64_t messages_sent = 0;  ///< those that were said again, too
  std::uint64_t messages_taken = 0;
  std::optional<base::Duration> round_trip;  ///< the last ping's
};

/// All there is with one far end, whether it is connected or not: what is to be said, what was heard and not taken, and
/// the connection of the moment. Connections come and go; messages go on where the last one ended.
///
/// Thread-bound to its loop, which outlives it. Must not be destroyed from within its own callbacks.
class PeerSession {
 public:
  struct Events {
    std::function<void()> arrived;  ///< `take` has something
    std::function<void(Event)> event;
  };
  PeerSession(base::Loop& loop, std::string peer, std::uint64_t instance, std::unique_ptr<DurableQueue> queue,
              SessionOptions options, Events events);
  PeerSession(PeerSession const&) = delete;
  PeerSession& operator=(PeerSession const&) = delete;
  ~PeerSession();

  // What programs say and hear.

  /// Error: invalid_input (too long), refused (no room), io (disk).
  [[nodiscard]] base::Result<MessageId> send(Message message);
  /// The same, and waits until it was taken. Error also: timed_out (a durable one still arrives), cancelled (overtaken
  /// or expired), lost (nobody knows).
  [[nodiscard]] base::Task<base::Result<>> deliver(Message message, base::Duration timeout);
  /// The same for one that `send` has just given the id of, on the same turn; nobody else waits for it.
  [[nodiscard]] base::Task<base::Result<>> taken(MessageId id, base::Duration timeout);
  /// Waits until no message of the kind is left that the far end has not taken.
  [[nodiscard]] base::Task<bool> drained(Kind kind, base::Duration timeout);
  /// The next message, which counts as taken and is confirmed.
  [[nodiscard]] std::optional<Received> take();
  /// The one that `take` would give, for who wants to have acted on it before it is confirmed: killed in between, he
  /// gets it again, under the same stream and number. Valid until something else is called.
  [[nodiscard]] Received const* front() { return incoming_.front(loop_.now()); }
  [[nodiscard]] base::Task<std::optional<Received>> receive(base::Duration timeout);
  [[nodiscard]] bool is_connected() const { return channel_ != nullptr || plain_ != nullptr; }
  [[nodiscard]] std::uint64_t waiting(Kind kind) const { return outgoing_.waiting(kind); }
  [[nodiscard]] DurableQueue const& queue() const { return *queue_; }
  [[nodiscard]] std::string const& peer() const { return peer_; }
  [[nodiscard]] SessionCounters const& counters() const { return counters_; }
  [[nodiscard]] base::TimePoint last_connected() const { return last_connected_; }
  /// When anything came of the far end, pings included; in JSON mode, which has none, when it connected.
  [[nodiscard]] base::TimePoint last_heard() const { return last_heard_; }
  [[nodiscard]] base::Notifier& changed() { return changed_; }

  // What servers and clients do with it.

  /// All but this side's name and token.
  [[nodiscard]] Hello hello() const;
  /// The program at the far end that the connection of the moment is with.
  [[nodiscard]] std::uint64_t peer_instance() const { return peer_instance_; }
  /// Goes on over this connection, on which hello and welcome have been said; ends the one before. A server says its
  /// `welcome` in between: it tells how far the streams of this hello were heard.
  void attach(std::unique_ptr<Channel> channel, Hello const& peer,
              std::function<void(Hello const& own)> const& welcome = {});
  /// Goes on over a connection that carries JSON objects alone.
  void attach_plain(std::unique_ptr<ByteStream> stream);
  /// Says good-bye and ends the connection, if there is one.
  void detach(std::string const& why);

 private:
  void hear(Speech speech);
  void hear_data(Data data);
  void hear_plain(Bytes bytes);
  void lose(std::string const& why);
  void bury_connection();
  void told(MessageId id, Outcome outcome);
  void pump_soon();
  void pump();
  void pump_plain();
  void plain_drained();
  base::Task<> keep_alive();
  base::Task<> expire_in_time();
  void tell(EventKind kind, std::string text);
  void room_again();
  [[nodiscard]] base::Result<std::optional<Data>> next();

  base::Loop& loop_;
  std::string peer_;
  std::uint64_t instance_;
  SessionOptions options_;
  Events events_;
  std::unique_ptr<DurableQueue> queue_;
  Outgoing outgoing_;
  Incoming incoming_;
  SessionCounters counters_;
  std::uint64_t peer_instance_ = 0;
  std::uint64_t missing_told_ = 0;
  base::Duration peer_silence_{};
  base::TimePoint last_heard_{};
  base::TimePoint last_connected_{};
  std::unique_ptr<Channel> channel_;
  std::unique_ptr<ByteStream> plain_;
  std::vector<std::unique_ptr<Channel>> buried_channels_;
  std::vector<std::unique_ptr<ByteStream>> buried_streams_;
  JsonObjects objects_;
  std::uint64_t plain_number_ = 0;
  bool is_pumping_ = false;
  bool is_crowded_ = false;
  bool is_expiring_ = false;
  std::map<MessageId, std::optional<Outcome>> watched_;
  base::Notifier changed_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope expiring_;
  base::Scope connection_;  // last: what runs while there is a connection
};

}  // namespace lapwing::link::operator_link
