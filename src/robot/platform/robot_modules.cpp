#include "robot/platform/robot_modules.hpp"

#include <string>

#include "robot/watch/codes.hpp"

namespace lapwing::robot {

namespace {

vehicle::ModuleSeverity severity_for(std::uint16_t code) {
  switch (severity_of(code)) {
    case Severity::notice: return vehicle::ModuleSeverity::notice;
    case Severity::degraded: return vehicle::ModuleSeverity::degraded;
    case Severity::critical: break;
  }
  return vehicle::ModuleSeverity::critical;
}

vehicle::ModuleState state_of(ModuleHealth const& health) {
  if (!health.was_heard) return vehicle::ModuleState::unheard;
  if (health.is_silent) return vehicle::ModuleState::silent;
  switch (health.report.state) {
    case ModuleState::starting: return vehicle::ModuleState::starting;
    case ModuleState::ready: return vehicle::ModuleState::ready;
    case ModuleState::failed: break;
  }
  return vehicle::ModuleState::failed;
}

std::optional<vehicle::ModuleError> error_of(ModuleHealth const& health) {
  auto const code = health.report.error_code;
  if (!health.was_heard || code == code::none) return std::nullopt;
  vehicle::ModuleError error{.code = code, .severity = severity_for(code)};
  auto const* const entry = find_code(code);
  error.meaning = entry != nullptr ? entry->meaning : "An error that this program does not know.";
  error.what_to_do = entry != nullptr ? entry->what_to_do : "Bring all parts to the same version.";
  return error;
}

vehicle::ModuleView view_of(ModuleHealth const& health) {
  auto const& name = name_of(health.module);
  vehicle::ModuleView view{.short_name = std::string(name.short_name),
                           .name = std::string(name.name),
                           .is_required = health.is_required,
                           .state = state_of(health),
                           .error = error_of(health)};
  if (!health.was_heard) return view;
  view.memory_bytes = health.report.memory_bytes;
  view.cpu_share = health.report.cpu_share;
  view.reports_per_s = health.reports_per_s;
  view.since_heard = health.since_heard;
  return view;
}

vehicle::ModulesOfVehicle modules_of(Robot const& robot, base::TimePoint now) {
  auto const clearance = robot.watch().clearance(now);
  vehicle::ModulesOfVehicle of{.vehicle = robot.id(),
                               .name = robot.spec().name,
                               .may_move = clearance.may_move && !robot.needs_restart(),
                               .who = clearance.who ? std::string(name_of(*clearance.who).short_name) : std::string(),
                               .reason = clearance.reason,
                               .what_to_do = clearance.what_to_do,
                               .needs_restart = robot.needs_restart()};
  if (clearance.may_move && of.needs_restart) {
    of.reason = "the robot was killed at its body";
    of.what_to_do = "when it is safe to move, restart it at the command centre";
  }
  for (auto const& health : robot.watch().health(now))
    if (health.is_required || health.was_heard) of.modules.push_back(view_of(health));
  return of;
}

}  // namespace

std::vector<vehicle::ModulesOfVehicle> RobotModules::modules(base::TimePoint now) const {
  std::vector<vehicle::ModulesOfVehicle> all;
  for (auto const& robot : platform_.robots()) all.push_back(modules_of(*robot, now));
  return all;
}

}  // namespace lapwing::robot
