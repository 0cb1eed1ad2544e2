#include "robot/rover/testing/scripted_rover.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace lapwing::robot::rover::testing {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MavResult;

namespace {

constexpr std::size_t sectors = 72;
constexpr auto setpoint_times_out = 3s;

}  // namespace

ScriptedRover::ScriptedRover(base::Loop& loop, std::unique_ptr<link::ByteLink> link, robot::testing::Walls walls,
                             robot::testing::SimpleBodyOptions const& options)
    : loop_(loop),
      wheels_(loop, std::move(walls),
              [&] {
                auto sized = options;
                sized.beams = sectors;
                return sized;
              }()),
      connection_(loop, {.self = {1, mavlink::autopilot_component}, .heartbeat = {}}, {}),
      subscription_(connection_.subscribe([this](mavlink::Received const& received) {
        if (is_mute) return;
        heard.push_back(received.message);
        on(received.message);
      })) {
  connection_.add_link(std::move(link));
  wheels_.listen({.on_reading = [this](Reading const& reading) { tell(reading); },
                  .on_scan = [this](slam::Scan const& scan) { tell(scan); }});
  life_ = live();
  life_.start();
}

int ScriptedRover::commanded(MavCmd command, float first) const {
  int count = 0;
  for (auto const& each : all<mavlink::CommandLong>())
    if (each.command == command && each.params[command == MavCmd::do_set_mode ? 1 : 0] == first) ++count;
  return count;
}

void ScriptedRover::say(std::string text) {
  tell(mavlink::StatusText{.severity = mavlink::MavSeverity::critical, .text = std::move(text)});
}

mavlink::Heartbeat ScriptedRover::heartbeat() const {
  namespace flag = mavlink::mode_flag;
  auto const armed = is_armed ? flag::safety_armed : std::uint8_t{0};
  return {.type = type,
          .autopilot = mavlink::MavAutopilot::ardupilotmega,
          .base_mode = static_cast<std::uint8_t>(flag::custom_mode_enabled | armed),
          .custom_mode = mode,
          .system_status = mavlink::MavState::active};
}

base::Task<> ScriptedRover::live() {
  co_await loop_.turn();
  for (int i = 0;; ++i) {
    if (!is_mute && i % 10 == 0) tell(heartbeat());
    if (!is_mute && i % 10 == 5) tell(mavlink::SysStatus{.battery_remaining = wheels_.battery});
    co_await loop_.sleep(100ms);
    bool const obeys = mode == guided && is_armed && loop_.now() - steered_at_ < setpoint_times_out;
    if (!obeys) motion = {};
    wheels_.drive(motion);
  }
}

void ScriptedRover::on(mavlink::Message const& message) {
  if (auto const* command = std::get_if<mavlink::CommandLong>(&message)) on(*command);
  if (auto const* setpoint = std::get_if<mavlink::SetPositionTargetLocalNed>(&message)) on(*setpoint);
  if (std::holds_alternative<mavlink::SetGpsGlobalOrigin>(message)) has_origin = true;
}

void ScriptedRover::on(mavlink::CommandLong const& command) {
  auto const result = perform(command);
  tell(mavlink::CommandAck{.target = {255, 190}, .command = command.command, .result = result});
}

MavResult ScriptedRover::perform(mavlink::CommandLong const& command) {
  switch (command.command) {
    case MavCmd::do_set_mode:
      if (is_deaf_to_stops && command.params[1] == static_cast<float>(hold)) return MavResult::temporarily_rejected;
      mode = static_cast<std::uint32_t>(command.params[1]);
      return MavResult::accepted;
    case MavCmd::component_arm_disarm:
      if (command.params[0] != 0.0F && objects_to_arming) {
        say(*objects_to_arming);
        return MavResult::failed;
      }
      if (is_deaf_to_stops && command.params[0] == 0.0F) return MavResult::temporarily_rejected;
      is_armed = command.params[0] != 0.0F;
      return MavResult::accepted;
    case MavCmd::request_message: return tell_on_request(command.params[0]);
    case MavCmd::set_message_interval: return MavResult::accepted;
    default: return MavResult::unsupported;
  }
}

MavResult ScriptedRover::tell_on_request(float message) {
  if (message == 0.0F) {
    tell(heartbeat());
    return MavResult::accepted;
  }
  bool const is_origin = message == static_cast<float>(mavlink::MessageId::gps_global_origin);
  if (!is_origin || !has_origin) return MavResult::failed;
  tell(mavlink::GpsGlobalOrigin{.position = geo::Wgs84::from_degrees(41.178, -8.598, 90.0)});
  return MavResult::accepted;
}

void ScriptedRover::on(mavlink::SetPositionTargetLocalNed const& setpoint) {
  if (mode != guided || !has_origin) return;
  steered_at_ = loop_.now();
  motion = {.speed_m_s = setpoint.velocity_m_s.north, .turn_rad_s = -setpoint.yaw_rate_rad_s};
}

/// The map's x axis is laid to the north.
void ScriptedRover::tell(Reading const& reading) {
  if (is_mute) return;
  auto const since_boot = loop_.now().time_since_epoch();
  auto const& at = reading.odometry;
  double turn_rad_s = 0.0;
  double ahead_m_s = 0.0;
  if (before_) {
    auto const step = slam::between(before_->odometry, at);
    auto const seconds = base::to_seconds(reading.at - before_->at);
    turn_rad_s = step.yaw / seconds;
    ahead_m_s = step.x / seconds;
  }
  before_ = reading;
  tell(mavlink::Attitude{.since_boot = since_boot, .yaw_rad = -at.yaw, .yaw_rate_rad_s = -turn_rad_s});
  if (!has_place) return;
  tell(mavlink::LocalPosition{
      .since_boot = since_boot,
      .position_m = geo::Ned{at.x + jump_m, -at.y, 0.0},
      .velocity_m_s = geo::Ned{ahead_m_s * std::cos(at.yaw), -ahead_m_s * std::sin(at.yaw), 0.0}});
}

void ScriptedRover::tell(slam::Scan const& scan) {
  if (is_mute || !has_ranges) return;
  mavlink::ObstacleDistance seen{.step_rad = 5.0 * std::numbers::pi / 180.0,
                                 .least_m = 0.02,
                                 .most_m = 10.0,
                                 .first_bearing_rad = 0.0,
                                 .frame = mavlink::MavFrame::body_frd};
  // The wheels' laser counts counterclockwise from behind, the message clockwise from ahead.
  for (std::size_t i = 0; i < sectors; ++i) {
    auto const range = scan.ranges_m[(sectors + sectors / 2 - i) % sectors];
    seen.distances_m.push_back(range >= 10.0F ? 10.01F : range);
  }
  tell(seen);
}

}  // namespace lapwing::robot::rover::testing
