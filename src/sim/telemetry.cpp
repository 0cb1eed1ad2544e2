#include "sim/telemetry.hpp"

#include <algorithm>
#include <array>

namespace lapwing::sim {

using namespace std::chrono_literals;
using mavlink::MessageId;

namespace {

constexpr base::Duration heartbeat_interval = 1s;
constexpr base::Duration shortest_interval = 3ms;
constexpr MessageId position_target{87};

struct Row {
  MessageId id;
  int stream;  ///< MAV_DATA_STREAM; 0: in none
};
constexpr std::array rows{
    Row{MessageId::heartbeat, 0},
    Row{MessageId::sys_status, 2},
    Row{MessageId::mission_current, 2},
    Row{MessageId::gps_raw_int, 2},
    Row{MessageId::nav_controller_output, 2},
    Row{MessageId::fence_status, 2},
    Row{position_target, 2},
    Row{MessageId::global_position_int, 6},
    Row{MessageId::local_position_ned, 6},
    Row{MessageId::attitude, 10},
    Row{MessageId::vfr_hud, 11},
    Row{MessageId::system_time, 12},
    Row{MessageId::wind, 12},
    Row{MessageId::battery_status, 12},
    Row{MessageId::ekf_status_report, 12},
    Row{MessageId::extended_sys_state, 0},
    Row{MessageId::home_position, 0},
    Row{MessageId::gps_global_origin, 0},
};

}  // namespace

Telemetry::Telemetry(base::Duration first_heartbeat) {
  entries_.push_back({MessageId::heartbeat, heartbeat_interval, first_heartbeat});
  find_next();
}

bool Telemetry::knows(MessageId id) {
  return std::ranges::find(rows, id, &Row::id) != rows.end();
}

Telemetry::Answer Telemetry::set_interval(MessageId id, std::chrono::microseconds interval, base::Duration now) {
  if (!knows(id)) return Answer::unknown_message;
  if (interval.count() < 0) {
    schedule(id, std::nullopt, now);
  } else if (interval.count() == 0) {
    schedule(id, id == MessageId::heartbeat ? std::optional(heartbeat_interval) : std::nullopt, now);
  } else {
    schedule(id, std::max<base::Duration>(interval, shortest_interval), now);
  }
  return Answer::accepted;
}

std::optional<base::Duration> Telemetry::interval(MessageId id) const {
  auto const found = std::ranges::find(entries_, id, &Entry::id);
  return found == entries_.end() ? std::nullopt : std::optional(found->interval);
}

void Telemetry::set_stream(int stream, int rate_hz, base::Duration now) {
  for (auto const& row : rows) {
    if (row.stream == 0 || (stream != 0 && row.stream != stream)) continue;
    std::optional<base::Duration> interval;
    if (rate_hz > 0) interval = std::max(base::Duration(1s) / rate_hz, shortest_interval);
    schedule(row.id, interval, now);
  }
}

void Telemetry::schedule(MessageId id, std::optional<base::Duration> interval, base::Duration now) {
  auto const found = std::ranges::find(entries_, id, &Entry::id);
  if (!interval) {
    if (found != entries_.end()) entries_.erase(found);
  } else if (found == entries_.end()) {
    entries_.push_back({id, *interval, now + *interval});
  } else if (found->interval != *interval) {
    *found = {id, *interval, now + *interval};
  }
  find_next();
}

std::vector<MessageId> Telemetry::take_due(base::Duration now) {
  std::vector<MessageId> due;
  if (now < next_due_) return due;
  for (auto& entry : entries_) {
    if (entry.due > now) continue;
    due.push_back(entry.id);
    entry.due = std::max(entry.due + entry.interval, now - entry.interval);
  }
  find_next();
  return due;
}

base::Duration Telemetry::next_due_between(base::Duration step) const {
  auto next = base::Duration::max();
  for (auto const& entry : entries_) {
    if (entry.interval < step) next = std::min(next, entry.due);
  }
  return next;
}

void Telemetry::find_next() {
  next_due_ = base::Duration::max();
  for (auto const& entry : entries_) next_due_ = std::min(next_due_, entry.due);
}

}  // namespace lapwing::sim
