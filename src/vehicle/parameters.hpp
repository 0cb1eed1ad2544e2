#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "vehicle/control.hpp"
#include "vehicle/vehicle_id.hpp"

/// A vehicle's parameters as an operator sees them. Plain data and one interface, so that whoever shows them needs no
/// protocol.
namespace lapwing::vehicle {

/// How sure a list is.
enum class Confirmed {
  by_vehicle,  ///< it sent every value just now
  by_hash,     ///< it confirmed (PX4) that nothing has changed since they were taken
  not_at_all   ///< as they were then; what changed since then unheard is wrong
};
/// "vehicle", "hash", "no".
[[nodiscard]] constexpr std::string_view to_string(Confirmed confirmed) {
  if (confirmed == Confirmed::by_hash) return "hash";
  return confirmed == Confirmed::by_vehicle ? "vehicle" : "no";
}

struct Parameter {
  std::string name;
  double value = 0.0;  ///< holds every value of a parameter exactly
  std::string type;    ///< as MAVLink calls it: "int32", "real32"
};

struct ParameterList {
  std::vector<Parameter> parameters;  ///< in the vehicle's order
  base::UtcTime taken{};
  Confirmed confirmed = Confirmed::by_vehicle;
};

/// How far a list is that is being fetched; a total of 0 is not known yet.
struct ParameterProgress {
  std::size_t done = 0;
  std::size_t total = 0;
};

struct ParameterChange {
  Parameter before;
  Parameter after;  ///< as the vehicle told it after it was set
};

/// Reads and changes parameters. Implemented by a platform; nothing is asked of a vehicle until somebody asks here.
/// Thread-bound; outlives its tasks.
///
/// Errors of all tasks: not_found (no such vehicle, or the vehicle says that it has no such parameter), lost (it is not
/// heard), timed_out (no answer; ArduPilot is silent about parameters that it does not have), refused.
class VehicleParameters {
 public:
  virtual ~VehicleParameters() = default;

  /// Whether the vehicle is one of its own.
  [[nodiscard]] virtual bool has(VehicleId const& id) const = 0;

  /// All of them. Who asks while they are being fetched gets the same. `old_ones_do`: such as were fetched before, if
  /// there are any, without asking the vehicle.
  [[nodiscard]] virtual base::Task<base::Result<ParameterList>> all(VehicleId id, bool old_ones_do) = 0;
  /// Nothing when they are not being fetched.
  [[nodiscard]] virtual std::optional<ParameterProgress> progress(VehicleId const& id) const = 0;
  /// All of them as a file of QGroundControl.
  [[nodiscard]] virtual base::Task<base::Result<std::string>> file(VehicleId id, bool old_ones_do) = 0;
  /// One, as the vehicle tells it now.
  [[nodiscard]] virtual base::Task<base::Result<Parameter>> read(VehicleId id, std::string name) = 0;
  /// Sets one, and makes sure that it was stored. Who changes a vehicle that nobody commands commands it meanwhile.
  /// Errors also: refused (somebody else commands the vehicle, the emergency stop is latched, the vehicle said no or
  /// stored another value), invalid_input (the parameter's type cannot hold the value).
  [[nodiscard]] virtual base::Task<base::Result<ParameterChange>> change(VehicleId id, std::string name, double value,
                                                                         Commander by) = 0;
};

}  // namespace lapwing::vehicle
