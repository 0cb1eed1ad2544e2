#pragma once

#include <deque>
#include <optional>

#include "base/time.hpp"
#include "vehicle/energy/endurance.hpp"

namespace lapwing::vehicle {

/// Learns what a vehicle draws under way, a flight or a drive, by how fast its charge falls: the mean of the last
/// minutes, and how far the parts of them differ. Charges come as whole percents, so that what counts is when each one
/// less was reached.
class DrainMeter {
 public:
  /// Nothing before it is known; when it stands, and as it sets out, what it drew the time before.
  std::optional<Drain> add(std::optional<double> charge, bool is_under_way, base::TimePoint now);

 private:
  struct Step {
    double charge;
    base::TimePoint reached;
  };
  void set_out(double charge);
  void take(double charge, base::TimePoint now);
  void learn(base::TimePoint now);

  bool was_under_way_ = false;
  double lowest_ = 1.0;  ///< charge since it set out
  std::deque<Step> steps_;
  std::optional<Drain> drain_;
};

}  // namespace lapwing::vehicle
