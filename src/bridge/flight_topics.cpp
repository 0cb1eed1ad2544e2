#include "bridge/flight_topics.hpp"

#include <cmath>
#include <utility>

#include "base/wall_clock.hpp"
#include "bridge/frames.hpp"
#include "bridge/ros_messages.hpp"
#include "bus/messages/mavros_names.hpp"
#include "bus/messages/stamps.hpp"

namespace lapwing::bridge {

namespace names = bus::mavros::names;
using bus::Profile;

namespace {

/// The attitude was measured some time before or after the place, and a drone turns by a degree in that.
Attitude attitude_at(mavlink::Duration since_boot, mavlink::Attitude const& attitude) {
  constexpr double longest_s = 0.3;  // what it turns by is known for a short while alone
  double const apart_s = base::to_seconds(since_boot - attitude.since_boot);
  double const turning_s = std::abs(apart_s) <= longest_s ? apart_s : 0.0;
  // A copter's angles from level are small: their rates are those about its axes.
  auto const turned = [&](std::optional<double> const& angle, std::optional<double> const& rate) {
    return angle.value_or(0.0) + turning_s * rate.value_or(0.0);
  };
  return {.roll_rad = turned(attitude.roll_rad, attitude.roll_rate_rad_s),
          .pitch_rad = turned(attitude.pitch_rad, attitude.pitch_rate_rad_s),
          .yaw_rad = turned(attitude.yaw_rad, attitude.yaw_rate_rad_s)};
}

/// Of the world and of the body, as MAVROS names them (REP 105).
constexpr auto world_frame = "map";
constexpr auto body_frame = "base_link";

}  // namespace

base::Result<std::unique_ptr<FlightTopics>> FlightTopics::open(base::Loop& loop, bus::Bus& bus,
                                                               FlightController const& flight, double geoid_m) {
  std::unique_ptr<FlightTopics> topics(new FlightTopics(loop, flight, geoid_m));
  bus::Ends ends(bus);
  ends.say(topics->state_, names::state, Profile::latched);
  ends.say(topics->system_status_, names::system_status, Profile::standard);
  ends.say(topics->battery_, names::battery, Profile::standard);
  ends.say(topics->position_, names::position, Profile::standard);
  ends.say(topics->relative_altitude_, names::relative_altitude, Profile::standard);
  ends.say(topics->pose_, names::local_pose, Profile::standard);
  ends.say(topics->home_, names::home, Profile::latched);
  ends.say(topics->texts_, names::status_text, Profile::standard);
  if (auto const opened = ends.result(); !opened) return std::unexpected(opened.error());
  return topics;
}

bus::Header FlightTopics::header(std::string frame) const {
  return bus::header_at(base::wall_now(), std::move(frame));
}

bus::Header FlightTopics::header_of(mavlink::Duration since_boot, std::string frame) {
  auto const now = loop_.now();
  auto const late = now - clock_.here(since_boot, now);
  return bus::header_at(base::wall_now() - std::chrono::duration_cast<base::UtcTime::duration>(late), std::move(frame));
}

void FlightTopics::tell_state() {
  auto state = ros_state(flight_, loop_.now());
  state.header = header();
  state_->publish(state);
}

void FlightTopics::tell_position(mavlink::GlobalPosition const& position) {
  if (position.position) {
    auto fix = ros_fix(position, flight_.gps, geoid_m_);
    fix.header = header_of(position.since_boot, body_frame);
    position_->publish(fix);
  }
  if (position.relative_alt_m) relative_altitude_->publish({*position.relative_alt_m});
}

void FlightTopics::tell_pose(mavlink::LocalPosition const& position) {
  auto const& attitude = flight_.attitude;
  if (!position.position_m || !attitude) return;
  bus::PoseStamped pose{.header = header_of(position.since_boot, world_frame)};
  pose.pose.position = ros_point(*position.position_m);
  pose.pose.orientation = ros_orientation(attitude_at(position.since_boot, *attitude));
  pose_->publish(pose);
}

void FlightTopics::tell_home(mavlink::HomePosition const& home) {
  if (!home.position) return;
  if (!flight_.origin) {
    home_without_origin_ = home;
    return;
  }
  auto told = ros_home(*home.position, *flight_.origin, geoid_m_);
  told.header = header(world_frame);
  home_->publish(told);
}

void FlightTopics::tell_health(mavlink::SysStatus const& status) {
  auto told = ros_system_status(status);
  told.header = header();
  system_status_->publish(told);
  auto battery = ros_battery(status);
  battery.header = header();
  battery_->publish(battery);
}

void FlightTopics::tell(mavlink::Message const& message) {
  if (std::holds_alternative<mavlink::Heartbeat>(message)) return tell_state();
  if (auto const* const position = std::get_if<mavlink::GlobalPosition>(&message)) return tell_position(*position);
  if (auto const* const local = std::get_if<mavlink::LocalPosition>(&message)) return tell_pose(*local);
  if (auto const* const home = std::get_if<mavlink::HomePosition>(&message)) return tell_home(*home);
  if (std::holds_alternative<mavlink::GpsGlobalOrigin>(message) && home_without_origin_)
    return tell_home(*std::exchange(home_without_origin_, std::nullopt));
  if (auto const* const status = std::get_if<mavlink::SysStatus>(&message)) return tell_health(*status);
  if (auto const* const text = std::get_if<mavlink::StatusText>(&message))
    texts_->publish({.header = header(), .severity = static_cast<std::uint8_t>(text->severity), .text = text->text});
}

}  // namespace lapwing::bridge
