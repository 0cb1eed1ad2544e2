#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "autonomy/interface/said.hpp"
#include "autonomy/interface/told.hpp"
#include "autonomy/states/event.hpp"
#include "autonomy/states/options.hpp"

namespace lapwing::autonomy {

/// A mode that the flight controller is to be in. It is asked for until it is seen once: who changes it afterwards, a
/// pilot or a failsafe, has his reason.
struct WantedMode {
  bool is_seen = false;
  std::optional<base::TimePoint> first_asked = {};  ///< of a flight controller that is heard
  base::TimePoint next_ask{};
};

/// Where a move leads.
struct Target {
  std::variant<geo::Point<ArmingFrame>, geo::Wgs84> place;
  std::optional<double> yaw_rad = {};
};

/// What the machine knows from frame to frame.
struct Memory {
  State state = State::idle;
  base::TimePoint entered{};
  base::TimePoint next_heartbeat{};
  HoverHeights heights = {};
  UserError user_error = UserError::none;
  WantedMode mode = {};

  bool has_met_flight_controller = false;  ///< since the machine was made
  bool is_killed = false;                  ///< until it is seen disarmed, and `kill_holds`
  base::TimePoint killed{};
  base::TimePoint next_arm_request{};
  std::optional<base::TimePoint> disarms_until = {};  ///< it is being disarmed

  bool was_armed = false;  ///< in this state
  int arm_requests = 0;    ///< since Idle
  base::TimePoint unarmed_since{};
  std::optional<geo::Wgs84> home = {};

  base::TimePoint next_takeoff{};
  std::optional<Target> target = {};
  bool has_refused_setpoint = false;  ///< of the planner, in this state
  bool is_agreed = false;             ///< the planner has said that the target lies in the lot
  bool is_flown_by_hand = false;
  std::optional<geo::Point3<ArmingFrame>> hold = {};
  base::TimePoint next_setpoint{};

  std::optional<base::TimePoint> no_place_since = {};
  std::optional<base::TimePoint> no_battery_since = {};
  std::string reason = {};  ///< of the malfunction
};

/// One frame, as guards see it and actions work on it.
struct Situation {
  Options const& options;
  Told const& told;
  base::TimePoint now;
  Memory& memory;
  Said& said;
  Command const* command = nullptr;  ///< that is being looked at
};

// What is the case, by what was told.

/// The flight controller, when it is heard.
[[nodiscard]] FlightController const* heard_flight(Situation const& s);
/// Of a flight controller that is heard: one that is silent may be anything.
[[nodiscard]] bool is_heard_disarmed(Situation const& s);
/// By what was heard last.
[[nodiscard]] bool is_armed(Situation const& s);
[[nodiscard]] bool is_in_mode(Situation const& s, std::string_view mode);
/// Returning home or landing, whoever wanted it.
[[nodiscard]] bool is_coming_down(Situation const& s);
[[nodiscard]] bool is_link_lost(Situation const& s);
[[nodiscard]] bool is_in_the_air(Situation const& s);
/// Why one cannot rely on flight controller and processes; nothing when one can.
[[nodiscard]] std::optional<std::string> failure_of(Situation const& s);
/// Of the processes alone.
[[nodiscard]] std::optional<std::string> process_failure(Situation const& s);
/// The share of a full charge at which it has to go home from here.
[[nodiscard]] double reserve_here(Situation const& s);
/// Until it has to be over home; nothing as long as charge, height or consumption are not known.
[[nodiscard]] std::optional<base::Duration> flying_time_left(Situation const& s);

/// For the operator, as an ErrorLog.
void tell(Situation& s, std::string text);

inline constexpr std::string_view guided = "GUIDED";
inline constexpr std::string_view return_home = "RTL";
inline constexpr std::string_view land_here = "LAND";

}  // namespace lapwing::autonomy
