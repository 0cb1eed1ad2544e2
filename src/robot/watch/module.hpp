#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lapwing::robot {

/// The parts of a robot that say how they are (the seed's modules).
enum class Module : std::uint8_t {
  sensors,             // SIM
  carrier,             // CAR
  mapping,             // MMU
  planner,             // PLN
  points_of_interest,  // POI
  communication,       // CM
  visualizer,          // VSL
  command_centre,      // CC
};

struct ModuleName {
  Module module;
  std::string_view short_name;  ///< as in the seed's messages
  std::string_view name;
};

auto constexpr module_names = std::to_array<ModuleName>({{Module::sensors, "SIM", "sensors"},
                                                         {Module::carrier, "CAR", "carrier"},
                                                         {Module::mapping, "MMU", "mapping"},
                                                         {Module::planner, "PLN", "planner"},
                                                         {Module::points_of_interest, "POI", "points of interest"},
                                                         {Module::communication, "CM", "communication"},
                                                         {Module::visualizer, "VSL", "visualizer"},
                                                         {Module::command_centre, "CC", "command centre"}});

[[nodiscard]] constexpr ModuleName const& name_of(Module module) {
  return module_names[static_cast<std::size_t>(module)];
}

[[nodiscard]] constexpr std::optional<Module> module_of(std::string_view short_name) {
  for (auto const& entry : module_names)
    if (entry.short_name == short_name) return entry.module;
  return std::nullopt;
}

enum class ModuleState : std::uint8_t {
  starting,  ///< there, and not ready for the robot to move
  ready,
  failed,  ///< gave up; comes back by being started anew
};

/// What a module says of itself, ten times a second.
struct ModuleReport {
  ModuleState state = ModuleState::starting;
  std::uint16_t error_code = 0;  ///< of the table in codes.hpp; zero: none
  /// Of the process that it runs in, which several modules may share; nothing where it runs on a board.
  std::optional<std::uint64_t> memory_bytes = {};
  std::optional<double> cpu_share = {};  ///< of one core, of the same process
};

}  // namespace lapwing::robot
