#pragma once

#include <deque>
#include <optional>

#include "base/time.hpp"
#include "vehicle/endurance.hpp"

namespace lapwing::autonomy {

/// Learns what flying draws by how fast the charge falls in this flight: the mean of the last minutes, and how far the
/// parts of them differ. Charges come as whole percents, so that what counts is when each one less was reached.
class FlightDrain {
 public:
  /// Nothing before it is known; on the ground, and as a flight begins, what the flight before drew.
  std::optional<vehicle::Drain> add(std::optional<double> charge, bool is_flying, base::TimePoint now);

 private:
  struct Step {
    double charge;
    base::TimePoint reached;
  };
  void begin_flight(double charge);
  void take(double charge, base::TimePoint now);
  void learn(base::TimePoint now);

  bool was_flying_ = false;
  double lowest_ = 1.0;  ///< charge of this flight
  std::deque<Step> steps_;
  std::optional<vehicle::Drain> drain_;
};

}  // namespace lapwing::autonomy
