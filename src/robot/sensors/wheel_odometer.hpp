#pragma once

#include <cstdint>
#include <optional>

#include "firmware/board_time.hpp"
#include "firmware/frames/records.hpp"

namespace lapwing::robot {

/// What the wheels did between two readings.
struct WheelStep {
  firmware::Time period{};
  double left_m = 0;
  double right_m = 0;
  double wheel_base_m = 0;

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(period).count(); }
  /// Of the axle's middle, ahead positive.
  [[nodiscard]] double way_m() const { return (left_m + right_m) / 2; }
  [[nodiscard]] double speed_m_s() const { return way_m() / seconds(); }
  [[nodiscard]] double turn_rad() const { return (right_m - left_m) / wheel_base_m; }
  [[nodiscard]] double turn_rad_s() const { return turn_rad() / seconds(); }
  /// No pulse of either wheel.
  [[nodiscard]] bool is_standing() const { return left_m == 0 && right_m == 0; }
};

/// Pulses to way. A step that no wheel can make (twice the top speed) is none: counters that jump are told, not
/// believed.
class WheelOdometer {
 public:
  explicit WheelOdometer(firmware::Description const& description) : body_(description) {}

  struct Step {
    WheelStep wheels;
    bool has_jumped = false;  ///< the pulses were not possible; `wheels` says that nothing moved
  };
  /// None for the first readings, and for readings that are not newer than the last.
  [[nodiscard]] std::optional<Step> feed(firmware::Readings const& readings);

 private:
  firmware::Description body_;
  struct Last {
    firmware::Time time{};
    std::int32_t left = 0;
    std::int32_t right = 0;
  };
  std::optional<Last> last_;
};

}  // namespace lapwing::robot
