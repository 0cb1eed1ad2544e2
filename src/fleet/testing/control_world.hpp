#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/control/fleet_control.hpp"
#include "fleet/testing/world.hpp"

namespace lapwing::fleet {

[[nodiscard]] inline TestAutopilot::Options a_rover(std::uint8_t system_id) {
  return {.address = {system_id, 1}, .type = mavlink::MavType::ground_rover};
}

/// A ground station with an operator's hand on it, in virtual time.
struct ControlWorld : TestWorld {
  explicit ControlWorld(FleetControl::Options const& options = {}) {
    control = std::make_unique<FleetControl>(*fleet, *platform, options, base::Logger(log, "fleet"));
    control->set_on_latched([this](std::string const& reason) { latched_with = reason; });
  }

  /// A copter that is heard and knows where it is.
  TestAutopilot& add_ready(TestAutopilot::Options options = {}) {
    auto& vehicle = add(options);
    run_for(std::chrono::seconds(4));
    return vehicle;
  }
  /// The same in the air.
  TestAutopilot& add_flying(TestAutopilot::Options options = {}) {
    auto& vehicle = add_ready(options);
    vehicle.is_armed = vehicle.is_flying = true;
    vehicle.change_mode(copter_mode::guided);
    run_for(std::chrono::seconds(2));
    return vehicle;
  }
  /// Gives the command to the vehicles, and its number.
  std::uint64_t give(vehicle::VehicleCommand command, std::vector<std::string> const& ids = {"1"},
                     std::string by = "operator 1", bool takes_over = false) const {
    std::vector<vehicle::VehicleId> chosen;
    for (auto const& id : ids) chosen.push_back({id});
    return control->command(std::move(command), chosen, std::move(by), takes_over).value_or(0);
  }
  [[nodiscard]] vehicle::CommandOutcome outcome(std::uint64_t number, std::size_t index = 0) const {
    for (auto const& record : control->commands())
      if (record.number == number) return record.outcomes.at(index);
    return {};
  }
  using TestWorld::comes_to;
  [[nodiscard]] bool comes_to(std::uint64_t number, vehicle::CommandState state, std::size_t index = 0) {
    return run_until([&] { return outcome(number, index).state == state; }, std::chrono::seconds(40));
  }
  /// Its end, whatever it is.
  vehicle::CommandState end_of(std::uint64_t number, std::size_t index = 0) {
    (void)run_until([&] { return vehicle::is_over(outcome(number, index).state); }, std::chrono::seconds(60));
    return outcome(number, index).state;
  }
  /// What a script starts on vehicle 1: a mission that flies until it is stopped.
  std::unique_ptr<tasks::TaskRun> start_mission() {
    return platform->start(task_of(mission_ending_with(mavlink::MavCmd::nav_loiter_unlim)), vehicle::VehicleId{"1"});
  }
  /// Presses the emergency stop; whether every vehicle has confirmed it in time.
  [[nodiscard]] bool stops_all(std::optional<vehicle::StopAction> action = std::nullopt) {
    control->emergency_stop(action, "operator 1");
    return all_confirm();
  }
  [[nodiscard]] bool all_confirm(base::Duration limit = std::chrono::seconds(10)) {
    auto const is_confirmed = [this] {
      auto const& stops = control->emergency().vehicles;
      return !stops.empty() && std::ranges::all_of(stops, &vehicle::StopOutcome::is_confirmed);
    };
    return run_until(is_confirmed, limit);
  }
  [[nodiscard]] vehicle::StopOutcome stop_of(std::string const& id) const {
    for (auto const& stopped : control->emergency().vehicles)
      if (stopped.vehicle.text == id) return stopped;
    return {};
  }

  std::string latched_with;
  std::unique_ptr<FleetControl> control;
};

}  // namespace lapwing::fleet
