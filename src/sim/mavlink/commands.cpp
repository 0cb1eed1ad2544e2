#include <cmath>
#include <numbers>

#include "sim/mavlink/flight_controller.hpp"

namespace lapwing::sim {

using namespace mavlink;

namespace {

// Magic numbers of MAV_CMD_COMPONENT_ARM_DISARM that skip checks.
constexpr float force_arm = 2989.0F;
constexpr float force_disarm = 21196.0F;

// MAV_CMD_BATTERY_RESET of common.xml; no mission has it.
constexpr auto battery_reset_command = static_cast<MavCmd>(42651);

MessageId message_id(float parameter) {
  return static_cast<MessageId>(static_cast<std::uint32_t>(parameter));
}

}  // namespace

MavResult FlightController::perform(CommandInt const& command, Address from) {
  if (is_px4()) return perform_on_px4(command, from);
  auto const& p = command.params;
  if (command.command == battery_reset_command) return battery_reset(command);
  switch (command.command) {
    case MavCmd::do_set_mode: return set_mode(command);
    case MavCmd::component_arm_disarm: return arm_disarm(command);
    case MavCmd::nav_takeoff: return autopilot_.take_off(command.place.z_m);
    case MavCmd::nav_return_to_launch:
      if (autopilot_.airframe().family == vehicle::Family::sub) return MavResult::unsupported;
      return autopilot_.set_mode(sim::mode_for(autopilot_.kind(), Behaviour::return_home).number);
    case MavCmd::nav_land:
      if (autopilot_.airframe().family != vehicle::Family::copter) return MavResult::unsupported;
      return autopilot_.set_mode(sim::mode_for(autopilot_.kind(), Behaviour::land).number);
    case MavCmd::nav_loiter_unlim: {
      auto const family = autopilot_.airframe().family;
      auto const loiter = family == vehicle::Family::plane ? 12U : family == vehicle::Family::sub ? 16U : 5U;
      return autopilot_.set_mode(loiter);
    }
    case MavCmd::mission_start: return autopilot_.start_mission();
    case MavCmd::do_land_start:
      if (autopilot_.airframe().family != vehicle::Family::plane) return MavResult::unsupported;
      return autopilot_.start_landing();
    case MavCmd::do_reposition: return reposition(command);
    case MavCmd::do_change_speed: return autopilot_.change_speed(p[1]);
    case MavCmd::condition_yaw: {
      double const angle = p[0] * std::numbers::pi / 180.0;
      double const now = autopilot_.body().attitude.yaw_rad;
      return autopilot_.turn_to(p[3] != 0.0F ? now + (p[2] < 0.0F ? -angle : angle) : angle);
    }
    case MavCmd::do_pause_continue: return autopilot_.pause(p[0] == 0.0F);
    case MavCmd::do_set_home: return set_home(command);
    case MavCmd::do_fence_enable: return enable_fence(command);
    case MavCmd::preflight_reboot_shutdown: return reboot(command);
    case MavCmd::run_prearm_checks: return autopilot_.armed() ? MavResult::temporarily_rejected : MavResult::accepted;
    default:
      if (auto const result = perform_payload(command)) return *result;
      return perform_request(command, from);
  }
}

/// The commands that only ask for something to be sent.
MavResult FlightController::perform_request(CommandInt const& command, Address from) {
  switch (command.command) {
    case MavCmd::do_set_mission_current:
      if (!autopilot_.set_current_item(static_cast<int>(command.params[0]))) return MavResult::denied;
      broadcast_report(MessageId::mission_current);
      return MavResult::accepted;
    case MavCmd::set_message_interval: return set_interval(command);
    case MavCmd::get_message_interval: return get_interval(command, from);
    case MavCmd::request_message: return request_message(command, from);
    case MavCmd::request_camera_image_capture: {
      auto const message = payload_report(MessageId::camera_image_captured, command.params[0]);
      if (!message) return MavResult::failed;
      send(from, *message);
      return MavResult::accepted;
    }
    case MavCmd::request_autopilot_capabilities:
      if (auto const version = report(MessageId::autopilot_version, view())) send(from, *version);
      return MavResult::accepted;
    case MavCmd::get_home_position:
      if (!autopilot_.home()) return MavResult::failed;
      broadcast_report(MessageId::home_position);
      broadcast_report(MessageId::gps_global_origin);
      return MavResult::accepted;
    default: return MavResult::unsupported;
  }
}

MavResult FlightController::set_mode(CommandInt const& command) {
  auto const base = static_cast<unsigned>(command.params[0]);
  if ((base & mode_flag::custom_mode_enabled) == 0) return MavResult::denied;
  return autopilot_.set_mode(static_cast<std::uint32_t>(command.params[1]));
}

MavResult FlightController::arm_disarm(CommandInt const& command) {
  auto const& p = command.params;
  if (p[0] == 1.0F) return autopilot_.arm(p[1] == force_arm);
  if (p[0] == 0.0F) return autopilot_.disarm(p[1] == force_disarm);
  return MavResult::unsupported;
}

/// What a crew sends that has changed the pack of a vehicle which was kept on: p1 a mask of batteries, p2 percent.
MavResult FlightController::battery_reset(CommandInt const& command) {
  auto const& p = command.params;
  bool const is_mask = p[0] >= 0.0F && p[0] < 65536.0F;
  if (!is_mask || (static_cast<unsigned>(p[0]) & 1U) == 0 || !(p[1] >= 0.0F && p[1] <= 100.0F))
    return MavResult::failed;
  autopilot_.battery().set_remaining(static_cast<double>(p[1]) / 100.0);
  return MavResult::accepted;
}

MavResult FlightController::reposition(CommandInt const& command) {
  auto const home = autopilot_.home();
  if (!home) return MavResult::denied;
  auto const& p = command.params;
  auto const& here = autopilot_.body().position_m;
  MissionItem item{.frame = command.frame, .command = command.command, .place = command.place};
  auto point = point_of(item, site_, *home, here);
  if (!std::isfinite(point.north) || !std::isfinite(point.east)) return MavResult::denied;
  if (!std::isfinite(point.down)) point.down = here.down;
  bool const change_mode = (static_cast<unsigned>(p[1]) & 1U) != 0;
  auto const result = autopilot_.reposition(point, change_mode, std::isfinite(p[2]) ? p[2] : 0.0);
  if (result == MavResult::accepted && p[0] > 0.0F) (void)autopilot_.change_speed(p[0]);
  return result;
}

/// p1: 0 off, 1 on, 2 the floor off, which a vehicle that lands does by itself here.
MavResult FlightController::enable_fence(CommandInt const& command) {
  auto const wanted = command.params[0];
  if (wanted != 0.0F && wanted != 1.0F && wanted != 2.0F) return MavResult::failed;
  if (wanted != 2.0F) autopilot_.enable_fence(wanted == 1.0F);
  return MavResult::accepted;
}

MavResult FlightController::set_home(CommandInt const& command) {
  auto const home = autopilot_.home();
  if (!home) return MavResult::failed;
  auto const& here = autopilot_.body().position_m;
  if (command.params[0] == 1.0F) {
    autopilot_.set_home(here);
    return MavResult::accepted;
  }
  MissionItem item{.frame = command.frame, .command = command.command, .place = command.place};
  autopilot_.set_home(point_of(item, site_, *home, here));
  return MavResult::accepted;
}

MavResult FlightController::set_interval(CommandInt const& command) {
  auto const id = message_id(command.params[0]);
  std::chrono::microseconds const interval(std::llround(command.params[1]));
  if (telemetry_.set_interval(id, interval, since_power_on()) == Telemetry::Answer::accepted)
    return MavResult::accepted;
  if (!is_px4())
    say(MavSeverity::info, "No ap_message for mavlink id (" + std::to_string(static_cast<unsigned>(id)) + ")");
  return MavResult::denied;
}

MavResult FlightController::get_interval(CommandInt const& command, Address from) {
  auto const id = message_id(command.params[0]);
  if (!telemetry_.knows(id)) return MavResult::denied;
  MessageInterval answer{.message = id, .interval = {}};
  if (auto const interval = telemetry_.interval(id)) {
    answer.interval = std::chrono::duration_cast<std::chrono::microseconds>(*interval);
  }
  send(from, answer);
  return MavResult::accepted;
}

MavResult FlightController::request_message(CommandInt const& command, Address from) {
  auto const id = message_id(command.params[0]);
  auto message = report(id, view());
  if (!message) message = payload_report(id, command.params[1]);
  if (message) {
    send(from, *message);
    return MavResult::accepted;
  }
  auto const frame = sensors(id);
  if (!frame) return MavResult::failed;
  send(from, *frame);
  return MavResult::accepted;
}

MavResult FlightController::reboot(CommandInt const& command) {
  if (command.params[0] != 1.0F && command.params[0] != 3.0F) return MavResult::unsupported;
  if (autopilot_.armed()) return MavResult::failed;
  reboot_requested_ = true;
  return MavResult::accepted;
}

}  // namespace lapwing::sim
