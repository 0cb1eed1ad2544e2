#pragma once

#include <memory>

#include "base/async/loop.hpp"
#include "base/clock_offset.hpp"
#include "bridge/flight_controller.hpp"
#include "bus/messages/mavros.hpp"
#include "bus/messages/sensors.hpp"
#include "bus/participant/ends.hpp"

namespace lapwing::bridge {

/// What the flight controller says, on the bus. Places and poses are stamped with when they were measured, as far as
/// messages that were not held up on their way tell how its clock lies to ours. All are reliable, so that readers of
/// either sort hear them; state and home are latched.
class FlightTopics {
 public:
  /// `flight` outlives it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<FlightTopics>> open(base::Loop& loop, bus::Bus& bus,
                                                                        FlightController const& flight, double geoid_m);

  /// What `flight` knows has been brought up to date with the message already.
  void tell(mavlink::Message const& message);
  void tell_state();

 private:
  FlightTopics(base::Loop& loop, FlightController const& flight, double geoid_m)
      : loop_(loop), flight_(flight), geoid_m_(geoid_m) {}
  void tell_position(mavlink::GlobalPosition const& position);
  void tell_pose(mavlink::LocalPosition const& position);
  void tell_home(mavlink::HomePosition const& home);
  void tell_health(mavlink::SysStatus const& status);
  [[nodiscard]] bus::Header header(std::string frame = {}) const;
  /// Of what was measured then, by the flight controller's clock.
  [[nodiscard]] bus::Header header_of(mavlink::Duration since_boot, std::string frame);

  base::Loop& loop_;
  FlightController const& flight_;
  double geoid_m_;
  base::ClockOffset clock_;
  std::optional<mavlink::HomePosition> home_without_origin_;  ///< waits for what its place is told by
  std::optional<bus::Publisher<bus::mavros::State>> state_;
  std::optional<bus::Publisher<bus::mavros::SysStatus>> system_status_;
  std::optional<bus::Publisher<bus::BatteryState>> battery_;
  std::optional<bus::Publisher<bus::NavSatFix>> position_;
  std::optional<bus::Publisher<bus::Float64>> relative_altitude_;
  std::optional<bus::Publisher<bus::PoseStamped>> pose_;
  std::optional<bus::Publisher<bus::mavros::HomePosition>> home_;
  std::optional<bus::Publisher<bus::mavros::StatusText>> texts_;
};

}  // namespace lapwing::bridge
