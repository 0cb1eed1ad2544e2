#pragma once

#include <optional>

#include "vehicle/aged.hpp"

namespace lapwing::vehicle {

/// What drives a robot: what it was last told, and whether it does as told. Where it is and how fast is its motion.
struct CarrierReport {
  double asked_speed_m_s = 0.0;
  std::optional<double> asked_yaw_rad = {};  ///< as a pose's yaw; nothing while it stands
  bool has_completed = false;                ///< it goes as it was asked to
  bool avoids_obstacle = false;              ///< something is nearer than its safe distance: it backs away instead
  bool is_killed = false;                    ///< it stands until an operator lets it go again
};

struct Carrier {
  Aged<CarrierReport> report;
};

}  // namespace lapwing::vehicle
