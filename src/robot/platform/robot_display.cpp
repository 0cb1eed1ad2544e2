#include "robot/platform/robot_display.hpp"

#include <numbers>

namespace lapwing::robot {

void show(RobotMoment const& moment, base::TimePoint now, vehicle::VehicleState& state) {
  auto const& reading = moment.reading;
  state.links.heard = state.links.heartbeat_heard = now;
  state.motion.track_m = moment.driven_m;
  state.arming.armed.set(!reading.is_killed, now);
  if (reading.battery) {
    vehicle::Battery battery;
    battery.remaining = *reading.battery;
    state.power.battery.set(battery, now);
  }
  state.carrier.report.set({.asked_speed_m_s = moment.asked.speed_m_s,
                            .has_completed = moment.stands,
                            .avoids_obstacle = reading.is_too_near,
                            .is_killed = reading.is_killed},
                           now);
  if (!moment.pose) return;
  state.motion.site_pose.set(*moment.pose, now);
  // For those who know no site; of the same moment.
  if (moment.place) state.motion.position.set(*moment.place, now);
  state.motion.heading_rad.set(geo::wrap_two_pi(std::numbers::pi / 2.0 - moment.pose->yaw_rad), now);
}

}  // namespace lapwing::robot
