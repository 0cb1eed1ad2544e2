#include "fleet/state/telemetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fleet/state/arming_reasons.hpp"
#include "geo/position.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::TimePoint;
using mavlink::sensor_flag::prearm_check;
using vehicle::VehicleState;

namespace {

constexpr std::size_t texts_kept = 50;
constexpr std::size_t batteries_kept = 16;
constexpr base::Duration battery_status_prevails = 5s;  // over SYS_STATUS, which says less of the same battery
constexpr double smallest_step_m = 0.5;                 // below it a standing vehicle's GPS noise would count as travel
constexpr double fastest_vehicle_m_s = 100;             // a step beyond it is a jump of the estimator
constexpr double jump_allowance_m = 20.0;

void extend_track(Heard& kept, VehicleState& state, geo::Wgs84 place, TimePoint now) {
  if (kept.track_end) {
    double const step_m = geo::surface_distance_m(*kept.track_end, place);
    if (step_m < smallest_step_m) return;
    double const farthest_m = jump_allowance_m + fastest_vehicle_m_s * base::to_seconds(now - kept.track_end_heard);
    if (step_m <= farthest_m) state.motion.track_m += step_m;
  }
  kept.track_end = place;
  kept.track_end_heard = now;
}

/// The same with height differences, to compare with estimates.
void extend_path(Heard& kept, geo::Wgs84 place) {
  double const step_m = kept.path_end ? geo::distance_m(*kept.path_end, place) : 0.0;
  if (kept.path_end && step_m < smallest_step_m) return;
  if (step_m <= jump_allowance_m + fastest_vehicle_m_s) kept.path_m += step_m;
  kept.path_end = place;
}

bool has_fix(MavlinkVehicle const& craft) {
  return !craft.heard->fix || *craft.heard->fix >= mavlink::GpsFix::fix_3d;
}

bool position_is_estimated(VehicleState const& state) {
  return state.arming.health.value.value_or(vehicle::Health{}).position_ok;
}

void set_estimator(VehicleState& state, std::uint16_t flags, TimePoint now) {
  auto health = state.arming.health.value.value_or(vehicle::Health{});
  health.position_ok = (flags & mavlink::ekf_flag::position_horizontal_absolute) != 0 &&
                       (flags & mavlink::ekf_flag::constant_position_mode) == 0;
  state.arming.health.set(health, now);
}

/// The battery of that id; the first one stands by itself.
vehicle::Aged<vehicle::Battery>* battery_of(VehicleState& state, int id) {
  if (id == 0) return &state.power.battery;
  auto& all = state.power.further_batteries;
  auto const place = std::ranges::lower_bound(all, id, {}, [](auto const& battery) { return battery.value->id; });
  if (place != all.end() && place->value->id == id) return &*place;
  if (all.size() >= batteries_kept) return nullptr;
  vehicle::Battery fresh;
  fresh.id = id;
  return &*all.insert(place, {fresh, {}});
}

/// MAV_BATTERY_CHARGE_STATE. ArduPilot tells its failsafes by it: low and critical as its parameters have them.
vehicle::Charge charge_of(std::uint8_t state) {
  switch (state) {
    case 1: return vehicle::Charge::ok;
    case 2: return vehicle::Charge::low;
    case 3:                                    // critical
    case 4:                                    // emergency
    case 5:                                    // failed
    case 6: return vehicle::Charge::critical;  // unhealthy
    default: return vehicle::Charge::unknown;
  }
}

/// In the air; on the move or ready for it, for what does not fly.
bool is_working(MavlinkVehicle const& craft) {
  auto const family = craft.state.family;
  bool const drives = family == vehicle::Family::rover || family == vehicle::Family::boat;
  if (!drives && craft.state.motion.landed.value) return !*craft.state.motion.landed.value;
  return craft.heard->is_armed;
}

bool is_level(VehicleState const& state) {
  constexpr double climbs_m_s = 0.7;
  auto const& velocity = state.motion.velocity_m_s.value;
  return !velocity || std::abs(velocity->down) < climbs_m_s;
}

void set_time_left(MavlinkVehicle const& craft, Heard& kept, vehicle::Battery& battery,
                   std::optional<std::chrono::seconds> told, TimePoint now) {
  BatteryReport const report{.remaining = battery.remaining,
                             .current_a = battery.current_a,
                             .drawn_ah = battery.consumed_ah,
                             .is_working = is_working(craft),
                             .is_level = is_level(craft.state),
                             .counts_from_full = craft.state.autopilot == vehicle::Autopilot::ardupilot};
  auto const estimate = kept.battery_times[static_cast<std::uint8_t>(battery.id)].add(report, now);
  battery.in_flight = estimate.in_flight;
  battery.time_left_is_estimate = !told && estimate.now.has_value();
  if (told) battery.time_left = *told;
  if (!battery.time_left_is_estimate) return;
  battery.time_left = estimate.now->time;
  battery.time_left_error = estimate.now->error;
}

/// Names are put together only when a sensor falls sick or recovers, not for every message.
void set_unhealthy(Heard& kept, VehicleState& state, mavlink::SysStatus const& heard, TimePoint now) {
  auto const sick = heard.sensors_present & heard.sensors_enabled & ~heard.sensors_health;
  auto& shown = state.arming.unhealthy;
  shown.heard = now;
  if (shown.value && sick == kept.sick_sensors) return;
  kept.sick_sensors = sick;
  std::vector<std::string_view> names;
  for (unsigned bit = 0; bit < 32; ++bit)
    if ((sick >> bit & 1U) != 0 && !mavlink::sensor_name(bit).empty()) names.push_back(mavlink::sensor_name(bit));
  shown.value = std::move(names);
}

void set_remote_control_lost(MavlinkVehicle const& craft, VehicleState& state) {
  auto& remote = state.links.remote_control;
  if (!remote.value) return;
  remote.value->is_lost =
      remote.value->channels == 0 || (craft.heard->sick_sensors & mavlink::sensor_flag::rc_receiver) != 0;
}

std::string_view state_name(mavlink::MissionState state) {
  switch (state) {
    case mavlink::MissionState::no_mission: return "no mission";
    case mavlink::MissionState::not_started: return "not started";
    case mavlink::MissionState::active: return "active";
    case mavlink::MissionState::paused: return "paused";
    case mavlink::MissionState::complete: return "complete";
    case mavlink::MissionState::unknown: break;
  }
  return "";
}

std::string_view breach_name(std::uint8_t type) {
  static constexpr std::array<std::string_view, 4> names{"", "minimum altitude", "maximum altitude", "boundary"};
  return type < names.size() ? names[type] : "fence";
}

void show_texts(VehicleState& state, std::vector<vehicle::StatusText> const& texts) {
  for (auto const& text : texts) (void)note_arming_reason(state.arming.reasons, text);
  auto& kept = state.recent_texts;
  kept.insert(kept.end(), texts.begin(), texts.end());
  if (kept.size() > texts_kept) kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(texts_kept));
}

}  // namespace

