#include "sim/mavlink/reports.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

namespace lapwing::sim {

using namespace mavlink;
using std::numbers::pi;

namespace {

constexpr MessageId position_target{87};
/// Until the estimator has its yaw, the reported heading is off by about this much.
constexpr double unsettled_yaw_rad = 106.0 * pi / 180.0;

/// The point that the present goal leads to, if there is one.
std::optional<geo::Ned> target_of(Goal const& goal) {
  if (auto const* way = std::get_if<FlyTo>(&goal)) return way->point;
  if (auto const* hold = std::get_if<HoldAt>(&goal)) return hold->point;
  if (auto const* circle = std::get_if<sim::Circle>(&goal)) return circle->center;
  if (auto const* descend = std::get_if<Descend>(&goal)) return descend->point;
  if (auto const* up = std::get_if<TakeOff>(&goal)) return geo::Ned{up->from.north, up->from.east, -up->height_m};
  return std::nullopt;
}

MavType type_of(Airframe const& airframe) {
  switch (airframe.family) {
    case vehicle::Family::rover: return airframe.floats ? MavType::surface_boat : MavType::ground_rover;
    case vehicle::Family::plane: return MavType::fixed_wing;
    case vehicle::Family::sub: return MavType::submarine;
    default: return MavType::quadrotor;
  }
}

Heartbeat heartbeat(Autopilot const& autopilot) {
  bool const is_rover = autopilot.airframe().family == vehicle::Family::rover;
  bool const initialising = is_rover && !autopilot.kind().is_px4() && autopilot.now() < autopilot.boot().standby;
  return {.type = type_of(autopilot.airframe()),
          .autopilot = autopilot.kind().is_px4() ? MavAutopilot::px4 : MavAutopilot::ardupilotmega,
          .base_mode = autopilot.base_mode(),
          .custom_mode = initialising ? 16U : autopilot.mode().number,
          .system_status = autopilot.system_status()};
}

double reported_yaw(Autopilot const& autopilot) {
  double const yaw = autopilot.body().attitude.yaw_rad;
  return geo::wrap_two_pi(autopilot.navigation().yaw_settled ? yaw : yaw + unsettled_yaw_rad);
}

SysStatus sys_status(Autopilot const& autopilot) {
  using namespace sensor_flag;
  constexpr std::uint32_t calibrated = 0b1111;  // gyroscope, accelerometer, compass, barometer
  std::uint32_t present = calibrated | gps | motor_outputs | rc_receiver | ahrs | battery | prearm_check;
  std::uint32_t health = calibrated | motor_outputs | battery;
  auto enabled = present;
  if (autopilot.fence_present()) present |= geofence;
  if (autopilot.fence_present() && autopilot.fence_acts()) enabled |= geofence;
  if (autopilot.fence().breached() == 0) health |= geofence;
  if (!autopilot.radio_lost()) health |= rc_receiver;
  if (autopilot.navigation().fix_type >= 3) health |= gps;
  if (autopilot.now() >= autopilot.boot().ekf_initialised) health |= ahrs;
  if (autopilot.prearm_ok()) health |= prearm_check;
  auto const& pack = autopilot.battery();
  return {.sensors_present = present,
          .sensors_enabled = enabled,
          .sensors_health = health,
          .load = 0.1,
          .battery_voltage_v = pack.voltage_v(),
          .battery_current_a = pack.current_a(),
          .battery_remaining = pack.remaining(),
          .drop_rate_comm = 0.0};
}

BatteryStatus battery_status(Autopilot const& autopilot) {
  auto const& pack = autopilot.battery();
  BatteryStatus status;
  status.voltage_v = pack.voltage_v();
  status.current_a = pack.current_a();
  status.consumed_ah = pack.used_mah() * 1e-3;
  status.remaining = pack.remaining();
  return status;
}

geo::Wgs84 reported_place(ReportView const& view) {
  if (!view.autopilot.navigation().position_known) return {};
  return view.site.place_at(view.autopilot.body().position_m);
}

GpsRaw gps_raw(ReportView const& view) {
  auto const& body = view.autopilot.body();
  auto const& navigation = view.autopilot.navigation();
  GpsRaw raw;
  raw.time = std::chrono::duration_cast<std::chrono::microseconds>(view.autopilot.now());
  raw.fix = static_cast<GpsFix>(navigation.fix_type);
  raw.position = reported_place(view);
  raw.satellites = navigation.satellites;
  if (navigation.fix_type >= 3) {
    raw.hdop = 1.21;
    raw.vdop = 2.0;
    raw.ground_speed_m_s = body.ground_speed_m_s();
    raw.course_rad = geo::wrap_two_pi(std::atan2(body.velocity_m_s.east, body.velocity_m_s.north));
    raw.horizontal_accuracy_m = 0.3;
    raw.vertical_accuracy_m = 0.3;
  }
  return raw;
}

GlobalPosition global_position(ReportView const& view) {
  auto const& autopilot = view.autopilot;
  bool const known = autopilot.navigation().position_known;
  auto const& body = autopilot.body();
  double const home_down = autopilot.home().value_or(body.position_m).down;
  return {.since_boot = autopilot.now(),
          .position = reported_place(view),
          .relative_alt_m = known ? home_down - body.position_m.down : 0.0,
          .velocity_m_s = known ? body.velocity_m_s : geo::Ned{},
          .heading_rad = reported_yaw(autopilot)};
}

VfrHud vfr_hud(ReportView const& view) {
  auto const& autopilot = view.autopilot;
  auto const& body = autopilot.body();
  double const throttle = autopilot.armed() ? std::clamp(autopilot.battery().current_a() / 40.0, 0.0, 1.0) : 0.0;
  return {.airspeed_m_s = body.airspeed_m_s,
          .ground_speed_m_s = body.ground_speed_m_s(),
          .heading_rad = reported_yaw(autopilot),
          .throttle = throttle,
          .alt_m = reported_place(view).alt_m,
          .climb_m_s = -body.velocity_m_s.down};
}

/// An ArduRover tells where it steers in its automatic modes only, an ArduPlane in every mode but MANUAL.
bool steers_itself(Autopilot const& autopilot) {
  auto const family = autopilot.kind().family;
  auto const& mode = autopilot.mode();
  if (autopilot.kind().is_px4()) return true;
  if (family == vehicle::Family::plane) return mode.name != "MANUAL";
  bool const stands = mode.behaviour == Behaviour::manual || mode.name == "HOLD";
  return family != vehicle::Family::rover || !stands;
}

NavControllerOutput nav_output(Autopilot const& autopilot) {
  auto const& body = autopilot.body();
  NavControllerOutput output{.alt_error_m = 0.0, .airspeed_error_m_s = 0.0, .cross_track_error_m = 0.0};
  // In hundredths, against the message's definition, as ArduPlane does it.
  bool const is_arduplane = autopilot.kind().family == vehicle::Family::plane && !autopilot.kind().is_px4();
  bool const rolls_or_flies = autopilot.armed() && body.airspeed_m_s > 1.0;
  if (is_arduplane && rolls_or_flies)
    output.airspeed_error_m_s = 100.0 * (autopilot.pace().speed_m_s - body.airspeed_m_s);
  output.nav_roll_rad = body.attitude.roll_rad;
  output.nav_pitch_rad = body.attitude.pitch_rad;
  output.nav_bearing_rad = body.attitude.yaw_rad;
  output.target_bearing_rad = body.attitude.yaw_rad;
  if (auto const target = target_of(autopilot.goal())) {
    double const north = target->north - body.position_m.north;
    double const east = target->east - body.position_m.east;
    output.waypoint_distance_m = std::hypot(north, east);
    output.target_bearing_rad = std::atan2(east, north);
    output.nav_bearing_rad = output.target_bearing_rad;
    output.alt_error_m = body.position_m.down - target->down;
  }
  return output;
}

std::optional<Message> position_target_report(ReportView const& view) {
  auto const behaviour = view.autopilot.mode().behaviour;
  if (behaviour != Behaviour::guided && behaviour != Behaviour::mission) return std::nullopt;
  auto const target = target_of(view.autopilot.goal());
  if (!target) return std::nullopt;
  auto const place = view.site.place_at(*target);
  GlobalSetpoint setpoint;
  setpoint.frame = MavFrame::global;
  setpoint.ignore = 0b110111111000;  // the position counts, nothing else
  setpoint.lat_rad = place.lat_rad;
  setpoint.lon_rad = place.lon_rad;
  setpoint.alt_m = place.alt_m;
  return PositionTargetGlobalInt{view.autopilot.now(), setpoint};
}

MissionCurrent mission_current(ReportView const& view) {
  auto const& mission = view.autopilot.mission();
  bool const in_auto = view.autopilot.mode().behaviour == Behaviour::mission;
  // Out of it, PX4 says so and ArduPilot that it does not know.
  std::uint8_t const elsewhere = view.autopilot.kind().is_px4() ? 2 : 0;
  return {.seq = wire_seq(view.autopilot.kind(), mission.current()),
          .total = static_cast<std::uint16_t>(view.mission_items > 0 ? view.mission_items - 1 : 0),
          .state = mission.state(),
          .mission_mode = in_auto ? std::uint8_t{1} : elsewhere};
}

sim::Body const& body_of(ReportView const& view) {
  return view.autopilot.body();
}

Attitude attitude(ReportView const& view) {
  auto const& body = body_of(view);
  return {.since_boot = view.autopilot.now(),
          .roll_rad = body.attitude.roll_rad,
          .pitch_rad = body.attitude.pitch_rad,
          .yaw_rad = geo::wrap_pi(reported_yaw(view.autopilot)),
          .roll_rate_rad_s = 0.0,
          .pitch_rate_rad_s = 0.0,
          .yaw_rate_rad_s = body.yaw_rate_rad_s};
}

EkfStatusReport ekf_status(Autopilot const& autopilot) {
  float const variance = autopilot.navigation().position_ok ? 0.05F : 1.0F;
  return {.flags = autopilot.navigation().ekf_flags,
          .velocity_variance = variance,
          .position_horizontal_variance = variance,
          .position_vertical_variance = 0.02F,
          .compass_variance = 0.01F,
          .terrain_alt_variance = 0.0};
}

FenceStatus fence_status(Autopilot const& autopilot) {
  // FENCE_BREACH of common.xml.
  constexpr std::uint8_t too_low = 1;
  constexpr std::uint8_t too_high = 2;
  constexpr std::uint8_t boundary = 3;
  auto const& fence = autopilot.fence();
  auto const breached = fence.breached();
  std::uint8_t type = 0;
  if ((breached & FenceWatch::floor) != 0) type = too_low;
  if ((breached & FenceWatch::height) != 0) type = too_high;
  if ((breached & (FenceWatch::circle | FenceWatch::areas)) != 0) type = boundary;
  return {.breached = breached != 0,
          .breach_count = static_cast<std::uint16_t>(fence.count()),
          .breach_type = type,
          .breach_time = fence.breached_at()};
}

EstimatorStatus estimator_status(Autopilot const& autopilot) {
  // The flags of both autopilots mean the same (ESTIMATOR_STATUS_FLAGS, EKF_STATUS_FLAGS).
  float const ratio = autopilot.navigation().position_ok ? 0.05F : 1.5F;
  float const accuracy_m = autopilot.navigation().position_ok ? 0.5F : 50.0F;
  return {.flags = autopilot.navigation().ekf_flags,
          .velocity_ratio = ratio,
          .position_horizontal_ratio = ratio,
          .position_vertical_ratio = 0.1F,
          .position_horizontal_accuracy_m = accuracy_m,
          .position_vertical_accuracy_m = 0.8F};
}

/// MAV_PROTOCOL_CAPABILITY of PX4: missions, fences and rally points, COMMAND_INT, bytewise parameters, FTP, setpoints,
/// termination, MAVLink 2.
AutopilotVersion capabilities(Kind const& kind) {
  if (!kind.is_px4()) return {.capabilities = 0xFBEF, .flight_sw_version = 0x04060000};
  constexpr std::uint64_t missions = 1U << 0U | 1U << 2U;
  constexpr std::uint64_t command_int = 1U << 3U;
  constexpr std::uint64_t bytewise_parameters = 1U << 4U;
  constexpr std::uint64_t ftp_and_setpoints = 1U << 5U | 1U << 6U | 1U << 7U | 1U << 8U;
  constexpr std::uint64_t termination = 1U << 11U;
  constexpr std::uint64_t mavlink_2 = 1U << 13U;
  constexpr std::uint64_t fences_and_rally_points = 1U << 14U | 1U << 15U;
  return {.capabilities = missions | command_int | bytewise_parameters | ftp_and_setpoints | termination | mavlink_2 |
                          fences_and_rally_points,
          .flight_sw_version = 0x010F00FF};
}

Wind wind(ReportView const& view) {
  auto const& w = view.wind_m_s;
  return {.from_rad = geo::wrap_two_pi(std::atan2(w.east, w.north) + pi),
          .speed_m_s = std::hypot(w.north, w.east),
          .down_m_s = 0.0};
}

/// What tells one board from another is made of the system id: it is the same after every start.
AutopilotVersion version(ReportView const& view) {
  auto version = capabilities(view.autopilot.kind());
  constexpr std::string_view maker = "lapwing-sim";
  std::ranges::copy(maker, version.uid2.begin());
  // Where an autopilot has the beginning of its commit, in letters: of the ArduPilot whose ways these are.
  constexpr std::string_view commit = "fbb78585";
  if (!view.autopilot.kind().is_px4()) std::ranges::copy(commit, version.flight_custom_version.begin());
  version.uid2.back() = view.system_id;
  return version;
}

/// A transmitter that nobody touches: sticks centred, throttle down, as ArduPilot's own simulation has it.
RcChannels rc_channels(Autopilot const& autopilot) {
  RcChannels channels{.since_boot = autopilot.now(), .count = 16, .rssi = 1.0};
  channels.pulses_us.fill(0);
  for (auto& pulse : std::span(channels.pulses_us).first(4)) pulse = 1500;
  channels.pulses_us[2] = autopilot.radio_signal() == RadioSignal::low_throttle ? 950 : 1000;
  for (auto& pulse : std::span(channels.pulses_us).subspan(4, 12)) pulse = 1800;
  return channels;
}

}  // namespace

std::optional<Message> report(MessageId id, ReportView const& view) {
  auto const& autopilot = view.autopilot;
  if (id == position_target) return position_target_report(view);
  switch (id) {
    case MessageId::heartbeat: return heartbeat(autopilot);
    case MessageId::sys_status: return sys_status(autopilot);
    case MessageId::battery_status: return battery_status(autopilot);
    case MessageId::system_time:
      return SystemTime{std::chrono::duration_cast<std::chrono::microseconds>(view.utc.time_since_epoch()),
                        autopilot.now()};
    case MessageId::gps_raw_int: return gps_raw(view);
    case MessageId::attitude: return attitude(view);
    case MessageId::global_position_int: return global_position(view);
    case MessageId::local_position_ned:
      if (!autopilot.navigation().position_ok) return std::nullopt;
      return LocalPosition{autopilot.now(), body_of(view).position_m, body_of(view).velocity_m_s};
    case MessageId::vfr_hud: return vfr_hud(view);
    case MessageId::nav_controller_output:
      if (!steers_itself(autopilot)) return std::nullopt;
      return nav_output(autopilot);
    case MessageId::mission_current: return mission_current(view);
    case MessageId::ekf_status_report:
      if (autopilot.kind().is_px4()) return std::nullopt;
      return ekf_status(autopilot);
    case MessageId::estimator_status:
      if (!autopilot.kind().is_px4()) return std::nullopt;
      return estimator_status(autopilot);
    case MessageId::wind:
      if (autopilot.kind().is_px4()) return std::nullopt;
      return wind(view);
    case MessageId::rc_channels: return rc_channels(autopilot);
    case MessageId::fence_status:
      if (autopilot.kind().is_px4() || !autopilot.fence_enabled()) return std::nullopt;
      return fence_status(autopilot);
    case MessageId::extended_sys_state: return ExtendedSysState{.landed_state = autopilot.landed_state()};
    case MessageId::home_position:
      if (auto const home = autopilot.home()) return HomePosition{view.site.place_at(*home), home};
      return std::nullopt;
    case MessageId::gps_global_origin:
      if (!autopilot.home()) return std::nullopt;
      return GpsGlobalOrigin{view.site.anchor()};
    case MessageId::autopilot_version: return version(view);
    default: return std::nullopt;
  }
}

}  // namespace lapwing::sim
