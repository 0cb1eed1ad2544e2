#include "robot/rover/rover_body.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mavlink/exchange/command.hpp"
#include "mavlink/exchange/message_interval.hpp"
#include "robot/ros/scan_sides.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot::rover {

using namespace std::chrono_literals;

namespace {

/// Readings and commands go ten times a second, whatever the rate of the telemetry.
constexpr base::Duration reading_period = 95ms;
constexpr base::Duration command_is_old = 500ms;
constexpr base::Duration look_period = 100ms;
/// An autopilot that says nothing for so long is away.
constexpr base::Duration autopilot_is_away = 500ms;
constexpr double low_battery = 0.15;
/// What an estimator makes of standing still.
constexpr double still_m_s = 0.05;

constexpr base::Duration telemetry_period = 50ms;
constexpr base::Duration ranges_period = 100ms;
constexpr base::Duration slow_period = 1s;
/// What is asked for is asked for anew when it has not come for so long: the autopilot may have started anew.
constexpr base::Duration telemetry_is_missing = 3s;
constexpr base::Duration place_comes_within = 10s;
/// So long its estimator has to find an origin by itself, without a receiver for satellites and with one.
constexpr base::Duration origin_comes_within = 5s;
constexpr base::Duration satellites_come_within = 60s;
mavlink::CommandOptions const asked_twice{.tries = 2, .ack_timeout = 500ms};

/// Bits of POSITION_TARGET_TYPEMASK: place, acceleration and heading do not count; velocity and turn rate do.
constexpr std::uint16_t velocity_and_turn_rate = 0b0101'1100'0111;

/// As bus frames of robots have it (REP 105).
constexpr auto base_frame = "base_link";

}  // namespace

RoverBody::RoverBody(base::Loop& loop, std::unique_ptr<link::ByteLink> link, RoverBodyOptions const& options,
                     base::Logger log)
    : loop_(loop),
      options_(options),
      log_(std::move(log)),
      connection_(loop, {}, log_),
      helm_(loop, connection_, options.system_id, log_, options.helm),
      subscription_(
          connection_.subscribe(options.system_id, [this](mavlink::Received const& received) { take(received); })),
      scope_(loop) {
  connection_.add_link(std::move(link));
  scope_.spawn(keep_watch());
  scope_.spawn(keep_asking());
}

RoverBody::~RoverBody() {
  if (helm_.may_steer()) send({});
  helm_.leave();
}

base::Result<> RoverBody::use(LaserOnRos const& laser) {
  auto bus = bus::Bus::open(loop_, {.domain = laser.domain, .is_local = laser.is_local});
  if (!bus) return std::unexpected(bus.error());
  bus_ = *std::move(bus);
  auto opened = ros::RosLaser::open(
      loop_, *bus_, laser.name_space,
      [this](ros::RosLaser::Seen seen) {
        // A scan comes when its last beam has been taken.
        auto const end = laser_clock_.here(seen.times.end(), loop_.now());
        seen.times.first += end.time_since_epoch() - seen.times.end();
        take_scan(seen.times, std::move(seen.ranges_m));
      },
      log_);
  if (!opened) return std::unexpected(opened.error());
  laser_ = *std::move(opened);
  laser_->set_base_frame(base_frame);
  return {};
}

slam::Sensor const* RoverBody::sensor() const {
  return laser_ ? laser_->sensor() : ranges_.sensor();
}

std::string RoverBody::link() const {
  return fmt::format("{}, system {}", connection_.links().front()->name(), options_.system_id);
}

// ---- in

void RoverBody::take(mavlink::Received const& received) {
  take_ranges(received);
  if (received.source.component != mavlink::autopilot_component || !helm_.knows_it()) return;
  auto const& message = received.message;
  if (auto const* attitude = std::get_if<mavlink::Attitude>(&message)) {
    heard_ = received.at;
    if (attitude->since_boot < since_boot_) has_origin_ = false;
    since_boot_ = attitude->since_boot;
    track_.take(*attitude, received.at);
  } else if (auto const* status = std::get_if<mavlink::SysStatus>(&message)) {
    battery_ = status->battery_remaining;
  } else if (auto const* origin = std::get_if<mavlink::GpsGlobalOrigin>(&message)) {
    has_origin_ = origin->position.has_value();
  } else if (std::holds_alternative<mavlink::GpsRaw>(message)) {
    has_satellites_ = true;
  } else if (auto const* place = std::get_if<mavlink::LocalPosition>(&message)) {
    heard_ = received.at;
    auto const corrected = track_.corrections();
    if (!track_.take(*place, received.at)) return;
    placed_ = received.at;
    if (track_.corrections() != corrected) log_.info("the autopilot has corrected where it is; that is no motion");
    tell_scan();
    if (loop_.now() - told_at_ >= reading_period) tell_reading();
  }
}

void RoverBody::take_ranges(mavlink::Received const& received) {
  if (laser_) return;
  std::optional<std::vector<float>> ranges;
  bool const had_sensor = ranges_.sensor() != nullptr;
  if (auto const* sectors = std::get_if<mavlink::ObstacleDistance>(&received.message))
    ranges = ranges_.take(*sectors);
  else if (auto const* single = std::get_if<mavlink::DistanceSensor>(&received.message))
    ranges = ranges_.take(*single, received.at);
  if (!ranges) return;
  if (!had_sensor) log_.info(fmt::format("ranges in {} directions over MAVLink", ranges->size()));
  scans::BeamTimes const times{.first = received.at.time_since_epoch(), .beams = ranges->size()};
  take_scan(times, *std::move(ranges));
}

