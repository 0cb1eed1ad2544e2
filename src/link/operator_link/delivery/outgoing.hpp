#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>

#include "link/operator_link/journal/durable_queue.hpp"
#include "link/operator_link/message.hpp"
#include "link/operator_link/wire/protocol.hpp"

namespace lapwing::link::operator_link {

/// What is said to one far end and has not been taken there: which message goes next, what is said again after an
/// outage, and what became of each. Knows no socket and no clock but the times it is given.
///
/// Durable messages have their numbers from the queue that keeps them. The others get theirs when they are sent, so
/// that what was overtaken before leaves no gap; on reconnecting, what the far end has not heard gets a new one.
class Outgoing {
 public:
  struct Limits {
    std::size_t live_messages = 256;                        ///< of commands, and of latest ones
    std::size_t live_bytes = std::size_t{2} * 1024 * 1024;  ///< of each, too
  };
  using Tell = std::function<void(MessageId, Outcome)>;

  /// `instance` names the stream of what is not durable. The queue outlives this.
  Outgoing(std::uint64_t instance, DurableQueue& durable, Limits limits, Tell tell)
      : instance_(instance), durable_(durable), limits_(limits), tell_(std::move(tell)) {}

  /// Error: invalid_input (too long), refused (no room: say less, or wait for some), io (the disk).
  [[nodiscard]] base::Result<MessageId> offer(Message message, base::TimePoint now);

  /// This side's streams, for a hello.
  void describe(std::array<LaneState, kinds>& lanes) const;
  /// A connection has come about; numbers go on where the far end says that it heard last.
  void connected(Hello const& peer, base::TimePoint now);

  /// The next message to send, if the far end has room for one. Error (io): the disk does not give it back.
  [[nodiscard]] base::Result<std::optional<Data>> next(base::TimePoint now);
  /// Error (invalid_input): the far end has taken what was never sent.
  [[nodiscard]] base::Result<> acknowledged(Ack ack);
  void returned(Returned returned);
  /// The last number of each lane that was sent: what an ack for everything would have.
  [[nodiscard]] std::uint64_t last_sent(Kind kind) const;

  /// Forgets what is worth nothing any more.
  void expire(base::TimePoint now);
  /// Of what waits; `TimePoint::max()` when nothing does.
  [[nodiscard]] base::TimePoint next_expiry() const;

  /// Whether `next` may have something, if the far end has room.
  [[nodiscard]] bool has_waiting() const;
  /// Messages that have not been taken.
  [[nodiscard]] std::uint64_t waiting(Kind kind) const;

 private:
  struct Live {
    std::uint64_t ticket = 0;
    std::uint64_t number = 0;  ///< once it is under way
    std::string key;
    std::string text;
    base::TimePoint expires = base::TimePoint::max();
    [[nodiscard]] std::size_t size() const { return key.size() + text.size(); }
  };
  struct LiveLane {
    std::deque<Live> waiting;
    std::deque<Live> under_way;
    std::uint64_t next_number = 1;
    std::size_t bytes = 0;  ///< of both
    std::size_t bytes_under_way = 0;
  };
  struct Sent {
    std::uint64_t number = 0;
    std::size_t size = 0;
  };

  [[nodiscard]] LiveLane& lane(Kind kind) { return kind == Kind::command ? commands_ : latest_; }
  [[nodiscard]] LiveLane const& lane(Kind kind) const { return kind == Kind::command ? commands_ : latest_; }
  base::Result<MessageId> offer_live(Message message, base::TimePoint now);
  bool overtake(Kind kind, std::string_view key);
  void drop_expired(Kind kind, base::TimePoint now);
  void resume_live(Kind kind, std::uint64_t heard, bool is_another, base::TimePoint now);
  void resume_durable(std::uint64_t heard);
  std::optional<Data> next_live(Kind kind, base::TimePoint now);
  base::Result<std::optional<Data>> next_durable();

  std::uint64_t instance_;
  DurableQueue& durable_;
  Limits limits_;
  Tell tell_;
  std::uint64_t next_ticket_ = 1;
  LiveLane commands_;
  LiveLane latest_;

  std::deque<Sent> durable_under_way_;
  std::size_t durable_bytes_under_way_ = 0;
  std::uint64_t durable_next_ = 1;                   ///< to be sent
  std::uint64_t durable_held_until_ = 0;             ///< nothing is sent before this number has been taken
  std::optional<DurableQueue::Entry> durable_read_;  ///< read, and found no room at the far end

  Window window_;
  std::uint64_t peer_instance_ = 0;
};

}  // namespace lapwing::link::operator_link
