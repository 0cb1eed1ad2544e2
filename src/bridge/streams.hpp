#pragma once

#include <map>

#include "base/async/scope.hpp"
#include "bridge/flight_controller.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::bridge {

/// Asks the flight controller for the messages that the bus needs, as long as they do not come: at the start, after it
/// was switched on anew, and when somebody else has turned them off.
class Streams {
 public:
  /// Both outlive it.
  Streams(mavlink::Connection& connection, FlightController const& flight);
  Streams(Streams const&) = delete;
  Streams& operator=(Streams const&) = delete;

  void heard(mavlink::MessageId id, base::TimePoint now) { heard_[id] = now; }

 private:
  base::Task<> keep();

  mavlink::Connection& connection_;
  FlightController const& flight_;
  std::map<mavlink::MessageId, base::TimePoint> heard_;
  base::Scope scope_;
};

}  // namespace lapwing::bridge
