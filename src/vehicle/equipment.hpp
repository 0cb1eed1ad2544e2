#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/aged.hpp"

/// What a vehicle carries besides its autopilot: components that speak for themselves, a gimbal, the pictures taken.
namespace lapwing::vehicle {

/// A camera, gimbal, companion computer ... of the vehicle, as it was last heard.
struct Component {
  int id = 0;                   ///< MAVLink component; 1 for what the autopilot speaks for
  std::string_view kind = {};   ///< "camera", "gimbal", "companion computer"; "component" for anything else
  std::string_view state = {};  ///< "active", "standby", "critical" ...; empty when it does not say
  std::string model = {};       ///< "Maker M1"; empty until it has told
  base::TimePoint heard{};
};

/// Where a gimbal points.
struct Gimbal {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< negative is down
  double yaw_rad = 0.0;
  bool yaw_is_from_north = false;  ///< otherwise from the vehicle's nose
};

/// One picture taken in flight.
struct Picture {
  int number = 0;  ///< counts the pictures whose place is known, from 1, in the order in which they were told
  geo::Wgs84 position;
  double relative_alt_m = 0.0;
};

struct Pictures {
  int taken = 0;                ///< since the vehicle was discovered
  int lost = 0;                 ///< taken, but where was not told
  std::vector<Picture> recent;  ///< newest last, bounded
};

/// What it carries.
struct Payload {
  std::vector<std::string> names;  ///< of equipment, as scripts ask for it: "Camera"
  Aged<Gimbal> gimbal;
  std::vector<Component> components;  ///< besides the autopilot, by id
  Aged<Pictures> pictures;
};

}  // namespace lapwing::vehicle
