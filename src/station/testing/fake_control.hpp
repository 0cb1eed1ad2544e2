#pragma once

#include <string>
#include <vector>

#include "vehicle/control.hpp"

namespace lapwing::station::testing {

/// Remembers what it was asked; commands nothing.
class FakeControl : public vehicle::VehicleControl {
 public:
  [[nodiscard]] bool has(vehicle::VehicleId const&) const override { return true; }
  base::Result<std::uint64_t> command(vehicle::VehicleCommand command, std::span<vehicle::VehicleId const> vehicles,
                                      vehicle::Commander by, bool takes_over) override {
    if (refusal) return std::unexpected(*refusal);
    vehicle::CommandRecord record{.number = records.size() + 1, .command = std::move(command), .by = std::move(by)};
    for (auto const& id : vehicles) record.outcomes.push_back({.vehicle = id});
    records.push_back(std::move(record));
    took_over = takes_over;
    ++changes;
    return records.back().number;
  }
  [[nodiscard]] std::deque<vehicle::CommandRecord> const& commands() const override { return records; }
  void emergency_stop(std::optional<vehicle::StopAction> action, vehicle::Commander by) override {
    stop = {.is_latched = true, .action = action.value_or(vehicle::StopAction::hold), .by = std::move(by)};
    ++changes;
  }
  void release_emergency_stop(vehicle::Commander by) override {
    stop.is_latched = false;
    stop.by = std::move(by);
    ++changes;
  }
  [[nodiscard]] vehicle::EmergencyStop const& emergency() const override { return stop; }
  base::Result<> request_control(vehicle::VehicleId const& id, vehicle::Commander by) override {
    return note("request " + id.text + " by " + by);
  }
  base::Result<> yield_control(vehicle::VehicleId const& id, vehicle::Commander by) override {
    return note("yield " + id.text + " by " + by);
  }
  base::Result<> keep_control(vehicle::VehicleId const& id, vehicle::Commander by) override {
    return note("keep " + id.text + " by " + by);
  }
  void forget(vehicle::Commander const& by) override { said.push_back("forget " + by); }
  [[nodiscard]] std::uint64_t revision() const override { return changes; }

  std::deque<vehicle::CommandRecord> records;
  vehicle::EmergencyStop stop;
  std::vector<std::string> said;
  std::optional<base::Error> refusal;
  bool took_over = false;
  std::uint64_t changes = 0;

 private:
  base::Result<> note(std::string what) {
    said.push_back(std::move(what));
    if (refusal) return std::unexpected(*refusal);
    return {};
  }
};

}  // namespace lapwing::station::testing
