#pragma once

#include "vehicle/modules.hpp"

namespace lapwing::station::testing {

/// A robot whose mapping is lost, as somebody says.
class FakeModules : public vehicle::VehicleModules {
 public:
  FakeModules() {
    vehicle::ModuleView sensors{.short_name = "SIM",
                                .name = "sensors",
                                .is_required = true,
                                .state = vehicle::ModuleState::ready,
                                .memory_bytes = 50'000'000,
                                .cpu_share = 0.25,
                                .reports_per_s = 10.0,
                                .since_heard = std::chrono::milliseconds(40)};
    vehicle::ModuleView mapping = sensors;
    mapping.short_name = "MMU";
    mapping.name = "mapping";
    mapping.error = vehicle::ModuleError{.code = 302,
                                         .severity = vehicle::ModuleSeverity::critical,
                                         .meaning = "The place is lost.",
                                         .what_to_do = "Carry it back."};
    list = {
        {.vehicle = {"robot1"},
         .name = "robot 1",
         .may_move = false,
         .who = "MMU",
         .reason = "mapping (MMU) reports error 302: The place is lost.",
         .what_to_do = "Carry it back.",
         .modules = {
             std::move(sensors), std::move(mapping), {.short_name = "PLN", .name = "planner", .is_required = true}}}};
  }
  [[nodiscard]] std::vector<vehicle::ModulesOfVehicle> modules(base::TimePoint) const override { return list; }

  std::vector<vehicle::ModulesOfVehicle> list;
};

}  // namespace lapwing::station::testing
