#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autonomy/interface/command.hpp"
#include "base/time.hpp"
#include "geo/point.hpp"
#include "geo/polygon.hpp"
#include "geo/position.hpp"
#include "vehicle/energy/endurance.hpp"

namespace lapwing::autonomy {

/// The link to the operator.
struct OperatorLink {
  bool is_up = false;
  base::Duration silence = base::Duration::max();  ///< since anything was heard of him
};

/// Of `FlightController::gps_fix`: a place in three dimensions.
inline constexpr int gps_fix_3d = 3;

/// The flight controller as it was heard last. What is no number is not known; whoever tells leaves out what has not
/// been heard for as long as he would not believe it.
struct FlightController {
  base::Duration silence{};
  std::string mode = {};  ///< as ArduPilot names it: "GUIDED"
  bool is_armed = false;
  bool prearm_ok = true;                      ///< by its own checks
  bool is_critical = false;                   ///< by its own account: a failsafe acts, or worse
  int gps_fix = 0;                            ///< as GPS_FIX_TYPE counts
  std::optional<double> relative_alt_m = {};  ///< above home
  std::optional<geo::Wgs84> position = {};
  std::optional<geo::Point3<ArmingFrame>> local = {};
  std::optional<geo::Wgs84> home = {};
  std::optional<double> battery = {};        ///< 0..1
  std::optional<vehicle::Drain> drain = {};  ///< what flying draws; nothing before it is known
};

/// One of the processes on the vehicle: vision, mapper, planner.
struct ProcessHealth {
  std::string name;
  std::optional<base::Duration> silence = {};  ///< nothing: it has not spoken yet
  bool is_well = true;                         ///< by its own report
  std::string words = {};                      ///< what it says beside
};

/// What the planner thinks of the place that it was told last.
struct PlaceVerdict {
  bool is_in_lot = false;
  base::TimePoint at{};  ///< when it came
};

/// Where the planner wants the drone while it explores.
struct PlannerSetpoint {
  geo::Point3<ArmingFrame> place;
  std::optional<double> yaw_rad = {};
  base::TimePoint at{};  ///< when it came
};

/// All that the machine is told in one frame.
struct Told {
  OperatorLink link;
  std::optional<FlightController> flight = {};  ///< nothing: never heard
  std::vector<ProcessHealth> processes = {};    ///< those that it does not fly without
  std::optional<bool> sees_lot = {};            ///< nothing as long as vision has not said
  std::optional<PlaceVerdict> place = {};
  std::optional<PlannerSetpoint> setpoint = {};   ///< nothing: the planner has none, or sends its own
  std::optional<geo::Box<ArmingFrame>> lot = {};  ///< how far the lot reaches, as far as it was seen
  std::vector<Command> commands = {};             ///< that came since the last frame, in order
};

}  // namespace lapwing::autonomy
