#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/async/task.hpp"
#include "base/log.hpp"
#include "fleet/alarms/conditions.hpp"
#include "fleet/alarms/roll_call.hpp"
#include "vehicle/alarm.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::fleet {

/// Raises an alarm for every condition of every vehicle in the registry, and clears it when that is over. Looks at once
/// when a vehicle falls silent, is lost or returns, else four times a second. Thread-bound.
///
/// An alarm keeps its first words; where they are news (another failsafe, another mode) it is another alarm, which
/// nobody has acknowledged yet.
class Alarms final : public vehicle::VehicleAlarms {
 public:
  /// Loop and registry outlive this.
  Alarms(base::Loop& loop, vehicle::Registry const& registry, vehicle::BatteryLimits limits, base::Logger log);
  Alarms(Alarms const&) = delete;
  Alarms& operator=(Alarms const&) = delete;

  [[nodiscard]] std::vector<vehicle::Alarm> const& alarms() const override { return alarms_; }
  std::size_t acknowledge(std::span<std::uint64_t const> numbers, vehicle::Commander by) override;
  [[nodiscard]] vehicle::BatteryLimits battery_limits() const override { return limits_; }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

 private:
  /// One vehicle between two looks.
  struct Watched {
    std::vector<vehicle::Alarm> alarms;
    bool had_commander = false;
    std::optional<base::TimePoint> left_at;
  };

  base::Task<> watch();
  /// Whether anything has changed.
  [[nodiscard]] bool look_at(vehicle::VehicleState const& state, Watched& watched);
  void note_commander(vehicle::VehicleState const& state, Watched& watched) const;
  [[nodiscard]] vehicle::Alarm raised(vehicle::VehicleState const& state, Condition condition);
  void say_ended(vehicle::VehicleState const& state, vehicle::Alarm const& alarm);
  void publish();

  base::Loop& loop_;
  vehicle::Registry const& registry_;
  vehicle::BatteryLimits limits_;
  base::Logger log_;
  RollCall roll_call_;
  std::map<vehicle::VehicleId, Watched> watched_;
  std::vector<vehicle::Alarm> alarms_;  ///< those of all, for who asks
  std::uint64_t last_number_ = 0;
  std::uint64_t revision_ = 0;
  base::Task<> watch_;
};

}  // namespace lapwing::fleet
