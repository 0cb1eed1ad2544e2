#pragma once

#include <deque>
#include <optional>

#include "base/time.hpp"

namespace lapwing::fleet {

/// Estimates how long a battery lasts, for vehicles that do not say it themselves (ArduPilot).
///
/// The share that is left over the speed at which it fell during the last 5 %. That needs neither capacity nor current,
/// and follows the flight: a minute or so after a climb or a landing it has forgotten what was before. When nothing
/// falls for longer than one more step should have taken, the speed is taken to be that much lower.
class BatteryTime {
 public:
  /// Takes a report, 0..1. Nothing until the charge has fallen by 3 %; a fuller battery begins anew.
  std::optional<base::Duration> add(double remaining, base::TimePoint now);

 private:
  struct Level {
    double remaining;
    base::TimePoint reached;
  };
  std::deque<Level> levels_;  ///< falling, newest last
};

}  // namespace lapwing::fleet
