#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/internal/retransmit_timer.hpp"
#include "mavlink/exchange/mission_transfer.hpp"

/// What uploads and downloads share.
namespace lapwing::mavlink::internal {

using base::TimePoint;
using namespace std::chrono_literals;

/// Silence for so long means more than a lost heartbeat or two: they come every second.
inline constexpr base::Duration beats_missed = 3s;

/// What a transfer is about, for its messages and its texts.
struct TransferTarget {
  Connection& connection;
  Address target;
  MissionType type;

  [[nodiscard]] TimePoint now() const { return connection.loop().now(); }
  [[nodiscard]] base::Result<> send(Message message) const { return connection.send(target, std::move(message)); }
  [[nodiscard]] std::string_view plural() const {
    if (type == MissionType::fence) return "fence items";
    return type == MissionType::rally ? "rally points" : "mission items";
  }
};

/// Messages of this kind of transfer that are meant for this station.
template <class... Ms>
Inbox::Wanted meant_for(TransferTarget const& transfer) {
  return [self = transfer.connection.self(), type = transfer.type](Message const& message) {
    auto const concerns = [&](auto const* m) { return m && m->type == type && addresses(m->target, self); };
    return (concerns(std::get_if<Ms>(&message)) || ...);
  };
}

inline RetransmitTimer retransmit_timer(TransferTarget const& transfer, TransferOptions const& options) {
  return {options.reply_timeout, transfer.connection.round_trip(transfer.target.system)};
}

inline std::unexpected<base::Error> silent(TransferTarget const& transfer, std::string_view what) {
  return base::fail(base::ErrorKind::timed_out, fmt::format("vehicle {} fell silent during the {} of {}",
                                                            transfer.target.system, what, transfer.plural()));
}

/// Tells a vehicle that is heard and answers nothing at all from a link that loses questions or answers. Only the
/// second is worth all the patience of a transfer.
class Attention {
 public:
  explicit Attention(TransferTarget const& transfer) : target_(transfer), since_(transfer.now()) {}
  void asked() { ++questions_; }
  void answered() { is_given_ = true; }

  /// It was asked for as long as the protocol has one ask (five times, 1.5 s each, and a little), and a link that loses
  /// what this one is seen to lose would hardly have lost every question or its answer.
  [[nodiscard]] bool is_denied() const {
    auto const heard = target_.connection.last_heard(target_.target);
    auto const now = target_.now();
    if (is_given_ || now - since_ < long_enough || !heard || now - *heard >= beats_missed) return false;
    auto const counters = target_.connection.counters(target_.target);
    // As if one more had been lost: few messages prove little.
    auto const lost = static_cast<double>(counters.lost + 1);
    auto const arrives = 1.0 - lost / (lost + static_cast<double>(counters.received));
    return std::pow(1.0 - arrives * arrives, questions_) < too_unlikely;
  }
  [[nodiscard]] std::unexpected<base::Error> denial() const {
    return base::fail(
        base::ErrorKind::timed_out,
        fmt::format("vehicle {} is heard, but answers nothing about its {}: asked {} times in {:.0f} s",
                    target_.target.system, target_.plural(), questions_, base::to_seconds(target_.now() - since_)),
        "does the link carry both ways? does the vehicle want signed MAVLink (--signing-key)?");
  }

 private:
  static constexpr base::Duration long_enough = 10s;
  static constexpr double too_unlikely = 1e-6;
  TransferTarget target_;
  TimePoint since_;
  int questions_ = 0;
  bool is_given_ = false;
};

/// Tells a link that is lost from a vehicle that does not answer, and waits until it is back: altogether, over a whole
/// transfer, no longer than TransferOptions::outage_limit.
class Outage {
 public:
  Outage(Connection& connection, std::uint8_t system_id, TransferOptions const& options)
      : loop_(connection.loop()),
        heard_(loop_.now()),
        left_(options.outage_limit),
        heard_something_(loop_),
        subscription_(connection.subscribe(system_id, [this](Received const&) {
          heard_ = loop_.now();
          heard_something_.notify_all();
        })) {}
  Outage(Outage const&) = delete;
  Outage& operator=(Outage const&) = delete;

  /// True when the link was lost and is back. False: it never was, or is not back in time. A link may be known to be
  /// down; else several heartbeats have to be missing.
  base::Task<bool> is_over(bool is_down) {
    auto const lost_at = heard_;
    if (!is_down && loop_.now() - lost_at < beats_missed) co_return false;
    while (heard_ == lost_at && loop_.now() < lost_at + left_) co_await heard_something_.wait_until(lost_at + left_);
    left_ -= std::min<base::Duration>(left_, loop_.now() - lost_at);
    co_return heard_ != lost_at;
  }

 private:
  base::Loop& loop_;
  TimePoint heard_;
  base::Duration left_;
  base::Notifier heard_something_;
  Subscription subscription_;
};

}  // namespace lapwing::mavlink::internal
