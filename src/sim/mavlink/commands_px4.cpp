// What PX4 makes of commands; its Commander and MavlinkReceiver are where the facts are from.

#include <cmath>

#include "mavlink/wire/modes.hpp"
#include "sim/mavlink/flight_controller.hpp"

namespace lapwing::sim {

using namespace mavlink;

namespace {

/// What its flight logic refuses PX4 refuses "for now"; ArduPilot's FAILED and DENIED are for what is no command of
/// its.
MavResult for_now(MavResult result) {
  bool const refused = result == MavResult::failed || result == MavResult::denied;
  return refused ? MavResult::temporarily_rejected : result;
}

}  // namespace

MavResult FlightController::perform_on_px4(CommandInt const& command, Address from) {
  auto const enter = [&](Behaviour behaviour) {
    return for_now(autopilot_.set_mode(sim::mode_for(autopilot_.kind(), behaviour).number));
  };
  switch (command.command) {
    case MavCmd::do_set_mode: return px4_set_mode(command);
    case MavCmd::component_arm_disarm: return for_now(arm_disarm(command));
    case MavCmd::nav_takeoff: return px4_take_off(command);
    case MavCmd::nav_land: return enter(Behaviour::land);
    case MavCmd::nav_return_to_launch: return enter(Behaviour::return_home);
    case MavCmd::nav_loiter_unlim: return enter(Behaviour::hold);
    case MavCmd::mission_start: return for_now(autopilot_.start_mission());
    case MavCmd::do_reposition: return for_now(reposition(command));
    case MavCmd::do_change_speed: return autopilot_.change_speed(command.params[1]);
    case MavCmd::do_set_home: return for_now(set_home(command));
    case MavCmd::preflight_reboot_shutdown: return for_now(reboot(command));
    case MavCmd::run_prearm_checks: return autopilot_.armed() ? MavResult::temporarily_rejected : MavResult::accepted;
    case MavCmd::image_start_capture:
    case MavCmd::image_stop_capture: return perform_payload(command).value_or(MavResult::accepted);
    case MavCmd::request_message: {
      auto const result = request_message(command, from);
      return result == MavResult::failed ? MavResult::denied : result;
    }
    case MavCmd::set_message_interval:
      return set_interval(command) == MavResult::accepted ? MavResult::accepted : MavResult::failed;
    case MavCmd::get_message_interval:
    case MavCmd::get_home_position:
    case MavCmd::request_autopilot_capabilities: return perform_request(command, from);
    // DO_SET_MISSION_CURRENT among the rest: PX4 only has the message MISSION_SET_CURRENT.
    default: return perform_payload(command).value_or(MavResult::unsupported);
  }
}

/// p2 the main mode, p3 the sub mode.
MavResult FlightController::px4_set_mode(CommandInt const& command) {
  auto const base = static_cast<unsigned>(command.params[0]);
  if ((base & mode_flag::custom_mode_enabled) == 0) return MavResult::temporarily_rejected;
  auto const main = static_cast<std::uint32_t>(command.params[1]);
  auto const sub = static_cast<std::uint32_t>(command.params[2]);
  auto const number = px4_mode(main, sub);
  return for_now(autopilot_.set_mode(number == px4_auto ? px4_auto_mission : number));
}

/// p7 is an altitude above sea level; without one it climbs to MIS_TAKEOFF_ALT above home.
MavResult FlightController::px4_take_off(CommandInt const& command) {
  auto const home = autopilot_.home();
  if (!home) return MavResult::temporarily_rejected;
  double const home_alt_m = site_.anchor().alt_m - home->down;
  return for_now(autopilot_.take_off(command.place.z_m - home_alt_m));
}

}  // namespace lapwing::sim
