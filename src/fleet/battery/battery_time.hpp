#pragma once

#include <deque>
#include <optional>

#include "base/time.hpp"
#include "fleet/battery/battery_capacity.hpp"
#include "vehicle/energy/endurance.hpp"

namespace lapwing::fleet {

/// What a vehicle tells of one battery, and what it does meanwhile.
struct BatteryReport {
  double remaining = 0.0;  ///< 0..1
  std::optional<double> current_a = {};
  std::optional<double> drawn_ah = {};
  bool is_working = false;        ///< in the air; on the move, for what does not fly
  bool is_level = true;           ///< neither climbs nor sinks
  bool counts_from_full = false;  ///< its percents are what it has drawn of a full battery
};

struct BatteryEstimate {
  std::optional<vehicle::Endurance> now = {};        ///< at what it does now; nothing while it rests
  std::optional<vehicle::Endurance> in_flight = {};  ///< the same in flight, while it rests by the flight before
};

/// Estimates how long a battery lasts, for vehicles that do not say it themselves (ArduPilot), from what this activity
/// draws: what was drawn while the vehicle stood says nothing about a flight.
///
/// By the current, where it is told, over the last half minute; a climb or a descent counts for little, since neither
/// goes on. The capacity is inferred. Else by how fast the percents fall in this flight. A flight begins with what the
/// last one drew, and is soon known better.
class BatteryTime {
 public:
  BatteryEstimate add(BatteryReport const& report, base::TimePoint now);

 private:
  /// The mean of the last half minute of flight, level flight foremost.
  struct Current {
    double mean_a = 0.0;
    double squares = 0.0;   ///< weighted, of what differed from the mean
    double weight_s = 0.0;  ///< seconds of level flight that it stands for
    double level_s = 0.0;   ///< of these, what was level flight
  };
  struct Level {
    double remaining;
    base::TimePoint reached;
  };

  void begin_battery();
  void begin_flight();
  void count_drawn(BatteryReport const& report, double past_s);
  void take_current(double current_a, double past_s, bool is_level);
  void take_level(double remaining, base::TimePoint now);
  [[nodiscard]] std::optional<vehicle::Drain> by_current() const;

  bool was_working_ = false;
  std::optional<base::TimePoint> last_;
  double remaining_ = 1.0;
  BatteryCapacity capacity_;
  bool tells_drawn_ = false;
  double drawn_ah_ = 0.0;  ///< by our own account, where the vehicle keeps none
  Current current_;
  std::optional<double> lowest_;  ///< of this flight
  std::deque<Level> levels_;      ///< of this flight, falling, newest last
  std::optional<vehicle::Drain> by_levels_;
};

}  // namespace lapwing::fleet