/// One overload for each message that shows; everything else falls through to the template.
struct TelemetryTaking {
  static Heard& kept_of(MavlinkVehicle& vehicle) { return vehicle.heard.write(As<TelemetryTaking>()); }

  MavlinkVehicle& craft;
  TimePoint now;
  VehicleState& state = craft.state;
  Heard& kept = kept_of(craft);

  template <class Other>
  bool operator()(Other const&) const {
    return false;
  }

  /// What is absent leaves the field as it was, and as old as it is.
  template <class T>
  void take_known(vehicle::Aged<T>& field, std::optional<T> const& heard) const {
    if (heard) field.set(*heard, now);
  }

  bool operator()(mavlink::GlobalPosition const& heard) const {
    auto const& place = heard.position;
    bool const is_nowhere = place && place->lat_rad == 0.0 && place->lon_rad == 0.0;
    if (is_nowhere || !has_fix(craft)) return false;
    take_known(state.motion.position, place);
    take_known(state.motion.relative_alt_m, heard.relative_alt_m);
    take_known(state.motion.velocity_m_s, heard.velocity_m_s);
    if (position_is_estimated(state)) take_known(state.motion.heading_rad, heard.heading_rad);
    if (!place) return true;
    extend_track(kept, state, *place, now);
    extend_path(kept, *place);
    return true;
  }

