#include "sim/safety/arming.hpp"

#include <fmt/core.h>

namespace lapwing::sim {

std::optional<std::string> arming_refusal(ArmingView const& view) {
  if (!view.fault.empty()) return view.fault;
  if (!view.checks_passed) return "AHRS: waiting for home";
  if (!view.objection.empty()) return view.objection;
  bool const in_auto = view.mode.behaviour == Behaviour::mission;
  if (in_auto && !view.has_mission) return "Mode requires mission";
  if (!view.mode.armable && !(in_auto && view.arm_in_auto)) return fmt::format("{} mode not armable", view.mode.name);
  if (view.mode.needs_position && !view.navigation.position_ok) return "Need Position Estimate";
  return std::nullopt;
}

}  // namespace lapwing::sim