void RoverBody::take_scan(scans::BeamTimes const& times, std::vector<float> ranges_m) {
  waiting_ = Waiting{.times = times, .ranges_m = std::move(ranges_m)};
  tell_scan();
}

void RoverBody::tell_scan() {
  auto const pose_at = [this](std::chrono::nanoseconds time) { return track_.at(base::TimePoint(time)); };
  if (!waiting_ || !pose_at(waiting_->times.end())) return;
  auto const seen = *std::exchange(waiting_, std::nullopt);
  sides_ = ros::sides_of(*sensor(), seen.ranges_m);
  if (listener_.on_scan) listener_.on_scan(*scans::lay(seen.ranges_m, *sensor(), seen.times, pose_at));
}

void RoverBody::tell_reading() {
  told_at_ = loop_.now();
  auto const& now = *track_.now();
  if (listener_.on_reading)
    listener_.on_reading({.at = told_at_,
                          .odometry = now.pose,
                          .speed_m_s = std::abs(now.speed_m_s) < still_m_s ? 0.0 : now.speed_m_s,
                          .battery = battery_,
                          .sides = sides_,
                          .is_killed = helm_.shows_killed(),
                          .is_waiting = is_waiting_});
}

std::optional<std::uint16_t> RoverBody::take_carrier_code() {
  if (!heard_ || loop_.now() - *heard_ >= autopilot_is_away) return code::board_away;
  if (std::exchange(carrier_told_, *heard_) == *heard_) return std::nullopt;
  if (helm_.is_killed()) return code::killed;
  if (helm_.is_refused()) return code::not_let_drive;
  return battery_ && *battery_ <= low_battery ? code::battery_low : code::none;
}

// ---- out

void RoverBody::send(Motion motion) {
  (void)connection_.send(helm_.address(),
                         mavlink::SetPositionTargetLocalNed{.since_boot = loop_.now().time_since_epoch(),
                                                            .frame = mavlink::MavFrame::body_ned,
                                                            .ignore = velocity_and_turn_rate,
                                                            .velocity_m_s = {motion.speed_m_s, 0.0, 0.0},
                                                            .yaw_rate_rad_s = -motion.turn_rad_s});
}

void RoverBody::drive(Motion motion) {
  motion_ = motion;
  driven_at_ = loop_.now();
  is_waiting_ = false;
  helm_.want(motion != Motion{});
  if (helm_.may_steer()) send(motion);
}

void RoverBody::kill() {
  // What brakes by its speed controller does so from here on; HOLD, which follows, cuts the throttle.
  if (helm_.may_steer()) send({});
  motion_ = {};
  helm_.want(false);
  helm_.kill();
}

base::Task<> RoverBody::keep_watch() {
  for (;;) {
    co_await loop_.sleep(look_period);
    if (motion_ == Motion{} || loop_.now() - driven_at_ < command_is_old) continue;
    is_waiting_ = true;
    if (helm_.may_steer()) send({});
  }
}

base::Task<> RoverBody::keep_asking() {
  base::TimePoint known{};
  bool has_told = false;
  for (;;) {
    co_await loop_.sleep(1s);
    if (!helm_.knows_it()) continue;
    auto const now = loop_.now();
    bool const is_placed = placed_ && now - *placed_ < telemetry_is_missing;
    bool const is_away = !heard_ || now - *heard_ >= telemetry_is_missing;
    // Of who is not heard at all nobody knows what it lacks.
    if (known == base::TimePoint{} || is_placed || is_away) known = now;
    if (is_placed) {
      has_told = false;
    } else {
      if (now - known > place_comes_within && !std::exchange(has_told, true))
        log_.warn("the autopilot does not say where it is (LOCAL_POSITION_NED): its estimator has nothing to go by");
      auto asking = ask_for_messages();
      co_await std::move(asking);
    }
    if (has_origin_) {
      origin_missed_ = loop_.now();
    } else {
      auto seeking = seek_origin();
      co_await std::move(seeking);
    }
  }
}

base::Task<> RoverBody::ask_for_messages() {
  using Id = mavlink::MessageId;
  struct Wanted {
    Id id;
    base::Duration interval;
  };
  constexpr std::array wanted{Wanted{Id::attitude, telemetry_period}, Wanted{Id::local_position_ned, telemetry_period},
                              Wanted{Id::sys_status, slow_period}, Wanted{Id::gps_raw_int, slow_period},
                              Wanted{Id::distance_sensor, ranges_period}};
  for (auto const& each : wanted) {
    auto asking = mavlink::set_message_interval(connection_, helm_.address(), each.id, each.interval, asked_twice);
    // What it lacks it does not send: a rover may have no range sensors of its own.
    (void)co_await std::move(asking);
  }
}

base::Task<> RoverBody::seek_origin() {
  auto const request = mavlink::request_message(mavlink::MessageId::gps_global_origin);
  auto asking = mavlink::run_command(connection_, helm_.address(), request, asked_twice);
  (void)co_await std::move(asking);
  auto const patience = has_satellites_ ? satellites_come_within : origin_comes_within;
  auto const now = loop_.now();
  if (origin_missed_ == base::TimePoint{}) origin_missed_ = now;
  if (has_origin_ || !options_.origin || now - origin_missed_ < patience) co_return;
  log_.info("the estimator has no origin, without which it obeys no setpoint: it is given the site's anchor");
  origin_missed_ = now;
  (void)connection_.send(helm_.address(), mavlink::SetGpsGlobalOrigin{.position = options_.origin});
}

}  // namespace lapwing::robot::rover
