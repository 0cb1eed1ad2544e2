#include "onboard/decide/flight_hand.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "bus/messages/mavros_names.hpp"
#include "bus/messages/stamps.hpp"

namespace lapwing::onboard {

namespace names = bus::mavros::names;
namespace mavros = bus::mavros;
namespace request = autonomy::request;
using bus::Profile;

namespace {

constexpr std::uint16_t component_arm_disarm = 400;  // MAV_CMD_COMPONENT_ARM_DISARM
constexpr float by_force = 21196.0F;                 // its magic number

/// ArduPilot's parameter, in centimetres.
constexpr auto return_altitude = "RTL_ALT";
constexpr double cm_per_m = 100.0;

bus::Header header_now(std::string frame) {
  return bus::header_at(base::wall_now(), std::move(frame));
}

}  // namespace

bus::Quaternion orientation_of(std::optional<double> yaw_rad) {
  if (!yaw_rad) return {.w = 0.0};
  return {.z = std::sin(*yaw_rad / 2), .w = std::cos(*yaw_rad / 2)};
}

bus::PoseStamped local_pose(bus::Point place, std::optional<double> yaw_rad) {
  return {.header = header_now("map"), .pose = {.position = place, .orientation = orientation_of(yaw_rad)}};
}

base::Result<std::unique_ptr<FlightHand>> FlightHand::open(bus::Bus& bus, FlightHeard const& heard, base::Logger log) {
  std::unique_ptr<FlightHand> hand(new FlightHand(heard, std::move(log)));
  if (auto const opened = hand->open_ends(bus); !opened) return std::unexpected(opened.error());
  return hand;
}

base::Result<> FlightHand::open_ends(bus::Bus& bus) {
  bus::Ends ends(bus);
  auto const note = [this](std::string_view what, bool is_done) {
    if (!is_done) log_.debug(fmt::format("{} was not carried out", what));  // its reasons the bridge has
  };
  ends.ask<mavros::CommandBool>(arming_, names::arming, [note](auto, auto const& r) { note("arming", r.success); });
  ends.ask<mavros::CommandLong>(commands_, names::command, [note](auto, auto const& r) { note("Kill", r.success); });
  ends.ask<mavros::CommandTOL>(takeoff_, names::takeoff,
                               [note](auto, auto const& r) { note("taking off", r.success); });
  ends.ask<mavros::SetMode>(modes_, names::set_mode, [note](auto, auto const& r) { note("a mode", r.mode_sent); });
  ends.ask<mavros::ParamSetV2>(parameters_, names::set_parameter,
                               [note](auto, auto const& r) { note("the RTL altitude", r.success); });
  ends.say(local_setpoints_, names::local_setpoint, Profile::standard);
  ends.say(global_setpoints_, names::global_setpoint, Profile::standard);
  return ends.result();
}

void FlightHand::ask(autonomy::Request const& request) {
  std::visit([this](auto const& wanted) { ask_for(wanted); }, request);
}

void FlightHand::ask_for(request::Mode const& wanted) {
  modes_->call({.custom_mode = std::string(wanted.mode)});
}

void FlightHand::ask_for(request::Arm const& wanted) {
  if (!wanted.is_to_arm && wanted.by_force)
    commands_->call({.command = component_arm_disarm, .param1 = 0.0F, .param2 = by_force});
  else
    arming_->call({.value = wanted.is_to_arm});
}

void FlightHand::ask_for(request::Takeoff const& wanted) {
  takeoff_->call({.altitude = static_cast<float>(wanted.height_m)});
}

void FlightHand::ask_for(request::ReturnAltitude const& wanted) {
  bus::ParameterValue value{.type = bus::ParameterValue::integer,
                            .integer_value = std::llround(wanted.height_m * cm_per_m)};
  parameters_->call({.param_id = return_altitude, .value = std::move(value)});
}

void FlightHand::ask_for(request::LocalSetpoint const& wanted) {
  if (auto const place = heard_.in_local_frame(wanted.place))
    local_setpoints_->publish(local_pose(*place, wanted.yaw_rad));
}

void FlightHand::ask_for(request::GlobalSetpoint const& wanted) {
  if (!heard_.home.message) return;
  bus::GeoPoseStamped pose{.header = header_now("map")};
  pose.pose.position = {.latitude = wanted.place.lat_deg(),
                        .longitude = wanted.place.lon_deg(),
                        .altitude = heard_.home.message->geo.altitude + wanted.height_m};
  pose.pose.orientation = orientation_of(wanted.yaw_rad);
  global_setpoints_->publish(pose);
}

}  // namespace lapwing::onboard
