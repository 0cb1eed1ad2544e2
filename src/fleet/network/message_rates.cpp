#include "fleet/network/message_rates.hpp"

#include <algorithm>

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration shortest_look = 2s;
constexpr base::Duration shortest_first_look = 1s;  // people wait to see the vehicle on the map
constexpr base::Duration longest_pause = 60s;
constexpr base::Duration pause_after_no = 5min;
constexpr int intervals_in_a_look = 3;
constexpr int patience =
    3;  // requests for what may wait; a vehicle may acknowledge what it never sends (wind of a rover)
// Links lose messages and autopilots round intervals: half of what was asked is not worth asking again.
constexpr double enough = 0.5;

base::Duration look_time(base::Duration interval) {
  return std::max(shortest_look, interval * intervals_in_a_look);
}

base::Duration first_look_time(base::Duration interval) {
  return std::clamp(interval * intervals_in_a_look, shortest_first_look, shortest_look);
}

}  // namespace

MessageRates::MessageRates(std::span<WantedMessage const> wanted, base::TimePoint now) {
  watched_.reserve(wanted.size());
  for (auto const& message : wanted) watched_.push_back({.wanted = message, .usual = message.interval});
  restart(now);
}

MessageRates::Watched* MessageRates::find(mavlink::MessageId id) {
  auto const found = std::ranges::find_if(watched_, [id](Watched const& watched) { return watched.wanted.id == id; });
  return found == watched_.end() ? nullptr : &*found;
}

void MessageRates::want(WantedMessage const& message, base::TimePoint now) {
  if (find(message.id)) return;
  auto& watched = watched_.emplace_back(Watched{.wanted = message, .usual = message.interval});
  if (message.may_wait) watched.wanted.interval *= telemetry_rate_;
  look(watched, now, first_look_time(watched.wanted.interval));
}

void MessageRates::look(Watched& watched, base::TimePoint now, base::Duration time) const {
  watched.count = 0;
  watched.since = now;
  watched.look_until = now + time;
}

void MessageRates::restart(base::TimePoint now) {
  for (auto& watched : watched_) {
    watched.asked = 0;
    watched.set.reset();
    watched.before.reset();
    look(watched, now, first_look_time(watched.wanted.interval));
  }
}

void MessageRates::arrived(mavlink::MessageId id) {
  if (auto* const watched = find(id)) ++watched->count;
}

std::vector<WantedMessage> MessageRates::due(base::TimePoint now) {
  std::vector<WantedMessage> asks;
  for (auto& watched : watched_) {
    if (now < watched.look_until) continue;
    double const expected = base::to_seconds(now - watched.since) / base::to_seconds(watched.wanted.interval);
    bool const is_other = watched.set && *watched.set != watched.wanted.interval;
    auto time = look_time(watched.wanted.interval);
    if (!is_other && watched.count >= enough * expected) {
      watched.asked = 0;
    } else {
      asks.push_back(watched.wanted);
      time = std::min(longest_pause, time * (1 << std::min(watched.asked++, 5)));
      if (watched.wanted.may_wait && watched.asked > patience) time = pause_after_no;
    }
    look(watched, now, time);
  }
  return asks;
}

void MessageRates::denied(mavlink::MessageId id, base::TimePoint now) {
  if (auto* const watched = find(id)) look(*watched, now, pause_after_no);
}

void MessageRates::leave_alone(mavlink::MessageId id, base::TimePoint now) {
  if (auto* const watched = find(id)) look(*watched, now, longest_pause);
}

void MessageRates::set_telemetry_rate(int factor, base::TimePoint now) {
  if (factor == telemetry_rate_) return;
  telemetry_rate_ = factor;
  for (auto& watched : watched_) {
    if (!watched.wanted.may_wait) continue;
    watched.wanted.interval = watched.usual * factor;
    if (watched.set) watched.look_until = now;
  }
}

void MessageRates::changed(WantedMessage const& message, std::optional<std::optional<base::Duration>> before) {
  auto* const watched = find(message.id);
  if (!watched) return;
  if (!watched->set) watched->before = before;
  watched->set = message.interval;
}

bool MessageRates::is_ours(mavlink::MessageId id) const {
  return std::ranges::any_of(watched_, [id](Watched const& watched) { return watched.wanted.id == id && watched.set; });
}

std::vector<ChangedRate> MessageRates::changes() const {
  std::vector<ChangedRate> all;
  for (auto const& watched : watched_)
    if (watched.set && watched.before) all.push_back({watched.wanted.id, *watched.set, *watched.before});
  return all;
}

}  // namespace lapwing::fleet
