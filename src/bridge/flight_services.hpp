#pragma once

#include <memory>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "bridge/flight_controller.hpp"
#include "bus/messages/mavros_services.hpp"
#include "bus/participant/ends.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/exchange/command.hpp"

namespace lapwing::bridge {

/// What programs on the bus ask of the flight controller. A request is answered when the flight controller has
/// answered; one that is older than two seconds is refused, for it was asked in another situation.
class FlightServices {
 public:
  /// `connection` and `flight` outlive it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<FlightServices>> open(bus::Bus& bus,
                                                                          mavlink::Connection& connection,
                                                                          FlightController const& flight,
                                                                          base::Logger log);
  FlightServices(FlightServices const&) = delete;
  FlightServices& operator=(FlightServices const&) = delete;

 private:
  FlightServices(mavlink::Connection& connection, FlightController const& flight, base::Logger log);
  base::Result<> open_ends(bus::Bus& bus);

  base::Task<> arm(bus::Call<bus::mavros::CommandBool> call);
  base::Task<> take_off(bus::Call<bus::mavros::CommandTOL> call);
  base::Task<> command(bus::Call<bus::mavros::CommandLong> call);
  base::Task<> set_mode(bus::Call<bus::mavros::SetMode> call);
  base::Task<> set_parameter(bus::Call<bus::mavros::ParamSetV2> call);
  /// What became of it, for `what`.
  base::Task<base::Result<>> ask(std::string what, base::UtcTime asked, mavlink::Command command, bool is_urgent);
  [[nodiscard]] base::Result<> is_fresh(base::UtcTime asked) const;
  void note(std::string const& what, base::Result<> const& became) const;

  mavlink::Connection& connection_;
  FlightController const& flight_;
  base::Logger log_;
  std::optional<bus::ServiceServer<bus::mavros::CommandBool>> arming_;
  std::optional<bus::ServiceServer<bus::mavros::CommandTOL>> takeoff_;
  std::optional<bus::ServiceServer<bus::mavros::CommandLong>> commands_;
  std::optional<bus::ServiceServer<bus::mavros::SetMode>> modes_;
  std::optional<bus::ServiceServer<bus::mavros::ParamSetV2>> parameters_;
  base::Scope scope_;
};

}  // namespace lapwing::bridge
