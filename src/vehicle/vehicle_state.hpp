#pragma once

#include <string>
#include <vector>

#include "base/time.hpp"
#include "vehicle/aged.hpp"
#include "vehicle/aspects/arming.hpp"
#include "vehicle/aspects/carrier.hpp"
#include "vehicle/aspects/links.hpp"
#include "vehicle/aspects/mission_state.hpp"
#include "vehicle/aspects/motion.hpp"
#include "vehicle/aspects/positioning.hpp"
#include "vehicle/aspects/power.hpp"
#include "vehicle/equipment.hpp"
#include "vehicle/family.hpp"
#include "vehicle/status_text.hpp"
#include "vehicle/vehicle_id.hpp"

namespace lapwing::vehicle {

/// Who commands the vehicle; names as in vehicle/control.hpp.
struct ControlState {
  std::string commander = {};     ///< empty: nobody
  std::string asked_for_by = {};  ///< who wants it from him; empty: nobody
  base::TimePoint granted_at{};   ///< when that request is granted unless he answers
  friend bool operator==(ControlState const&, ControlState const&) = default;
};

/// Everything known about one vehicle. A value: copy it to keep a moment.
///
/// What every platform tells stands first. Each aspect behind it is filled by the platforms that have it: a robot has
/// no GPS and a drone no carrier, and what nobody fills is unknown.
struct VehicleState {
  VehicleId id;
  int system_id = 0;  ///< MAVLink's; 0 for what has none
  std::string name;   ///< "copter 1"
  Family family = Family::unknown;
  Autopilot autopilot = Autopilot::other;
  Aged<std::string> mode;                ///< the autopilot's own name, "AUTO"
  std::vector<StatusText> recent_texts;  ///< newest last, bounded
  ControlState control;
  /// The last thing that happened to it without this station: another station's command, a mode that nobody here asked
  /// for.
  Aged<std::string> foreign_change;
  /// How it came into the mode that it is in, when nobody here asked for that: "AUTO to LOITER". Without a value when
  /// somebody did.
  Aged<std::string> foreign_mode;

  Links links;
  Motion motion;
  Positioning positioning;
  Power power;
  Arming arming;
  MissionState mission;
  Payload payload;
  Carrier carrier;
};

}  // namespace lapwing::vehicle
