#include "bridge/bridge.hpp"

#include <utility>

#include <fmt/format.h>

#include "bridge/setpoints.hpp"
#include "bus/messages/mavros_names.hpp"

namespace lapwing::bridge {

namespace names = bus::mavros::names;
using namespace std::chrono_literals;
using bus::Profile;

namespace {

/// The companion computer of the vehicle, as MAV_COMPONENT has it.
constexpr std::uint8_t companion = 191;

mavlink::Heartbeat companion_heartbeat() {
  return {.type = mavlink::MavType::onboard_controller,
          .autopilot = mavlink::MavAutopilot::invalid,
          .system_status = mavlink::MavState::active};
}

std::optional<mavlink::MessageId> id_of(mavlink::Message const& message) {
  using Id = mavlink::MessageId;
  if (std::holds_alternative<mavlink::Attitude>(message)) return Id::attitude;
  if (std::holds_alternative<mavlink::GlobalPosition>(message)) return Id::global_position_int;
  if (std::holds_alternative<mavlink::LocalPosition>(message)) return Id::local_position_ned;
  if (std::holds_alternative<mavlink::SysStatus>(message)) return Id::sys_status;
  if (std::holds_alternative<mavlink::GpsRaw>(message)) return Id::gps_raw_int;
  if (std::holds_alternative<mavlink::GpsGlobalOrigin>(message)) return Id::gps_global_origin;
  if (std::holds_alternative<mavlink::HomePosition>(message)) return Id::home_position;
  return std::nullopt;
}

}  // namespace

base::Result<std::unique_ptr<Bridge>> Bridge::open(base::Loop& loop, bus::Bus& bus, BridgeOptions const& options,
                                                   base::Logger log) {
  std::unique_ptr<Bridge> bridge(new Bridge(loop, options, std::move(log)));
  if (auto const opened = bridge->open_ends(bus); !opened) return std::unexpected(opened.error());
  return bridge;
}

Bridge::Bridge(base::Loop& loop, BridgeOptions const& options, base::Logger log)
    : loop_(loop),
      options_(options),
      log_(std::move(log)),
      flight_{.address = {options.system_id, mavlink::autopilot_component}},
      connection_(loop, {.self = {options.system_id, companion}, .heartbeat = companion_heartbeat}, log_),
      streams_(connection_, flight_),
      scope_(loop) {}

base::Result<> Bridge::open_ends(bus::Bus& bus) {
  auto link = link::open(loop_, options_.link);
  if (!link) return std::unexpected(link.error());
  auto topics = FlightTopics::open(loop_, bus, flight_, options_.geoid_m);
  if (!topics) return std::unexpected(topics.error());
  auto services = FlightServices::open(bus, connection_, flight_, log_);
  if (!services) return std::unexpected(services.error());
  bus::Ends ends(bus);
  ends.hear<bus::PoseStamped>(
      setpoints_, names::local_setpoint, Profile::sensor_data, [this](bus::PoseStamped const& wanted) {
        if (flight_.origin)
          steer(setpoint_of(wanted, *flight_.origin));
        else
          steer(base::fail(base::ErrorKind::not_found, "the flight controller has not told its origin yet"));
      });
  ends.hear<bus::GeoPoseStamped>(
      setpoints_, names::global_setpoint, Profile::sensor_data,
      [this](bus::GeoPoseStamped const& wanted) { steer(setpoint_of(wanted, options_.geoid_m)); });
  if (auto const opened = ends.result(); !opened) return opened;
  topics_ = *std::move(topics);
  services_ = *std::move(services);
  heard_ = connection_.subscribe(options_.system_id, [this](mavlink::Received const& received) { take(received); });
  connection_.add_link(*std::move(link));
  scope_.spawn(watch());
  return {};
}

void Bridge::note(mavlink::Heartbeat const& heartbeat, base::TimePoint at) {
  auto const before = flight_.heartbeat;
  auto const mode_before = flight_.mode();
  flight_.heartbeat = heartbeat;
  flight_.heard = at;
  if (!std::exchange(was_connected_, true))
    log_.info(fmt::format("flight controller {} is heard, mode {}{}", options_.system_id, flight_.mode(),
                          heartbeat.armed() ? ", armed" : ""));
  else if (before && before->armed() != heartbeat.armed())
    log_.info(heartbeat.armed() ? "it is armed" : "it is disarmed");
  if (before && flight_.mode() != mode_before) log_.info(fmt::format("it is in mode {}", flight_.mode()));
}

void Bridge::note(mavlink::Message const& message, base::TimePoint at) {
  if (auto const* const heartbeat = std::get_if<mavlink::Heartbeat>(&message)) note(*heartbeat, at);
  if (auto const* const gps = std::get_if<mavlink::GpsRaw>(&message)) flight_.gps = *gps;
  if (auto const* const attitude = std::get_if<mavlink::Attitude>(&message)) flight_.attitude = *attitude;
  if (auto const* const origin = std::get_if<mavlink::GpsGlobalOrigin>(&message))
    if (origin->position) flight_.origin = origin->position;
}

void Bridge::take(mavlink::Received const& received) {
  if (received.source != flight_.address) return;
  if (auto const id = id_of(received.message)) streams_.heard(*id, received.at);
  note(received.message, received.at);
  topics_->tell(received.message);
}

base::Task<> Bridge::watch() {
  for (;;) {
    co_await loop_.sleep(500ms);
    if (!was_connected_ || flight_.is_connected(loop_.now())) continue;
    was_connected_ = false;
    log_.warn(fmt::format("flight controller {} is not heard any more", options_.system_id));
    topics_->tell_state();
  }
}

void Bridge::steer(base::Result<mavlink::SetPositionTargetGlobalInt> setpoint) {
  auto const passed_on = setpoint ? connection_.send(flight_.address, *setpoint) : std::unexpected(setpoint.error());
  if (passed_on) has_told_of_setpoints_ = false;
  if (!passed_on && !std::exchange(has_told_of_setpoints_, true))
    log_.warn(fmt::format("setpoints are not passed on: {}", passed_on.error().message));
}

}  // namespace lapwing::bridge
