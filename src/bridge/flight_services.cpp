#include "bridge/flight_services.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "base/wall_clock.hpp"
#include "bus/messages/mavros_names.hpp"
#include "mavlink/exchange/param.hpp"

namespace lapwing::bridge {

namespace names = bus::mavros::names;
namespace mavros = bus::mavros;
using namespace std::chrono_literals;
using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;

namespace {

constexpr base::Duration longest_age = 2s;
/// Who asks asks again after a second.
constexpr base::Duration expiry = 1s;
constexpr base::Duration ack_timeout = 300ms;
constexpr int tries = 3;

/// MAV_RESULT.
std::uint8_t result_of(Result<> const& became) {
  constexpr std::uint8_t accepted = 0;
  constexpr std::uint8_t denied = 2;
  constexpr std::uint8_t failed = 4;
  if (became) return accepted;
  return became.error().kind == ErrorKind::refused ? denied : failed;
}

template <class S>
S::Response answer(Result<> const& became) {
  return {.success = became.has_value(), .result = result_of(became)};
}

std::optional<double> number_of(bus::ParameterValue const& value) {
  if (value.type == bus::ParameterValue::integer) return static_cast<double>(value.integer_value);
  if (value.type == bus::ParameterValue::real) return value.double_value;
  return std::nullopt;
}

bus::ParameterValue value_of(mavlink::Parameter const& parameter) {
  bus::ParameterValue value;
  bool const is_integer = mavlink::is_integer(parameter.type);
  value.type = is_integer ? bus::ParameterValue::integer : bus::ParameterValue::real;
  if (is_integer)
    value.integer_value = std::llround(parameter.value);
  else
    value.double_value = parameter.value;
  return value;
}

}  // namespace

Result<std::unique_ptr<FlightServices>> FlightServices::open(bus::Bus& bus, mavlink::Connection& connection,
                                                             FlightController const& flight, base::Logger log) {
  std::unique_ptr<FlightServices> services(new FlightServices(connection, flight, std::move(log)));
  if (auto const opened = services->open_ends(bus); !opened) return std::unexpected(opened.error());
  return services;
}

FlightServices::FlightServices(mavlink::Connection& connection, FlightController const& flight, base::Logger log)
    : connection_(connection), flight_(flight), log_(std::move(log)), scope_(connection.loop()) {}

Result<> FlightServices::open_ends(bus::Bus& bus) {
  bus::Ends ends(bus);
  auto const serve = [&]<class S>(std::optional<bus::ServiceServer<S>>& server, std::string_view name,
                                  Task<> (FlightServices::*carry_out)(bus::Call<S>)) {
    ends.serve<S>(server, name,
                  [this, carry_out](bus::Call<S> call) { scope_.spawn((this->*carry_out)(std::move(call))); });
  };
  serve(arming_, names::arming, &FlightServices::arm);
  serve(takeoff_, names::takeoff, &FlightServices::take_off);
  serve(commands_, names::command, &FlightServices::command);
  serve(modes_, names::set_mode, &FlightServices::set_mode);
  serve(parameters_, names::set_parameter, &FlightServices::set_parameter);
  return ends.result();
}

Result<> FlightServices::is_fresh(base::UtcTime asked) const {
  auto const age = base::wall_now() - asked;
  if (age > longest_age)
    return fail(ErrorKind::refused, fmt::format("it was asked {:.1f} s ago", base::to_seconds(age)));
  if (!flight_.is_connected(connection_.loop().now())) return fail(ErrorKind::lost, "no flight controller is heard");
  return {};
}

void FlightServices::note(std::string const& what, Result<> const& became) const {
  if (became)
    log_.info(fmt::format("{}: accepted", what));
  else
    log_.warn(fmt::format("{}: {}", what, became.error().message));
}

Task<Result<>> FlightServices::ask(std::string what, base::UtcTime asked, mavlink::Command command, bool is_urgent) {
  auto became = is_fresh(asked);
  if (became) {
    mavlink::CommandOptions const options{
        .tries = tries, .ack_timeout = ack_timeout, .expiry = expiry, .is_urgent = is_urgent};
    auto sent = mavlink::run_command(connection_, flight_.address, command, options);
    became = co_await sent;
  }
  note(what, became);
  co_return became;
}

Task<> FlightServices::arm(bus::Call<mavros::CommandBool> call) {
  bool const arms = call.request.value;
  auto asking = ask(arms ? "arm" : "disarm", call.asked, arms ? mavlink::arm() : mavlink::disarm(), !arms);
  auto const became = co_await asking;
  call.reply(answer<mavros::CommandBool>(became));
}

Task<> FlightServices::take_off(bus::Call<mavros::CommandTOL> call) {
  auto const& request = call.request;
  auto command = mavlink::take_off(request.altitude);
  command.params = {request.min_pitch, 0, 0, request.yaw, request.latitude, request.longitude, request.altitude};
  auto asking = ask(fmt::format("take off to {:.1f} m", request.altitude), call.asked, command, false);
  auto const became = co_await asking;
  call.reply(answer<mavros::CommandTOL>(became));
}

Task<> FlightServices::command(bus::Call<mavros::CommandLong> call) {
  auto const& request = call.request;
  mavlink::Command const command{
      static_cast<mavlink::MavCmd>(request.command),
      {request.param1, request.param2, request.param3, request.param4, request.param5, request.param6, request.param7}};
  bool const disarms = command.id == mavlink::MavCmd::component_arm_disarm && request.param1 == 0.0F;
  auto asking = ask(fmt::format("command {}", request.command), call.asked, command, disarms);
  auto const became = co_await asking;
  call.reply(answer<mavros::CommandLong>(became));
}

Task<> FlightServices::set_mode(bus::Call<mavros::SetMode> call) {
  auto const& name = call.request.custom_mode;
  auto const number = flight_.mode_number(name);
  if (!number) {
    note(fmt::format("mode {}", base::printable(name)),
         fail(ErrorKind::invalid_input,
              flight_.heartbeat ? "the autopilot has no such mode" : "no flight controller is heard"));
    call.reply({.mode_sent = false});
    co_return;
  }
  auto asking =
      ask(fmt::format("mode {}", name), call.asked, mavlink::set_mode(flight_.heartbeat->autopilot, *number), false);
  auto const became = co_await asking;
  call.reply({.mode_sent = became.has_value()});
}

Task<> FlightServices::set_parameter(bus::Call<mavros::ParamSetV2> call) {
  auto const& name = call.request.param_id;
  auto const wanted = number_of(call.request.value);
  auto became = is_fresh(call.asked);
  if (became && (!wanted || name.empty() || name.size() > mavlink::longest_param_name))
    became = fail(ErrorKind::invalid_input, "a parameter has a name of 1 to 16 letters and a number");
  bus::ParameterValue value;
  if (became) {
    auto setting = mavlink::set_param(connection_, flight_.address, name, *wanted);
    auto const set = co_await setting;
    if (set)
      value = value_of(set->after);
    else
      became = std::unexpected(set.error());
  }
  note(fmt::format("parameter {} = {}", base::printable(name), wanted.value_or(0.0)), became);
  call.reply({.success = became.has_value(), .value = value});
}

}  // namespace lapwing::bridge
