#pragma once

#include <limits>
#include <optional>

namespace lapwing::fleet {

/// Infers what a battery holds from what was drawn of it while its percents fell: autopilots tell both, and not the
/// capacity.
///
/// A percent is a step of one hundredth, and whether it is rounded or cut off nobody tells. So what counts is how much
/// was drawn between two of its steps; and, where the vehicle reckons its percents from what it has drawn of a full
/// battery (ArduPilot), within which bounds a capacity explains every report.
class BatteryCapacity {
 public:
  struct Value {
    double ah = 0.0;
    double error = 0.0;  ///< share of `ah` by which it may be wrong
  };

  /// Takes a report: what is left, 0..1, and what has been drawn. More left or less drawn than before is another
  /// battery.
  void add(double remaining, double drawn_ah, bool counts_from_full);
  void forget() { *this = {}; }
  /// Nothing before it is known to a third.
  [[nodiscard]] std::optional<Value> value() const;

 private:
  struct Bounds {
    double low = 0.0;
    double high = std::numeric_limits<double>::infinity();
  };
  /// When the percents came down to this.
  struct Step {
    int percent = 0;
    double drawn_before_ah = 0.0;
    double drawn_after_ah = 0.0;
  };
  [[nodiscard]] Bounds by_steps() const;

  std::optional<int> lowest_percent_;
  double drawn_ah_ = 0.0;
  std::optional<Step> first_;
  std::optional<Step> latest_;
  Bounds from_full_;
};

}  // namespace lapwing::fleet
