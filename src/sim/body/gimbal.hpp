#pragma once

#include <array>
#include <optional>

#include "mavlink/codec/messages.hpp"
#include "sim/body/dynamics.hpp"
#include "sim/model/site.hpp"

namespace lapwing::sim {

/// A two-axis gimbal wired to the autopilot: turns to commanded angles or keeps a point on the ground in sight.
class Gimbal {
 public:
  /// What became of a command; nothing for one that is not for gimbals. `target` is the place of the command, if it has
  /// one.
  std::optional<mavlink::MavResult> perform(mavlink::MavCmd command, std::array<float, 4> const& params,
                                            mavlink::ItemPlace const& place, std::optional<geo::Ned> target);
  void step(Body const& body, double dt_s);

  [[nodiscard]] mavlink::GimbalDeviceAttitudeStatus status(base::Duration since_boot) const;
  [[nodiscard]] static mavlink::GimbalManagerInformation information(base::Duration since_boot);
  [[nodiscard]] double pitch_rad() const { return pitch_rad_; }
  /// From north when it keeps a heading, else from the vehicle's nose.
  [[nodiscard]] double yaw_rad() const { return yaw_rad_; }

 private:
  struct Angles {
    double pitch_rad = 0.0;
    double yaw_rad = 0.0;
    bool yaw_is_from_north = false;
  };
  void point_at(Angles angles);

  Angles wanted_;
  std::optional<geo::Ned> region_of_interest_;
  double pitch_rad_ = 0.0;
  double yaw_rad_ = 0.0;
  bool yaw_is_from_north_ = false;
  double vehicle_yaw_rad_ = 0.0;
};

}  // namespace lapwing::sim
