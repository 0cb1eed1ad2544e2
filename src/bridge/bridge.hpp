#pragma once

#include <cstdint>
#include <memory>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "bridge/flight_controller.hpp"
#include "bridge/flight_services.hpp"
#include "bridge/flight_topics.hpp"
#include "bridge/streams.hpp"
#include "link/url.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::bridge {

struct BridgeOptions {
  link::Url link{};
  std::uint8_t system_id = 1;  ///< of the flight controller
  /// How far mean sea level lies above the ellipsoid where it flies. ROS has altitudes above the ellipsoid, MAVLink
  /// above the sea; zero leaves them as MAVLink has them.
  double geoid_m = 0.0;
};

/// Between a MAVLink flight controller and the bus, where it looks as MAVROS makes it look (docs/reference/onboard.md).
/// It decides nothing and remembers no wish: what was asked before it began is not carried out.
class Bridge {
 public:
  /// `bus` outlives it. Errors: those of the link and of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<Bridge>> open(base::Loop& loop, bus::Bus& bus,
                                                                  BridgeOptions const& options, base::Logger log);
  Bridge(Bridge const&) = delete;
  Bridge& operator=(Bridge const&) = delete;

 private:
  Bridge(base::Loop& loop, BridgeOptions const& options, base::Logger log);
  base::Result<> open_ends(bus::Bus& bus);
  void take(mavlink::Received const& received);
  void note(mavlink::Message const& message, base::TimePoint at);
  void note(mavlink::Heartbeat const& heartbeat, base::TimePoint at);
  base::Task<> watch();
  void steer(base::Result<mavlink::SetPositionTargetGlobalInt> setpoint);

  base::Loop& loop_;
  BridgeOptions options_;
  base::Logger log_;
  FlightController flight_;
  mavlink::Connection connection_;
  Streams streams_;
  mavlink::Subscription heard_;
  std::unique_ptr<FlightTopics> topics_;
  std::unique_ptr<FlightServices> services_;
  bus::Subscriptions setpoints_;
  bool was_connected_ = false;
  bool has_told_of_setpoints_ = false;  ///< that one was refused; until one was passed on
  base::Scope scope_;
};

}  // namespace lapwing::bridge
