#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "autonomy/interface/command.hpp"
#include "autonomy/interface/state.hpp"
#include "base/time.hpp"

namespace lapwing::autonomy {

/// What the flight controller is asked for.
namespace request {

struct Mode {
  std::string_view mode;  ///< "GUIDED", "RTL", "LAND"
};
struct Arm {
  bool is_to_arm = false;
  bool by_force = false;  ///< disarming in the air, too: it falls
};
struct Takeoff {
  double height_m = 0.0;  ///< above home
};
struct ReturnAltitude {
  double height_m = 0.0;  ///< above home, in metres; what unit a flight controller's parameter has its bridge knows
};
struct LocalSetpoint {
  geo::Point3<ArmingFrame> place;
  std::optional<double> yaw_rad = {};
};
struct GlobalSetpoint {
  geo::Wgs84 place;       ///< its altitude does not count
  double height_m = 0.0;  ///< above home
  std::optional<double> yaw_rad = {};
};

}  // namespace request

using Request = std::variant<request::Mode, request::Arm, request::Takeoff, request::ReturnAltitude,
                             request::LocalSetpoint, request::GlobalSetpoint>;

/// How the ErrorLog begins that says that the drone has tried to arm, and does not any more.
inline constexpr std::string_view arming_given_up = "arming was given up";

/// All that the machine says in one frame.
struct Said {
  State state{};
  std::vector<Request> requests = {};                       ///< in order
  std::optional<request::LocalSetpoint> wanted_place = {};  ///< for the planner, as topic `des_pose`
  std::optional<base::Duration> flying_time_left = {};      ///< until it has to be over home; nothing: not known
  UserError user_error{};
  Health health = {};
  bool sends_heartbeat = false;                 ///< now: at its period, and when the state has changed
  std::vector<std::string> error_log = {};      ///< for the operator, each an ErrorLog
  std::optional<HoverHeights> to_save = {};     ///< over the next boot
  std::optional<std::string> diagnostics = {};  ///< to be written to a file: why, and what was told in this frame
};

}  // namespace lapwing::autonomy
