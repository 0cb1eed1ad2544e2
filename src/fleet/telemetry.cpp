#include "fleet/telemetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geo/position.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::TimePoint;
using vehicle::VehicleState;

namespace {

constexpr std::size_t texts_kept = 50;
constexpr double smallest_step_m = 0.5;      // below it a standing vehicle's GPS noise would count as travel
constexpr double fastest_vehicle_m_s = 100;  // a step beyond it is a jump of the estimator
constexpr double jump_allowance_m = 20.0;

void extend_track(Craft& craft, VehicleState& state, geo::Wgs84 place, TimePoint now) {
  if (craft.track_end) {
    double const step_m = geo::surface_distance_m(*craft.track_end, place);
    if (step_m < smallest_step_m) return;
    double const farthest_m = jump_allowance_m + fastest_vehicle_m_s * base::to_seconds(now - craft.track_end_heard);
    if (step_m <= farthest_m) state.track_m += step_m;
  }
  craft.track_end = place;
  craft.track_end_heard = now;
}

/// The same with height differences, to compare with estimates.
void extend_path(Craft& craft, geo::Wgs84 place) {
  double const step_m = craft.path_end ? geo::distance_m(*craft.path_end, place) : 0.0;
  if (craft.path_end && step_m < smallest_step_m) return;
  if (step_m <= jump_allowance_m + fastest_vehicle_m_s) craft.path_m += step_m;
  craft.path_end = place;
}

bool has_fix(Craft const& craft) {
  return !craft.fix || *craft.fix >= mavlink::GpsFix::fix_3d;
}

bool position_is_estimated(VehicleState const& state) {
  return state.health.value.value_or(vehicle::Health{}).position_ok;
}

void set_estimator(VehicleState& state, std::uint16_t flags, TimePoint now) {
  auto health = state.health.value.value_or(vehicle::Health{});
  health.position_ok = (flags & mavlink::ekf_flag::position_horizontal_absolute) != 0 &&
                       (flags & mavlink::ekf_flag::constant_position_mode) == 0;
  state.health.set(health, now);
}

/// One overload for each message that shows; everything else falls through to the template.
struct Taking {
  Craft& craft;
  VehicleState& state;
  TimePoint now;

  template <class Other>
  bool operator()(Other const&) const {
    return false;
  }

  bool operator()(mavlink::GlobalPosition const& heard) const {
    if ((heard.position.lat_rad == 0.0 && heard.position.lon_rad == 0.0) || !has_fix(craft)) return false;
    state.position.set(heard.position, now);
    state.relative_alt_m.set(heard.relative_alt_m, now);
    state.velocity_m_s.set(heard.velocity_m_s, now);
    if (heard.heading_rad && position_is_estimated(state)) state.heading_rad.set(*heard.heading_rad, now);
    extend_track(craft, state, heard.position, now);
    extend_path(craft, heard.position);
    return true;
  }

  bool operator()(mavlink::Attitude const& heard) const {
    state.attitude.set({heard.roll_rad, heard.pitch_rad, heard.yaw_rad}, now);
    return true;
  }

  bool operator()(mavlink::GpsRaw const& heard) const {
    craft.fix = heard.fix;
    return false;
  }

  bool operator()(mavlink::SysStatus const& heard) const {
    craft.has_reported_battery = true;
    if (heard.battery_remaining)
      state.battery.set({*heard.battery_remaining, heard.battery_voltage_v, heard.battery_current_a}, now);
    auto health = state.health.value.value_or(vehicle::Health{});
    health.prearm_ok = (heard.sensors_health & mavlink::sensor_flag::prearm_check) != 0;
    state.health.set(health, now);
    return true;
  }

  bool operator()(mavlink::BatteryStatus const& heard) const {
    if (heard.id != 0 || !heard.remaining) return false;
    craft.has_reported_battery = true;
    state.battery.set({*heard.remaining, heard.voltage_v, heard.current_a}, now);
    return true;
  }

  bool operator()(mavlink::EkfStatusReport const& heard) const {
    set_estimator(state, heard.flags, now);
    return true;
  }

  bool operator()(mavlink::EstimatorStatus const& heard) const {
    set_estimator(state, heard.flags, now);
    return true;
  }

  bool operator()(mavlink::HomePosition const& heard) const {
    state.home.set(heard.position, now);
    return true;
  }

