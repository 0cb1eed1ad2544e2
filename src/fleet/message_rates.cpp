#include "fleet/message_rates.hpp"

#include <algorithm>

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration shortest_look = 2s;
constexpr base::Duration longest_pause = 60s;
constexpr base::Duration pause_after_no = 5min;
constexpr int intervals_in_a_look = 3;
// Links lose messages and autopilots round intervals: half of what was asked is not worth asking again.
constexpr double enough = 0.5;

base::Duration look_time(base::Duration interval) {
  return std::max(shortest_look, interval * intervals_in_a_look);
}

}  // namespace

MessageRates::MessageRates(std::span<WantedMessage const> wanted, base::TimePoint now) {
  for (auto const& message : wanted) watched_.push_back(Watched{message});
  restart(now);
}

void MessageRates::want(WantedMessage const& message, base::TimePoint now) {
  auto const is_it = [&](Watched const& watched) { return watched.wanted.id == message.id; };
  if (std::ranges::any_of(watched_, is_it)) return;
  look(watched_.emplace_back(Watched{message}), now, shortest_look);
}

void MessageRates::look(Watched& watched, base::TimePoint now, base::Duration time) const {
  watched.count = 0;
  watched.since = now;
  watched.look_until = now + time;
}

void MessageRates::restart(base::TimePoint now) {
  for (auto& watched : watched_) {
    watched.asked = 0;
    look(watched, now, shortest_look);
  }
}

void MessageRates::arrived(mavlink::MessageId id) {
  for (auto& watched : watched_)
    if (watched.wanted.id == id) ++watched.count;
}

std::vector<WantedMessage> MessageRates::due(base::TimePoint now) {
  std::vector<WantedMessage> asks;
  for (auto& watched : watched_) {
    if (now < watched.look_until) continue;
    double const expected = base::to_seconds(now - watched.since) / base::to_seconds(watched.wanted.interval);
    auto time = look_time(watched.wanted.interval);
    if (watched.count >= enough * expected) {
      watched.asked = 0;
    } else {
      asks.push_back(watched.wanted);
      time = std::min(longest_pause, time * (1 << std::min(watched.asked++, 5)));
    }
    look(watched, now, time);
  }
  return asks;
}

void MessageRates::denied(mavlink::MessageId id, base::TimePoint now) {
  for (auto& watched : watched_)
    if (watched.wanted.id == id) look(watched, now, pause_after_no);
}

}  // namespace lapwing::fleet
