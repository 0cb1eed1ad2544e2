#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "vehicle/control.hpp"
#include "vehicle/vehicle_id.hpp"

/// What an operator must be told about a vehicle without having looked: as data, so that every viewer, the log and
/// whoever asks over HTTP are told the same.
namespace lapwing::vehicle {

enum class AlarmKind {
  silent,  ///< nothing has come from it for some seconds
  lost,    ///< for so long that it counts as lost
  conflict,
  battery_low,
  battery_critical,
  failsafe,      ///< it acts by itself
  fence,         ///< it is beyond its fence
  foreign_mode,  ///< its pilot or another station has changed its mode
  left_armed,    ///< it stands armed, and nobody commands it any more
};
[[nodiscard]] std::string_view to_string(AlarmKind kind);
/// What is true of several vehicles with it: "silent", "beyond their fence".
[[nodiscard]] std::string_view words_for_many(AlarmKind kind);

enum class Severity { warning, critical };
[[nodiscard]] std::string_view to_string(Severity severity);

struct Alarm {
  std::uint64_t number = 0;  ///< never used again
  AlarmKind kind = AlarmKind::silent;
  Severity severity = Severity::warning;
  VehicleId vehicle;
  std::string name = {};    ///< the vehicle's
  std::string words = {};   ///< a whole line: "copter 1 silent, last known in the air at 20 m"
  base::TimePoint since{};  ///< of a silence: when it was last heard
  base::UtcTime raised{};
  std::string acknowledged_by = {};  ///< empty: by nobody
};

/// Below which charge a battery counts as low even if its vehicle does not call it so, 0..1.
struct BatteryLimits {
  double low = 0.3;
  double critical = 0.15;
};

/// The alarms that stand. One goes when its reason is gone; acknowledged, it stands quietly until then. Implemented by
/// a platform. Thread-bound.
class VehicleAlarms {
 public:
  virtual ~VehicleAlarms() = default;

  /// Oldest first.
  [[nodiscard]] virtual std::vector<Alarm> const& alarms() const = 0;
  /// Those of these numbers that stand and nobody has acknowledged. Gives how many there were.
  virtual std::size_t acknowledge(std::span<std::uint64_t const> numbers, Commander by) = 0;
  [[nodiscard]] virtual BatteryLimits battery_limits() const = 0;
  /// Grows with every change of `alarms`.
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
};

}  // namespace lapwing::vehicle
