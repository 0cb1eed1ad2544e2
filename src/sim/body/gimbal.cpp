#include "sim/body/gimbal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim {

using mavlink::MavCmd;
using mavlink::MavResult;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double lowest_rad = -90.0 * degree;
constexpr double highest_rad = 20.0 * degree;
constexpr double rate_rad_s = 90.0 * degree;

// MAV_MOUNT_MODE, parameter 7 of DO_MOUNT_CONTROL.
constexpr int mount_retract = 0;
constexpr int mount_neutral = 1;
constexpr int mount_angles = 2;

double towards(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

}  // namespace

void Gimbal::point_at(Angles angles) {
  region_of_interest_.reset();
  wanted_ = angles;
}

std::optional<MavResult> Gimbal::perform(MavCmd command, std::array<float, 4> const& params,
                                         mavlink::ItemPlace const& place, std::optional<geo::Ned> target) {
  auto const angle = [](float degrees, double otherwise) {
    return std::isfinite(degrees) ? static_cast<double>(degrees) * degree : otherwise;
  };
  switch (command) {
    case MavCmd::do_mount_control: {
      auto const mode = std::isfinite(place.z_m) ? static_cast<int>(std::clamp(place.z_m, -1.0, 100.0)) : -1;
      if (mode == mount_retract || mode == mount_neutral) {
        point_at({});
      } else if (mode == mount_angles) {
        point_at({angle(params[0], wanted_.pitch_rad), angle(params[2], wanted_.yaw_rad), false});
      } else {
        return MavResult::denied;
      }
      return MavResult::accepted;
    }
    case MavCmd::do_gimbal_manager_pitchyaw: {
      auto const flags = static_cast<unsigned>(std::clamp(place.x, 0.0, 65535.0));
      bool const from_north = (flags & mavlink::gimbal_flag::yaw_lock) != 0;
      point_at({angle(params[0], wanted_.pitch_rad), angle(params[1], wanted_.yaw_rad), from_north});
      return MavResult::accepted;
    }
    case MavCmd::do_set_roi:
    case MavCmd::do_set_roi_location:
      if (!target) return MavResult::denied;
      region_of_interest_ = target;
      return MavResult::accepted;
    case MavCmd::do_set_roi_none: point_at({}); return MavResult::accepted;
    default: return std::nullopt;
  }
}

void Gimbal::step(Body const& body, double dt_s) {
  vehicle_yaw_rad_ = body.attitude.yaw_rad;
  if (region_of_interest_) {
    double const north = region_of_interest_->north - body.position_m.north;
    double const east = region_of_interest_->east - body.position_m.east;
    double const down = region_of_interest_->down - body.position_m.down;
    wanted_ = {-std::atan2(down, std::hypot(north, east)), std::atan2(east, north), true};
  }
  // A change of the frame of yaw turns nothing.
  if (wanted_.yaw_is_from_north != yaw_is_from_north_) {
    yaw_rad_ = geo::wrap_pi(yaw_rad_ + (wanted_.yaw_is_from_north ? vehicle_yaw_rad_ : -vehicle_yaw_rad_));
    yaw_is_from_north_ = wanted_.yaw_is_from_north;
  }
  double const step_rad = rate_rad_s * dt_s;
  pitch_rad_ = towards(pitch_rad_, std::clamp(wanted_.pitch_rad, lowest_rad, highest_rad), step_rad);
  double const turn = std::clamp(geo::wrap_pi(wanted_.yaw_rad - yaw_rad_), -step_rad, step_rad);
  yaw_rad_ = geo::wrap_pi(yaw_rad_ + turn);
}

mavlink::GimbalDeviceAttitudeStatus Gimbal::status(base::Duration since_boot) const {
  using namespace mavlink::gimbal_flag;
  double const half_pitch = pitch_rad_ / 2.0;
  double const half_yaw = yaw_rad_ / 2.0;
  mavlink::GimbalDeviceAttitudeStatus status;
  status.since_boot = since_boot;
  status.flags = yaw_is_from_north_ ? yaw_lock | yaw_in_earth_frame : yaw_in_vehicle_frame;
  // No roll: yaw, then pitch.
  status.orientation = std::array{static_cast<float>(std::cos(half_yaw) * std::cos(half_pitch)),
                                  static_cast<float>(-std::sin(half_yaw) * std::sin(half_pitch)),
                                  static_cast<float>(std::cos(half_yaw) * std::sin(half_pitch)),
                                  static_cast<float>(std::sin(half_yaw) * std::cos(half_pitch))};
  status.delta_yaw_rad = vehicle_yaw_rad_;
  status.gimbal_device = 1;
  return status;
}

mavlink::GimbalManagerInformation Gimbal::information(base::Duration since_boot) {
  // GIMBAL_MANAGER_CAP_FLAGS: pitch and yaw axes, follow and lock of both, points at places.
  constexpr std::uint32_t capabilities = 0x8 | 0x10 | 0x20 | 0x40 | 0x80 | 0x100 | 0x10000 | 0x20000;
  constexpr auto pi = static_cast<float>(std::numbers::pi);
  return {.since_boot = since_boot,
          .capabilities = capabilities,
          .gimbal_device = 1,
          .roll_min_rad = 0.0,
          .roll_max_rad = 0.0,
          .pitch_min_rad = static_cast<float>(lowest_rad),
          .pitch_max_rad = static_cast<float>(highest_rad),
          .yaw_min_rad = -pi,
          .yaw_max_rad = pi};
}

}  // namespace lapwing::sim
