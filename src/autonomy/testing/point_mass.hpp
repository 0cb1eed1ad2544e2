#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy::testing {

/// A copter as one point, with the manners of ArduPilot that matter here: it arms after a second and disarms ten
/// seconds later if nothing takes off, climbs only in GUIDED, follows setpoints there, and in RTL climbs, flies home,
/// waits and lands; on the ground it disarms. It flies every speed at once.
class PointMass {
 public:
  double drain_per_s = 1.0 / 1200.0;  ///< in the air
  bool can_return = true;

  [[nodiscard]] FlightController const& state() const { return flight_; }
  [[nodiscard]] geo::Point3<ArmingFrame> const& place() const { return place_; }

  void take(Said const& said) {
    for (auto const& request : said.requests) std::visit([this](auto const& one) { take(one); }, request);
  }

  void pass(base::Duration time) {
    double const s = base::to_seconds(time);
    arm_by_time(s);
    if (flight_.mode == return_home)
      fly_home(s);
    else if (flight_.mode == land_here)
      descend(s);
    else if (is_flying_ && target_)
      approach(*target_, s);
    if (is_flying_) *flight_.battery = std::max(0.0, *flight_.battery - drain_per_s * s);
    flight_.local = place_;
    flight_.relative_alt_m = place_.z();
    flight_.position = geo::displaced(home_place, {.north = place_.y(), .east = place_.x(), .down = -place_.z()});
  }

 private:
  void take(request::Mode const& one) {
    if (one.mode == return_home && !can_return) return;
    flight_.mode = one.mode;
    target_.reset();
    waited_s_ = 0;
    is_level_ = false;
  }
  void take(request::Arm const& one) {
    if (one.is_to_arm) {
      arms_in_s_ = 1.0;
    } else if (!is_flying_ || one.by_force) {
      disarm();
    }
  }
  void take(request::Takeoff const& one) {
    if (!flight_.is_armed || is_flying_ || flight_.mode != guided) return;
    is_flying_ = true;
    target_ = geo::Point3<ArmingFrame>(place_.x(), place_.y(), one.height_m);
  }
  void take(request::ReturnAltitude const& one) { return_height_m_ = one.height_m; }
  void take(request::LocalSetpoint const& one) {
    if (flight_.mode == guided && is_flying_) target_ = one.place;
  }
  void take(request::GlobalSetpoint const& one) {
    if (flight_.mode != guided || !is_flying_) return;
    auto const shift = geo::to_enu(geo::LocalFrame(home_place).ned_from(one.place));
    target_ = geo::Point3<ArmingFrame>(shift.east, shift.north, one.height_m);
  }

  void disarm() {
    flight_.is_armed = false;
    is_flying_ = false;
    ground_s_ = 0;
  }
  void arm_by_time(double s) {
    bool const is_arming = arms_in_s_ > 0;
    if (is_arming) arms_in_s_ -= s;
    if (is_arming && arms_in_s_ <= 0) flight_.is_armed = true;
    ground_s_ = flight_.is_armed && !is_flying_ ? ground_s_ + s : 0;
    if (ground_s_ > 10) disarm();
  }
  void approach(geo::Point3<ArmingFrame> const& target, double s) {
    double constexpr speed_m_s = 10, climb_m_s = 2.5;
    double const far_m = std::hypot(target.x() - place_.x(), target.y() - place_.y());
    double const share = far_m > 0 ? std::min(1.0, speed_m_s * s / far_m) : 0.0;
    double const up_m = std::clamp(target.z() - place_.z(), -climb_m_s * s, climb_m_s * s);
    place_ = geo::Point3<ArmingFrame>(place_.x() + share * (target.x() - place_.x()),
                                      place_.y() + share * (target.y() - place_.y()), place_.z() + up_m);
  }
  void fly_home(double s) {
    if (!is_flying_) return;
    double const top_m = is_level_ ? place_.z() : std::max(place_.z(), return_height_m_);
    if (waited_s_ <= 0 && place_.z() < top_m - 0.01) {
      approach(geo::Point3<ArmingFrame>(place_.x(), place_.y(), top_m), s);
      return;
    }
    is_level_ = true;
    if (std::hypot(place_.x(), place_.y()) > 0.1) {
      approach(geo::Point3<ArmingFrame>(0, 0, place_.z()), s);
      return;
    }
    waited_s_ += s;
    if (waited_s_ > 5) descend(s);
  }
  void descend(double s) {
    if (!is_flying_) return;
    double const down_m_s = place_.z() > 10 ? 1.5 : 0.5;
    place_ = geo::Point3<ArmingFrame>(place_.x(), place_.y(), std::max(0.0, place_.z() - down_m_s * s));
    if (place_.z() <= 0) disarm();
  }

  FlightController flight_ = *ready().flight;
  geo::Point3<ArmingFrame> place_;
  std::optional<geo::Point3<ArmingFrame>> target_;
  double return_height_m_ = 15;
  double arms_in_s_ = 0;
  double ground_s_ = 0;
  double waited_s_ = 0;
  bool is_flying_ = false;
  bool is_level_ = false;
};

}  // namespace lapwing::autonomy::testing
