#pragma once

#include <optional>
#include <string>

#include "sim/autopilot/start_up.hpp"
#include "sim/model/flight_modes.hpp"

namespace lapwing::sim {

/// What the arming checks look at.
struct ArmingView {
  FlightMode const& mode;
  Navigation const& navigation;
  bool checks_passed = false;  ///< start-up is through with its own checks
  bool arm_in_auto = false;    ///< AUTO_OPTIONS allows a copter to arm in AUTO
  bool has_mission = false;
  std::string const& objection;  ///< a breached fence, a lost radio; empty: none
  std::string const& fault;      ///< an injected reason; empty: none
};

/// Why the vehicle does not arm, in ArduPilot's words without the "Arm: "; nothing when it may.
[[nodiscard]] std::optional<std::string> arming_refusal(ArmingView const& view);

}  // namespace lapwing::sim
