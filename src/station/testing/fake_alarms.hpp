#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "vehicle/alarm.hpp"

namespace lapwing::station::testing {

/// Alarms that stand because somebody said so.
class FakeAlarms : public vehicle::VehicleAlarms {
 public:
  void raise(vehicle::AlarmKind kind, std::string const& id, base::TimePoint since) {
    list.push_back({.number = ++last_number_,
                    .kind = kind,
                    .vehicle = {id},
                    .name = "vehicle " + id,
                    .words = "vehicle " + id + " " + std::string(vehicle::words_for_many(kind)),
                    .since = since});
    ++revision_;
  }
  void clear(vehicle::AlarmKind kind, std::string const& id) {
    auto const count = std::erase_if(
        list, [&](vehicle::Alarm const& alarm) { return alarm.kind == kind && alarm.vehicle.text == id; });
    if (count > 0) ++revision_;
  }

  [[nodiscard]] std::vector<vehicle::Alarm> const& alarms() const override { return list; }
  std::size_t acknowledge(std::span<std::uint64_t const> numbers, vehicle::Commander by) override {
    std::size_t count = 0;
    for (auto& alarm : list) {
      if (std::ranges::find(numbers, alarm.number) == numbers.end()) continue;
      alarm.acknowledged_by = by;
      ++count;
    }
    ++revision_;
    return count;
  }
  [[nodiscard]] vehicle::BatteryLimits battery_limits() const override { return {}; }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

  std::vector<vehicle::Alarm> list;

 private:
  std::uint64_t last_number_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace lapwing::station::testing
