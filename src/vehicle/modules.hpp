#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "vehicle/vehicle_id.hpp"

/// How the parts of a vehicle do that say so themselves, for whoever shows it: the health of a robot's modules.
namespace lapwing::vehicle {

enum class ModuleState {
  unheard,   ///< has never said anything
  starting,  ///< there, and not ready for the vehicle to move
  ready,
  failed,  ///< gave up
  silent,  ///< has said nothing for longer than it may
};
[[nodiscard]] std::string_view to_string(ModuleState state);

enum class ModuleSeverity {
  notice,    ///< somebody may like to know
  degraded,  ///< it goes on, less well
  critical,  ///< the vehicle must not move
};
[[nodiscard]] std::string_view to_string(ModuleSeverity severity);

/// What a module says is wrong with it, in words for whoever stands before the vehicle.
struct ModuleError {
  int code = 0;
  ModuleSeverity severity = ModuleSeverity::notice;
  std::string meaning = {};
  std::string what_to_do = {};
};

struct ModuleView {
  std::string short_name = {};  ///< "MMU"
  std::string name = {};        ///< "mapping"
  bool is_required = false;     ///< without it the vehicle does not move
  ModuleState state = ModuleState::unheard;
  std::optional<ModuleError> error = {};
  /// Of the process that it runs in, which several modules may share; nothing where it runs on a board.
  std::optional<std::uint64_t> memory_bytes = {};
  std::optional<double> cpu_share = {};  ///< of one core, of the same process
  double reports_per_s = 0.0;
  std::optional<base::Duration> since_heard = {};
};

struct ModulesOfVehicle {
  VehicleId vehicle = {};
  std::string name = {};
  bool may_move = false;
  std::string who = {};         ///< the short name of the module that stops it; empty where none does
  std::string reason = {};      ///< why it may not move
  std::string what_to_do = {};  ///< about that
  /// It was killed and stands until an operator restarts it: that is the command `arm`.
  bool needs_restart = false;
  std::vector<ModuleView> modules = {};
};

/// Whoever knows the modules of vehicles. Thread-bound.
class VehicleModules {
 public:
  virtual ~VehicleModules() = default;

  [[nodiscard]] virtual std::vector<ModulesOfVehicle> modules(base::TimePoint now) const = 0;
};

}  // namespace lapwing::vehicle
