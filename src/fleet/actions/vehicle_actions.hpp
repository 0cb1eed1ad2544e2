#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/exchange/command.hpp"

/// What the ground does to a vehicle outside the mission itself. Each is one coroutine; each is confirmed by the
/// vehicle's state, not by an acknowledgement alone; each failure gives the vehicle's own reason where it gave one.
namespace lapwing::fleet {

/// What a vehicle does when a mission is stopped on it.
enum class OnStop {
  loiter,  ///< stay in place: copter BRAKE, plane LOITER, rover HOLD
  rtl,
  land,
};
/// The word on the command line, or nothing.
[[nodiscard]] std::optional<OnStop> on_stop_from(std::string_view word);

/// Whether the vehicle's last heartbeat showed the mode in which it flies its mission.
[[nodiscard]] bool in_mission_mode(MavlinkVehicle const& craft);
/// Name of a mode of this vehicle.
[[nodiscard]] std::string mode_name(MavlinkVehicle const& craft, std::uint32_t custom_mode);
/// The first reason that the vehicle gave at or after `since`; its standing arming objection ("PreArm: ...") otherwise;
/// or empty.
[[nodiscard]] std::string given_reason(MavlinkVehicle const& craft, base::TimePoint since);

/// This station asks for the mode, so that it is nobody else's doing when the vehicle shows it.
void note_asked_mode(MavlinkVehicle& craft, std::optional<std::uint32_t> custom_mode, base::TimePoint now);

/// How a command of this page is sent.
struct ActionOptions {
  base::TimePoint not_after = base::TimePoint::max();  ///< nothing is sent later
  bool is_urgent = false;                              ///< a stop: overtakes what else is on its way
  std::function<void()> on_accepted = {};              ///< the vehicle has acknowledged the deciding command
};

struct ModeChange {
  std::uint32_t custom_mode = 0;
  bool even_if_shown =
      false;  ///< command it although the vehicle seems to be in it: another mode may be on its way there
  int tries = 5;
  ActionOptions how = {};
};
/// Commands the mode until a heartbeat shows it. Errors: refused (at once), timed_out, those of Connection::send.
base::Task<base::Result<>> change_mode(mavlink::Connection& connection, MavlinkVehicle& craft, ModeChange change);

/// What it lacks to begin a mission, and what it has against arming: "no position estimate; PreArm: Need Position
/// Estimate". Empty when nothing is missing.
[[nodiscard]] std::string why_not_ready(MavlinkVehicle const& craft);

/// Waits until the vehicle knows where it is and, for a few seconds more, until it has no objection to arming.
/// Error: timed_out, with what is missing.
base::Task<base::Result<>> wait_until_ready(MavlinkVehicle& craft, base::Loop& loop, base::Duration patience);

/// Takes the vehicle out of its mission mode; does nothing if it is not in it and not on the way there.
base::Task<base::Result<>> leave_mission(mavlink::Connection& connection, MavlinkVehicle& craft, OnStop on_stop);

/// Arms, in a mode that allows it, until a heartbeat shows it.
base::Task<base::Result<>> arm(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how);

/// Arms and begins the mission it holds within the time in which an autopilot disarms again by itself. When it does not
/// begin, what was armed for it is disarmed.
base::Task<base::Result<>> arm_and_start(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how);

/// Takes back an arming, until a heartbeat shows it. An autopilot in the air refuses it.
base::Task<base::Result<>> disarm(mavlink::Connection& connection, MavlinkVehicle& craft, ActionOptions how);

/// What stops a vehicle of whose autopilot no modes are known, in the order in which it is tried.
[[nodiscard]] std::array<mavlink::Command, 4> stops_without_mode(OnStop on_stop);

/// Puts the vehicle into its stop mode; a flying machine that stands on the ground is disarmed.
base::Task<base::Result<>> bring_to_rest(mavlink::Connection& connection, MavlinkVehicle& craft, OnStop on_stop,
                                         std::function<void()> on_accepted);

}  // namespace lapwing::fleet