  bool operator()(mavlink::Attitude const& heard) const {
    if (!heard.roll_rad || !heard.pitch_rad || !heard.yaw_rad) return false;
    state.motion.attitude.set({*heard.roll_rad, *heard.pitch_rad, *heard.yaw_rad}, now);
    return true;
  }

  bool operator()(mavlink::GpsRaw const& heard) const {
    kept.fix = heard.fix;
    state.positioning.gps.set({static_cast<int>(heard.fix), heard.satellites, heard.hdop}, now);
    return true;
  }

  bool operator()(mavlink::VfrHud const& heard) const {
    state.motion.hud.set({heard.airspeed_m_s, heard.climb_m_s, heard.throttle}, now);
    return true;
  }

  bool operator()(mavlink::Wind const& heard) const {
    if (!heard.from_rad || !heard.speed_m_s) return false;
    state.motion.wind.set({geo::wrap_two_pi(*heard.from_rad), *heard.speed_m_s}, now);
    return true;
  }

  bool operator()(mavlink::WindCov const& heard) const {
    if (!heard.north_m_s || !heard.east_m_s) return false;
    auto const from_rad = geo::wrap_two_pi(std::atan2(-*heard.east_m_s, -*heard.north_m_s));
    state.motion.wind.set({from_rad, std::hypot(*heard.north_m_s, *heard.east_m_s)}, now);
    return true;
  }

  bool operator()(mavlink::NavControllerOutput const& heard) const {
    state.mission.waypoint_distance_m.set(heard.waypoint_distance_m, now);
    return true;
  }

  bool operator()(mavlink::PositionTargetGlobalInt const& heard) const {
    constexpr std::uint16_t horizontal = 0b11;
    auto const& target = heard.setpoint;
    bool const is_place = (target.ignore & horizontal) == 0 && (target.lat_rad != 0.0 || target.lon_rad != 0.0);
    if (is_place) state.mission.position_target.set({target.lat_rad, target.lon_rad, target.alt_m}, now);
    return false;
  }

  bool operator()(mavlink::RcChannels const& heard) const {
    state.links.remote_control.set({false, heard.count, heard.pulses_us, heard.rssi}, now);
    set_remote_control_lost(craft, state);
    return true;
  }

  bool operator()(mavlink::FenceStatus const& heard) const {
    state.mission.fence.set({heard.breached, heard.breach_count, breach_name(heard.breach_type)}, now);
    return true;
  }

  bool operator()(mavlink::SysStatus const& heard) const {
    kept.has_reported_battery = true;
    bool const knows_more = kept.battery_status_heard && now - *kept.battery_status_heard < battery_status_prevails;
    if (heard.battery_remaining && !knows_more) {
      vehicle::Battery battery{.remaining = *heard.battery_remaining,
                               .voltage_v = heard.battery_voltage_v,
                               .current_a = heard.battery_current_a};
      set_time_left(craft, kept, battery, std::nullopt, now);
      state.power.battery.set(battery, now);
    }
    auto health = state.arming.health.value.value_or(vehicle::Health{});
    health.prearm_ok = (heard.sensors_health & prearm_check) != 0;
    state.arming.health.set(health, now);
    bool const could_not_arm = kept.prearm_ok == false;
    kept.prearm_ok = health.prearm_ok;
    if (could_not_arm && health.prearm_ok) state.arming.reasons.clear();
    set_unhealthy(kept, state, heard, now);
    set_remote_control_lost(craft, state);
    return true;
  }

  bool operator()(mavlink::BatteryStatus const& heard) const {
    if (!heard.remaining) return false;
    auto* const shown = battery_of(state, heard.id);
    if (!shown) return false;
    vehicle::Battery battery{.remaining = *heard.remaining,
                             .voltage_v = heard.voltage_v,
                             .current_a = heard.current_a,
                             .id = heard.id,
                             .consumed_ah = heard.consumed_ah,
                             .charge = charge_of(heard.charge_state)};
    set_time_left(craft, kept, battery, heard.time_remaining, now);
    shown->set(battery, now);
    if (heard.id != 0) return true;
    kept.has_reported_battery = true;
    kept.battery_status_heard = now;
    return true;
  }

