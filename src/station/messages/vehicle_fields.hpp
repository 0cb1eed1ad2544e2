#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "station/messages/json.hpp"
#include "vehicle/vehicle_state.hpp"

/// What is told of a vehicle, key by key. For .cpp files.
namespace lapwing::station::internal {

/// One key of a vehicle's JSON object. A key that is not there was never heard.
struct Field {
  Json value;
  std::optional<base::TimePoint> heard;  ///< nothing for what has no age
};
using Fields = std::map<std::string, Field>;

[[nodiscard]] Fields fields_of(vehicle::VehicleState const& state);

}  // namespace lapwing::station::internal
