#pragma once

#include <cstddef>
#include <deque>
#include <expected>
#include <utility>

#include "base/async/notifier.hpp"

namespace lapwing::base {

enum class ReceiveError { timed_out, closed };

/// A bounded queue between two components on one loop.
template <class T>
class Mailbox {
 public:
  Mailbox(Loop& loop, std::size_t capacity) : loop_(loop), arrived_(loop), capacity_(capacity) {}

  /// False when full or closed: the caller decides what to drop.
  [[nodiscard]] bool post(T message) {
    if (closed_ || queue_.size() == capacity_) return false;
    queue_.push_back(std::move(message));
    arrived_.notify_all();
    return true;
  }
  /// Makes room for the newest by dropping the oldest; returns how many were dropped (0 or 1).
  std::size_t post_dropping_oldest(T message) {
    std::size_t const dropped = queue_.size() == capacity_ ? 1 : 0;
    if (dropped) queue_.pop_front();
    (void)post(std::move(message));
    return dropped;
  }
  void close() {
    closed_ = true;
    arrived_.notify_all();
  }
  [[nodiscard]] std::size_t size() const { return queue_.size(); }

  /// The oldest message. What was posted before `close()` is still delivered.
  Task<std::expected<T, ReceiveError>> receive(Duration timeout) {
    auto const deadline = loop_.now() + timeout;
    while (queue_.empty()) {
      if (closed_) co_return std::unexpected(ReceiveError::closed);
      if (loop_.now() >= deadline) co_return std::unexpected(ReceiveError::timed_out);
      co_await arrived_.wait_until(deadline);
    }
    auto message = std::move(queue_.front());
    queue_.pop_front();
    co_return message;
  }

 private:
  Loop& loop_;
  Notifier arrived_;
  std::deque<T> queue_;
  std::size_t capacity_;
  bool closed_ = false;
};

}  // namespace lapwing::base
