#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <expected>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/assert.hpp"
#include "base/async/mailbox.hpp"
#include "base/async/notifier.hpp"

namespace lapwing::base {

/// What becomes of a message that comes when an inbox is full. Nobody is made to wait: the threads that post belong to
/// libraries (a bus, a video pipeline), which lose more when their callbacks do not return.
enum class Overflow {
  drop_oldest,  ///< for what is only worth something when it is new: poses, pictures
  drop_newest,  ///< for what must stay whole from its beginning: what is refused, its sender learns
};

/// How a thread of a library gives values to the loop: a bounded queue that any thread may post to, read on the loop.
///
/// All but its `Post` is thread-bound. Without a pace time does not wait for what other threads might post, and a run
/// that depends on them does not repeat.
template <class T>
class Inbox {
  struct Queue;

 public:
  /// The other threads' end: copyable, and may outlive the inbox, which then takes nothing more. Thread-safe.
  class Post {
   public:
    /// False when the message was dropped: the inbox is full of older ones that stay, or closed.
    bool operator()(T message) const { return queue_->put(std::move(message)); }

   private:
    friend class Inbox;
    explicit Post(std::shared_ptr<Queue> queue) : queue_(std::move(queue)) {}
    std::shared_ptr<Queue> queue_;
  };

  Inbox(Loop& loop, std::size_t capacity, Overflow overflow)
      : loop_(loop), queue_(std::make_shared<Queue>(loop, capacity, overflow, arrived_)) {
    LAPWING_ASSERT(capacity > 0);
  }
  Inbox(Inbox const&) = delete;
  Inbox& operator=(Inbox const&) = delete;
  ~Inbox() { auto const undelivered = queue_->give_up(); }

  [[nodiscard]] Post post() const { return Post(queue_); }
  /// Nothing more is taken; what was posted before is still delivered. Returns when no post is under way any more.
  void close() {
    queue_->close();
    arrived_->notify_all();
  }
  [[nodiscard]] std::size_t size() const {
    std::lock_guard const lock(queue_->mutex);
    return queue_->messages.size();
  }
  /// How many were lost because the inbox was full, since it was made.
  [[nodiscard]] std::uint64_t dropped() const {
    std::lock_guard const lock(queue_->mutex);
    return queue_->lost;
  }

  /// The oldest message.
  Task<std::expected<T, ReceiveError>> receive(Duration timeout) {
    auto const deadline = loop_.now() + timeout;
    for (;;) {
      auto taken = queue_->take();
      if (taken || taken.error() == ReceiveError::closed) co_return taken;
      if (loop_.now() >= deadline) co_return taken;
      co_await arrived_->wait_until(deadline);
    }
  }

 private:
  Loop& loop_;
  std::shared_ptr<Notifier> arrived_ = std::make_shared<Notifier>(loop_);  // owned here alone: the loop may look later
  std::shared_ptr<Queue> queue_;
};

/// What the threads share. Open only while the inbox lives, which its loop outlives.
template <class T>
struct Inbox<T>::Queue : std::enable_shared_from_this<Queue> {
  Queue(Loop& wakes, std::size_t most, Overflow rule, std::weak_ptr<Notifier> tells)
      : loop(wakes), capacity(most), overflow(rule), arrived(std::move(tells)) {}

  bool put(T message) {
    std::optional<T> dropped;  // dies outside of the lock
    std::lock_guard const lock(mutex);
    if (is_closed) return false;
    if (messages.size() == capacity) {
      ++lost;
      if (overflow == Overflow::drop_newest) return false;
      dropped = std::move(messages.front());
      messages.pop_front();
    }
    messages.push_back(std::move(message));
    if (!std::exchange(is_waking, true))
      loop.post_from_other_thread([self = this->shared_from_this()] { self->wake(); });
    return true;
  }
  std::expected<T, ReceiveError> take() {
    std::lock_guard const lock(mutex);
    if (messages.empty()) return std::unexpected(is_closed ? ReceiveError::closed : ReceiveError::timed_out);
    auto message = std::move(messages.front());
    messages.pop_front();
    return message;
  }
  /// On the loop; one call for all that was posted before it.
  void wake() {
    {
      std::lock_guard const lock(mutex);
      is_waking = false;
    }
    if (auto const notifier = arrived.lock()) notifier->notify_all();
  }
  void close() {
    std::lock_guard const lock(mutex);
    is_closed = true;
  }

  std::deque<T> give_up() {
    std::lock_guard const lock(mutex);
    is_closed = true;
    return std::exchange(messages, {});
  }

  Loop& loop;
  std::size_t const capacity;
  Overflow const overflow;
  std::weak_ptr<Notifier> const arrived;
  mutable std::mutex mutex;
  std::deque<T> messages;
  std::uint64_t lost = 0;
  bool is_closed = false;
  bool is_waking = false;
};

}  // namespace lapwing::base
