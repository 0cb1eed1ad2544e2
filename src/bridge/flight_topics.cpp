#include "bridge/flight_topics.hpp"

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

void FlightTopics::tell_state() {
  auto state = ros_state(flight_, loop_.now());
  state.header = header();
  state_->publish(state);
}

void FlightTopics::tell_position(mavlink::GlobalPosition const& position) {
  if (position.position) {
    auto fix = ros_fix(position, flight_.gps, geoid_m_);
    fix.header = header(body_frame);
    position_->publish(fix);
  }
  if (position.relative_alt_m) relative_altitude_->publish({*position.relative_alt_m});
}

void FlightTopics::tell_pose(mavlink::LocalPosition const& position) {
  auto const& attitude = flight_.attitude;
  if (!position.position_m || !attitude) return;
  bus::PoseStamped pose{.header = header(world_frame)};
  pose.pose.position = ros_point(*position.position_m);
  pose.pose.orientation = ros_orientation({.roll_rad = attitude->roll_rad.value_or(0.0),
                                           .pitch_rad = attitude->pitch_rad.value_or(0.0),
                                           .yaw_rad = attitude->yaw_rad.value_or(0.0)});
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
