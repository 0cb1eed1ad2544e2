#pragma once

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "vehicle/control.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::station::testing {

/// Made-up vehicles under command, so that web/e2e can show every state: they acknowledge after 0.3 s and show the
/// effect after 1 s, of a take-off or a way to go three seconds later; lost ones do neither; one refuses to arm.
class DemoControl : public vehicle::VehicleControl {
 public:
  DemoControl(base::Loop& loop, vehicle::Registry& registry) : loop_(loop), registry_(registry) {}

  [[nodiscard]] bool has(vehicle::VehicleId const& id) const override { return registry_.find(id) != nullptr; }
  base::Result<std::uint64_t> command(vehicle::VehicleCommand command, std::span<vehicle::VehicleId const> vehicles,
                                      vehicle::Commander by, bool takes_over) override {
    bool const stops = vehicle::is_stop(command.action);
    vehicle::CommandRecord record{
        .number = ++last_number_, .command = std::move(command), .by = by, .asked = loop_.utc_now()};
    for (auto const& id : vehicles) {
      auto& outcome = record.outcomes.emplace_back(vehicle::CommandOutcome{.vehicle = id});
      auto& has = registry_.edit(id).control.commander;
      if (!has.empty() && has != by && !takes_over && !stops)
        outcome = {id, vehicle::CommandState::refused, fmt::format("vehicle {} is commanded by {}", id.text, has), {}};
      else if (!stops || takes_over)
        give(id, by);
    }
    records_.push_back(std::move(record));
    begun_ = loop_.now();
    ++revision_;
    return last_number_;
  }
  [[nodiscard]] std::deque<vehicle::CommandRecord> const& commands() const override { return records_; }

  void emergency_stop(std::optional<vehicle::StopAction> action, vehicle::Commander by) override {
    stop_ = {.is_latched = true,
             .action = action.value_or(vehicle::StopAction::hold),
             .by = std::move(by),
             .since = loop_.utc_now()};
    for (auto const* state : registry_.all()) stop_.vehicles.push_back({.vehicle = state->id});
    stopped_ = loop_.now();
    ++revision_;
  }
  void release_emergency_stop(vehicle::Commander by) override {
    stop_.is_latched = false;
    stop_.by = std::move(by);
    ++revision_;
  }
  [[nodiscard]] vehicle::EmergencyStop const& emergency() const override { return stop_; }

  base::Result<> request_control(vehicle::VehicleId const& id, vehicle::Commander by) override {
    auto& control = registry_.edit(id).control;
    control.asked_for_by = std::move(by);
    control.granted_at = loop_.now() + std::chrono::seconds(10);
    return {};
  }
  base::Result<> yield_control(vehicle::VehicleId const& id, vehicle::Commander) override {
    give(id, registry_.edit(id).control.asked_for_by);
    return {};
  }
  base::Result<> keep_control(vehicle::VehicleId const& id, vehicle::Commander) override {
    registry_.edit(id).control.asked_for_by.clear();
    return {};
  }
  void forget(vehicle::Commander const& by) override {
    for (auto const* state : registry_.all())
      if (state->control.commander == by) give(state->id, state->control.asked_for_by);
  }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

  /// Lets the vehicles answer.
  void advance() {
    using namespace std::chrono_literals;
    if (!records_.empty()) {
      for (auto& outcome : records_.back().outcomes) answer(records_.back(), outcome, loop_.now() - begun_);
    }
    for (auto& outcome : stop_.vehicles) {
      if (!stop_.is_latched) break;
      bool const is_lost = registry_.edit(outcome.vehicle).links.connection == vehicle::Connection::lost;
      auto const since = loop_.now() - stopped_;
      outcome.tries = is_lost ? 1 + static_cast<int>(since / 1s) : 1;
      outcome.is_acknowledged = !is_lost && since > 300ms;
      outcome.is_confirmed = !is_lost && since > 1s;
      outcome.detail = is_lost ? "has not been heard for some time" : outcome.is_confirmed ? "LOITER, armed" : "";
      ++revision_;
    }
  }

 private:
  static constexpr base::Duration way_time = std::chrono::seconds(4);
  void answer(vehicle::CommandRecord const& record, vehicle::CommandOutcome& outcome, base::Duration since) {
    using namespace std::chrono_literals;
    using enum vehicle::CommandState;
    auto const before = outcome.state;
    if (vehicle::is_over(before)) return;
    auto const& state = registry_.edit(outcome.vehicle);
    if (state.links.connection == vehicle::Connection::lost) {
      if (since > 2s) outcome = {outcome.vehicle, expired, "not heard: not sent any more", {}};
    } else if (state.family == vehicle::Family::plane && record.command.action == vehicle::Action::arm) {
      if (since > 300ms) outcome = {outcome.vehicle, refused, "arming refused: Arm: Throttle too high", {}};
    } else if (takes_time(record.command.action) && since > 1s && since <= way_time) {
      double const left = base::to_seconds(way_time - since) / base::to_seconds(way_time);
      outcome = under_way_of(record, outcome.vehicle, left);
    } else if (since > 300ms) {
      outcome = {outcome.vehicle, since > 1s ? confirmed : accepted, "", {}};
    }
    if (outcome.state != before || outcome.state == under_way) ++revision_;
  }
  static bool takes_time(vehicle::Action action) {
    return action == vehicle::Action::take_off || action == vehicle::Action::go_to;
  }
  static vehicle::CommandOutcome under_way_of(vehicle::CommandRecord const& record, vehicle::VehicleId const& id,
                                              double left) {
    constexpr double way_m = 300.0;
    double const goal_m = record.command.height_m.value_or(10.0);
    bool const climbs = record.command.action == vehicle::Action::take_off;
    double const left_m = left * (climbs ? goal_m : way_m);
    auto text =
        climbs ? fmt::format("at {:.0f} of {:.0f} m", goal_m - left_m, goal_m) : fmt::format("{:.0f} m to go", left_m);
    return {id, vehicle::CommandState::under_way, std::move(text), left_m};
  }
  void give(vehicle::VehicleId const& id, std::string to) {
    registry_.edit(id).control = {.commander = std::move(to)};
    registry_.touch(id);
  }

  base::Loop& loop_;
  vehicle::Registry& registry_;
  std::deque<vehicle::CommandRecord> records_;
  vehicle::EmergencyStop stop_;
  std::uint64_t last_number_ = 0;
  std::uint64_t revision_ = 0;
  base::TimePoint begun_{};
  base::TimePoint stopped_{};
};

}  // namespace lapwing::station::testing
