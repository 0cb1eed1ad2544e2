#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "link/operator_link/journal/durable_queue.hpp"
#include "link/operator_link/message.hpp"
#include "link/operator_link/wire/protocol.hpp"

namespace lapwing::link::operator_link {

/// What came from one far end and has not been taken by this program: each message once, commands before all others,
/// the newest of a key in the place of older ones, nothing after its expiry. Knows no socket and no clock but the times
/// it is given.
///
/// Memory is bounded by the window: the far end sends no more before something was taken, or is cut off.
class Incoming {
 public:
  /// The queue, which outlives this, keeps what has been taken of durable messages.
  Incoming(Window window, DurableQueue& durable);

  /// How far the far end's streams were heard, for a hello.
  void describe(std::array<LaneState, kinds>& lanes) const;
  void connected(Hello const& peer);
  /// Something with a time stamp came: tells what takes longer than the fastest did.
  void heard(std::chrono::microseconds sent, base::TimePoint now);
  /// Error (invalid_input): more than there is room for.
  [[nodiscard]] base::Result<> arrived(Data data, base::TimePoint now);
  /// From an old part, which numbers nothing and is told nothing: who reads its connection looks at `size()`.
  void arrived_plain(Data data);
  /// The one that `take` would give; valid until the next call of anything.
  [[nodiscard]] Received const* front(base::TimePoint now);
  /// The next one for the program; it counts as taken.
  [[nodiscard]] std::optional<Received> take(base::TimePoint now);

  /// What the far end is to be told.
  [[nodiscard]] std::vector<Speech> reports();
  /// Everything again, on a new connection.
  void report_all();

  [[nodiscard]] std::size_t size() const { return commands_.size() + others_.size(); }
  /// Numbers of durable messages that never came, because a disk at the far end lost them.
  [[nodiscard]] std::uint64_t missing() const { return missing_; }

 private:
  struct Item {
    Received message;
    base::TimePoint expires = base::TimePoint::max();
    [[nodiscard]] std::size_t size() const { return message.key.size() + message.text.size(); }
  };
  struct Lane {
    std::uint64_t stream = 0;
    std::uint64_t heard = 0;
    std::uint64_t taken = 0;
    bool is_to_report = false;
    std::size_t messages = 0;
    std::size_t bytes = 0;
  };

  [[nodiscard]] Lane& lane(Kind kind) { return lanes_[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] std::deque<Item>& queue(Kind kind) { return kind == Kind::command ? commands_ : others_; }
  [[nodiscard]] std::deque<Item>* next_queue();
  void overtake(Kind kind, std::string_view key);
  void give_back(Item const& item, Outcome why);
  void forget(Item const& item);
  void note_taken(Received const& message);

  Window window_;
  DurableQueue& durable_;
  std::array<Lane, kinds> lanes_{};
  std::deque<Item> commands_;
  std::deque<Item> others_;
  std::deque<Returned> returned_;  ///< the latest, for a report may be lost with its connection
  std::size_t returned_to_report_ = 0;
  std::optional<std::chrono::microseconds> fastest_;
  std::uint64_t missing_ = 0;
};

}  // namespace lapwing::link::operator_link
