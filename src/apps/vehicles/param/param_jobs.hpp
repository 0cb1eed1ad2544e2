#pragma once

#include <string>
#include <vector>

#include "apps/vehicles/param/param_report.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "parameters/service.hpp"

/// What the verb `param` does with vehicles, as coroutines over `parameters::ParameterService`.
namespace lapwing::apps {

/// A vehicle, and the service that knows the parameters on its network.
struct ParamVehicle {
  fleet::MavlinkVehicle const* craft = nullptr;
  parameters::ParameterService* service = nullptr;
};

/// All parameters that fit one of the patterns, with progress on standard error. Vehicles on different links are asked
/// at the same time. The error of the first that fails.
base::Task<base::Result<std::vector<ParamListing>>> list_parameters(base::Loop& loop,
                                                                    std::vector<ParamVehicle> vehicles,
                                                                    parameters::Wanted wanted,
                                                                    std::vector<std::string> patterns);

/// The parameters of these names, each asked of the vehicle.
base::Task<ParamListing> read_parameters(ParamVehicle vehicle, std::vector<std::string> names);

struct ApplyOptions {
  bool leave_out_own = true;  ///< skip what belongs to one vehicle
  bool only_tell = false;     ///< change nothing; `changed` says what would be
};
/// Sets each value that the vehicle does not have already. A parameter that shows only after another was switched on
/// is set in a second round.
base::Task<base::Result<ParamChanges>> apply_parameters(base::Loop& loop, ParamVehicle vehicle,
                                                        std::vector<parameters::Parameter> values,
                                                        ApplyOptions options);

}  // namespace lapwing::apps
