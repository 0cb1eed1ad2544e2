#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "vehicle/control.hpp"

namespace lapwing::vehicle::testing {

/// An operator's side of a platform whose vehicles obey at once; keeps what it was told.
class RecordingControl final : public VehicleControl {
 public:
  RecordingControl(std::vector<std::string> vehicles, std::uint64_t first_number)
      : last_number_(first_number - 1), vehicles_(std::move(vehicles)) {}

  [[nodiscard]] bool has(VehicleId const& id) const override {
    return std::ranges::find(vehicles_, id.text) != vehicles_.end();
  }
  base::Result<std::uint64_t> command(VehicleCommand command, std::span<VehicleId const> vehicles, Commander by,
                                      bool /*takes_over*/) override {
    if (refusal) return std::unexpected(*refusal);
    CommandRecord record{.number = ++last_number_, .command = std::move(command), .by = std::move(by)};
    for (auto const& id : vehicles)
      record.outcomes.push_back({id, has(id) ? CommandState::confirmed : CommandState::refused, "", {}});
    records_.push_back(std::move(record));
    ++changes_;
    return last_number_;
  }
  [[nodiscard]] std::deque<CommandRecord> const& commands() const override { return records_; }
  void emergency_stop(std::optional<StopAction> action, Commander by) override {
    stop_ = {.is_latched = true, .action = action.value_or(StopAction::hold), .by = std::move(by)};
    for (auto const& id : vehicles_) stop_.vehicles.push_back({.vehicle = {id}, .is_confirmed = true});
    ++changes_;
  }
  void release_emergency_stop(Commander by) override {
    stop_.is_latched = false;
    said.push_back("released by " + by);
    ++changes_;
  }
  [[nodiscard]] EmergencyStop const& emergency() const override { return stop_; }
  base::Result<> request_control(VehicleId const& id, Commander by) override { return note("request", id, by); }
  base::Result<> yield_control(VehicleId const& id, Commander by) override { return note("yield", id, by); }
  base::Result<> keep_control(VehicleId const& id, Commander by) override { return note("keep", id, by); }
  void forget(Commander const& by) override { said.push_back("forget " + by); }
  [[nodiscard]] std::uint64_t revision() const override { return changes_; }

  /// What becomes of the latest command of the vehicle.
  void becomes(std::string const& id, CommandState state) {
    for (auto& outcome : records_.back().outcomes)
      if (outcome.vehicle.text == id) outcome.state = state;
    ++changes_;
  }

  std::vector<std::string> said;
  std::optional<base::Error> refusal;

 private:
  base::Result<> note(std::string const& what, VehicleId const& id, Commander const& by) {
    said.push_back(what + " " + id.text + " by " + by);
    return {};
  }

  std::deque<CommandRecord> records_;
  EmergencyStop stop_;
  std::uint64_t last_number_;
  std::uint64_t changes_ = 0;
  std::vector<std::string> vehicles_;
};

}  // namespace lapwing::vehicle::testing