  bool operator()(mavlink::EkfStatusReport const& heard) const {
    set_estimator(state, heard.flags, now);
    state.positioning.estimator.set({heard.velocity_variance, heard.position_horizontal_variance,
                                     heard.position_vertical_variance, heard.compass_variance},
                                    now);
    return true;
  }

  bool operator()(mavlink::EstimatorStatus const& heard) const {
    set_estimator(state, heard.flags, now);
    state.positioning.estimator.set(
        {heard.velocity_ratio, heard.position_horizontal_ratio, heard.position_vertical_ratio, std::nullopt}, now);
    return true;
  }

  bool operator()(mavlink::HomePosition const& heard) const {
    if (!heard.position) return false;
    state.motion.home.set(*heard.position, now);
    return true;
  }

  bool operator()(mavlink::ExtendedSysState const& heard) const {
    if (heard.landed_state == mavlink::MavLandedState::undefined) return false;
    bool const landed = heard.landed_state == mavlink::MavLandedState::on_ground;
    state.motion.landed.set(landed, now);
    auto& trace = kept.trace;
    if (!landed) trace.on_ground_since.reset();
    if (landed && !trace.on_ground_since) trace.on_ground_since = now;
    trace.on_ground_heard = now;
    return true;
  }

  bool operator()(mavlink::MissionCurrent const& heard) const {
    auto& trace = kept.trace;
    trace.current_seq = std::max<int>(trace.current_seq.value_or(0), heard.seq);
    trace.reports_complete = heard.state == mavlink::MissionState::complete;
    if (!trace.reports_complete) trace.was_active = true;
    int const known_total = state.mission.progress.value ? state.mission.progress.value->total : 0;
    state.mission.progress.set({heard.seq, heard.total ? static_cast<int>(*heard.total) : known_total,
                                trace.reports_complete, state_name(heard.state)},
                               now);
    return true;
  }

  bool operator()(mavlink::MissionItemReached const& heard) const {
    kept.trace.reached_seq = std::max<int>(kept.trace.reached_seq.value_or(0), heard.seq);
    return false;
  }
};

bool take_telemetry(MavlinkVehicle& craft, mavlink::Message const& message, TimePoint now) {
  return std::visit(TelemetryTaking{craft, now}, message);
}

std::vector<vehicle::StatusText> take_text(MavlinkVehicle& craft, std::uint8_t component,
                                           mavlink::StatusText const& chunk, TimePoint now) {
  auto texts = TelemetryTaking::kept_of(craft).texts.add(
      {static_cast<int>(chunk.severity), chunk.text, chunk.id, chunk.chunk_seq, component}, now);
  show_texts(craft.state, texts);
  return texts;
}

std::vector<vehicle::StatusText> take_overdue_texts(MavlinkVehicle& craft, TimePoint now) {
  auto texts = TelemetryTaking::kept_of(craft).texts.overdue(now);
  show_texts(craft.state, texts);
  return texts;
}

void begin_trace(MavlinkVehicle& craft) {
  TelemetryTaking::kept_of(craft).trace = {};
}

void take_radio(MavlinkVehicle& craft, mavlink::RadioStatus const& heard, TimePoint now) {
  craft.state.links.radio.set({.rssi = heard.rssi,
                               .remote_rssi = heard.remote_rssi,
                               .noise = heard.noise,
                               .remote_noise = heard.remote_noise,
                               .transmit_buffer_free = heard.transmit_buffer_free,
                               .receive_errors = heard.receive_errors},
                              now);
}

std::optional<base::Duration> boot_time(mavlink::Message const& message) {
  if (auto const* position = std::get_if<mavlink::GlobalPosition>(&message)) return position->since_boot;
  if (auto const* attitude = std::get_if<mavlink::Attitude>(&message)) return attitude->since_boot;
  if (auto const* time = std::get_if<mavlink::SystemTime>(&message)) return time->since_boot;
  return std::nullopt;
}

}  // namespace lapwing::fleet
