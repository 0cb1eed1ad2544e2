#pragma once

#include <optional>

#include "geo/position.hpp"
#include "vehicle/aged.hpp"
#include "vehicle/place.hpp"

namespace lapwing::vehicle {

struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

/// What a pilot's head-up display shows beside attitude and position.
struct Hud {
  std::optional<double> airspeed_m_s;
  std::optional<double> climb_m_s;
  std::optional<double> throttle;  ///< 0..1
};

struct Wind {
  double from_rad = 0.0;  ///< clockwise from true north
  double speed_m_s = 0.0;
};

/// Where it is and how it moves: on the globe, in the frame of a site, or in both.
struct Motion {
  Aged<geo::Wgs84> position;
  Aged<SitePose> site_pose;
  Aged<double> relative_alt_m;  ///< above home
  Aged<geo::Ned> velocity_m_s;
  Aged<Attitude> attitude;
  Aged<double> heading_rad;  ///< clockwise from true north
  Aged<bool> landed;
  Aged<Hud> hud;
  Aged<Wind> wind;
  Aged<geo::Wgs84> home;
  double track_m = 0.0;  ///< distance travelled since discovery

  /// Where it is, by what was heard last; nothing before anything was.
  [[nodiscard]] std::optional<Place> place() const;
};

}  // namespace lapwing::vehicle
