#pragma once

#include <memory>
#include <optional>

#include "autonomy/interface/said.hpp"
#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "bus/messages/geographic.hpp"
#include "bus/messages/mavros_services.hpp"
#include "bus/participant/ends.hpp"
#include "onboard/decide/flight_listener.hpp"

namespace lapwing::onboard {

/// Asks the flight controller, over the bus, for what the machine wants. No answer is waited for: whether it was heard
/// shows in the flight controller's state; what is refused the bridge logs.
class FlightHand {
 public:
  /// All outlive it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<FlightHand>> open(bus::Bus& bus, FlightHeard const& heard,
                                                                      base::Logger log);
  FlightHand(FlightHand const&) = delete;
  FlightHand& operator=(FlightHand const&) = delete;

  void ask(autonomy::Request const& request);

 private:
  FlightHand(FlightHeard const& heard, base::Logger log) : heard_(heard), log_(std::move(log)) {}
  base::Result<> open_ends(bus::Bus& bus);
  void ask_for(autonomy::request::Mode const& wanted);
  void ask_for(autonomy::request::Arm const& wanted);
  void ask_for(autonomy::request::Takeoff const& wanted);
  void ask_for(autonomy::request::ReturnAltitude const& wanted);
  void ask_for(autonomy::request::LocalSetpoint const& wanted);
  void ask_for(autonomy::request::GlobalSetpoint const& wanted);

  FlightHeard const& heard_;
  base::Logger log_;
  std::optional<bus::ServiceClient<bus::mavros::CommandBool>> arming_;
  std::optional<bus::ServiceClient<bus::mavros::CommandLong>> commands_;
  std::optional<bus::ServiceClient<bus::mavros::CommandTOL>> takeoff_;
  std::optional<bus::ServiceClient<bus::mavros::SetMode>> modes_;
  std::optional<bus::ServiceClient<bus::mavros::ParamSetV2>> parameters_;
  std::optional<bus::Publisher<bus::PoseStamped>> local_setpoints_;
  std::optional<bus::Publisher<bus::GeoPoseStamped>> global_setpoints_;
};

/// The rotation about the upright axis; zeros, which leave the heading to the flight controller, where there is none.
[[nodiscard]] bus::Quaternion orientation_of(std::optional<double> yaw_rad);
/// Stamped now, in the local frame.
[[nodiscard]] bus::PoseStamped local_pose(bus::Point place, std::optional<double> yaw_rad);

}  // namespace lapwing::onboard
