#include "sim/mavlink/telemetry.hpp"

#include <algorithm>
#include <array>

namespace lapwing::sim {

using namespace std::chrono_literals;
using mavlink::MessageId;

namespace {

constexpr base::Duration heartbeat_interval = 1s;
constexpr base::Duration shortest_interval = 3ms;
constexpr MessageId position_target{87};

enum class Sender { both, ardupilot, px4 };
struct Row {
  MessageId id;
  int stream;           ///< MAV_DATA_STREAM, ArduPilot's; 0: in none
  double px4_hz = 0.0;  ///< what PX4 sends unasked (its "normal" mode); 0: nothing
  Sender sender = Sender::both;
};
constexpr std::array rows{
    Row{MessageId::heartbeat, 0, 1.0},
    Row{MessageId::sys_status, 2, 1.0},
    Row{MessageId::mission_current, 2, 1.0},
    Row{MessageId::gps_raw_int, 2, 1.0},
    Row{MessageId::nav_controller_output, 2},
    Row{MessageId::fence_status, 2, 0.0, Sender::ardupilot},
    Row{position_target, 2, 1.5},
    Row{MessageId::global_position_int, 6, 5.0},
    Row{MessageId::local_position_ned, 6, 1.0},
    Row{MessageId::attitude, 10, 15.0},
    Row{MessageId::vfr_hud, 11, 4.0},
    Row{MessageId::system_time, 12, 1.0},
    Row{MessageId::wind, 12, 0.0, Sender::ardupilot},
    Row{MessageId::battery_status, 12, 0.5},
    Row{MessageId::ekf_status_report, 12, 0.0, Sender::ardupilot},
    Row{MessageId::rc_channels, 3, 1.0},
    Row{MessageId::gimbal_device_attitude_status, 12, 5.0},
    Row{MessageId{27}, 1, 0.0, Sender::ardupilot},      // RAW_IMU
    Row{MessageId{116}, 1, 0.0, Sender::ardupilot},     // SCALED_IMU2
    Row{MessageId{29}, 1, 0.0, Sender::ardupilot},      // SCALED_PRESSURE
    Row{MessageId{137}, 1, 0.0, Sender::ardupilot},     // SCALED_PRESSURE2
    Row{MessageId{125}, 2, 0.0, Sender::ardupilot},     // POWER_STATUS
    Row{MessageId{152}, 2, 0.0, Sender::ardupilot},     // MEMINFO
    Row{MessageId{36}, 3, 0.0, Sender::ardupilot},      // SERVO_OUTPUT_RAW
    Row{MessageId{164}, 10, 0.0, Sender::ardupilot},    // SIMSTATE
    Row{MessageId{178}, 10, 0.0, Sender::ardupilot},    // AHRS2
    Row{MessageId{163}, 12, 0.0, Sender::ardupilot},    // AHRS
    Row{MessageId{241}, 12, 0.0, Sender::ardupilot},    // VIBRATION
    Row{MessageId{11030}, 12, 0.0, Sender::ardupilot},  // ESC_TELEMETRY_1_TO_4
    Row{MessageId::estimator_status, 0, 0.5, Sender::px4},
    Row{MessageId::extended_sys_state, 0, 1.0},
    Row{MessageId::home_position, 0, 0.5},
    Row{MessageId::gps_global_origin, 0, 0.1},
};

bool sends(Kind const& kind, Row const& row) {
  return row.sender == Sender::both || (row.sender == Sender::px4) == kind.is_px4();
}

/// What the vehicle sends when nobody asks for anything.
std::optional<base::Duration> unasked(Kind const& kind, MessageId id) {
  if (id == MessageId::heartbeat) return heartbeat_interval;
  auto const row = std::ranges::find(rows, id, &Row::id);
  if (!kind.is_px4() || row == rows.end() || row->px4_hz <= 0.0) return std::nullopt;
  return base::from_seconds(1.0 / row->px4_hz);
}

}  // namespace

Telemetry::Telemetry(Kind const& kind, base::Duration first_heartbeat) : kind_(kind) {
  for (auto const& row : rows) {
    if (auto const interval = unasked(kind_, row.id)) entries_.push_back({row.id, *interval, first_heartbeat});
  }
  find_next();
}

bool Telemetry::knows(MessageId id) const {
  auto const row = std::ranges::find(rows, id, &Row::id);
  return row != rows.end() && sends(kind_, *row);
}

Telemetry::Answer Telemetry::set_interval(MessageId id, std::chrono::microseconds interval, base::Duration now) {
  if (!knows(id)) return Answer::unknown_message;
  if (interval.count() < 0) {
    schedule(id, std::nullopt, now);
  } else if (interval.count() == 0) {
    schedule(id, unasked(kind_, id), now);
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
