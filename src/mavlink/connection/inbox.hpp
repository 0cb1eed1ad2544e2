#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <variant>

#include "base/async/notifier.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink {

/// Collects the messages of one component (0: of all of its system) that an exchange waits for, from its construction
/// on: make it before sending, and no reply is lost in between. What was asked of an autopilot, its camera does not
/// answer.
class Inbox {
 public:
  using Wanted = std::function<bool(Message const&)>;

  Inbox(Connection& connection, Address from, Wanted wanted)
      : loop_(connection.loop()),
        arrived_(loop_),
        subscription_(
            connection.subscribe(from.system, [this, from, wanted = std::move(wanted)](Received const& received) {
              if (from.component != 0 && received.source.component != from.component) return;
              if (!wanted(received.message)) return;
              waiting_.push_back(received.message);
              arrived_.notify_all();
            })) {}
  Inbox(Inbox const&) = delete;
  Inbox& operator=(Inbox const&) = delete;

  /// The oldest message not yet taken; nothing when `deadline` came first.
  base::Task<std::optional<Message>> next(base::TimePoint deadline) {
    while (waiting_.empty()) {
      if (loop_.now() >= deadline) co_return std::nullopt;
      co_await arrived_.wait_until(deadline);
    }
    std::optional<Message> message(std::move(waiting_.front()));
    waiting_.pop_front();
    co_return message;
  }
  void clear() { waiting_.clear(); }

 private:
  base::Loop& loop_;
  base::Notifier arrived_;
  std::deque<Message> waiting_;
  Subscription subscription_;
};

/// An Inbox::Wanted for messages of type M that fulfil `condition`.
template <class M>
[[nodiscard]] Inbox::Wanted wanting(std::function<bool(M const&)> condition) {
  return [condition = std::move(condition)](Message const& message) {
    auto const* m = std::get_if<M>(&message);
    return m != nullptr && condition(*m);
  };
}

/// The next message of type M from there that fulfils `condition`. Error: timed_out. For telemetry; where a
/// request comes first, make an Inbox before sending it.
template <class M>
base::Task<base::Result<M>> await_message(Connection& connection, Address from, std::function<bool(M const&)> condition,
                                          base::Duration timeout) {
  Inbox inbox(connection, from, wanting<M>(std::move(condition)));
  auto const got = co_await inbox.next(connection.loop().now() + timeout);
  if (!got) co_return base::fail(base::ErrorKind::timed_out, "the vehicle did not send what was waited for");
  co_return std::get<M>(*got);
}

}  // namespace lapwing::mavlink