  bool operator()(mavlink::ExtendedSysState const& heard) const {
    if (heard.landed_state == mavlink::MavLandedState::undefined) return false;
    bool const landed = heard.landed_state == mavlink::MavLandedState::on_ground;
    state.landed.set(landed, now);
    auto& trace = craft.trace;
    if (!landed) trace.on_ground_since.reset();
    if (landed && !trace.on_ground_since) trace.on_ground_since = now;
    trace.on_ground_heard = now;
    return true;
  }

  bool operator()(mavlink::MissionCurrent const& heard) const {
    auto& trace = craft.trace;
    trace.current_seq = std::max<int>(trace.current_seq.value_or(0), heard.seq);
    trace.reports_complete = heard.state == mavlink::MissionState::complete;
    if (!trace.reports_complete) trace.was_active = true;
    int const known_total = state.mission.value ? state.mission.value->total : 0;
    state.mission.set({heard.seq, heard.total ? static_cast<int>(*heard.total) : known_total, trace.reports_complete},
                      now);
    return true;
  }

  bool operator()(mavlink::MissionItemReached const& heard) const {
    craft.trace.reached_seq = std::max<int>(craft.trace.reached_seq.value_or(0), heard.seq);
    return false;
  }
};

struct Numbering {
  using Id = mavlink::MessageId;
  template <class Other>
  std::optional<Id> operator()(Other const&) const {
    return std::nullopt;
  }
  std::optional<Id> operator()(mavlink::GlobalPosition const&) const { return Id::global_position_int; }
  std::optional<Id> operator()(mavlink::Attitude const&) const { return Id::attitude; }
  std::optional<Id> operator()(mavlink::SysStatus const&) const { return Id::sys_status; }
  std::optional<Id> operator()(mavlink::GpsRaw const&) const { return Id::gps_raw_int; }
  std::optional<Id> operator()(mavlink::MissionCurrent const&) const { return Id::mission_current; }
  std::optional<Id> operator()(mavlink::ExtendedSysState const&) const { return Id::extended_sys_state; }
  std::optional<Id> operator()(mavlink::HomePosition const&) const { return Id::home_position; }
  std::optional<Id> operator()(mavlink::EkfStatusReport const&) const { return Id::ekf_status_report; }
  std::optional<Id> operator()(mavlink::EstimatorStatus const&) const { return Id::estimator_status; }
};

WantedMessage wanted(mavlink::MessageId id, base::Duration interval) {
  return {id, interval};
}

}  // namespace

bool take_telemetry(Craft& craft, mavlink::Message const& message, TimePoint now) {
  return std::visit(Taking{craft, craft.state, now}, message);
}

std::vector<vehicle::StatusText> take_text(Craft& craft, mavlink::StatusText const& chunk, TimePoint now) {
  auto texts = craft.texts.overdue(now);
  auto whole = craft.texts.add({static_cast<int>(chunk.severity), chunk.text, chunk.id, chunk.chunk_seq}, now);
  texts.insert(texts.end(), std::make_move_iterator(whole.begin()), std::make_move_iterator(whole.end()));
  auto& kept = craft.state.recent_texts;
  kept.insert(kept.end(), texts.begin(), texts.end());
  if (kept.size() > texts_kept) kept.erase(kept.begin(), kept.end() - texts_kept);
  return texts;
}

std::optional<base::Duration> boot_time(mavlink::Message const& message) {
  if (auto const* position = std::get_if<mavlink::GlobalPosition>(&message)) return position->since_boot;
  if (auto const* attitude = std::get_if<mavlink::Attitude>(&message)) return attitude->since_boot;
  if (auto const* time = std::get_if<mavlink::SystemTime>(&message)) return time->since_boot;
  return std::nullopt;
}

std::optional<mavlink::MessageId> id_of(mavlink::Message const& message) {
  return std::visit(Numbering{}, message);
}

std::span<WantedMessage const> wanted_messages(vehicle::Autopilot autopilot) {
  using mavlink::MessageId;
  static std::array const common{
      wanted(MessageId::global_position_int, 200ms),
      wanted(MessageId::attitude, 250ms),
      wanted(MessageId::sys_status, 1s),
      wanted(MessageId::gps_raw_int, 1s),
      wanted(MessageId::mission_current, 1s),
      wanted(MessageId::extended_sys_state, 1s),
      wanted(MessageId::home_position, 10s),
      wanted(MessageId::ekf_status_report, 1s),
  };
  static std::array const px4 = [] {
    auto changed = common;
    changed.back() = wanted(MessageId::estimator_status, 1s);
    return changed;
  }();
  return autopilot == vehicle::Autopilot::px4 ? std::span<WantedMessage const>(px4)
                                              : std::span<WantedMessage const>(common);
}

}  // namespace lapwing::fleet
