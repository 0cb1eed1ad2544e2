#pragma once

#include <optional>
#include <string_view>

#include "vehicle/aged.hpp"

namespace lapwing::vehicle {

struct Gps {
  int fix = 0;  ///< as GPS_FIX_TYPE counts: `gps_fix_name`
  std::optional<int> satellites;
  std::optional<double> hdop;
};
/// "no fix", "3D", "RTK fixed" ...
[[nodiscard]] std::string_view gps_fix_name(int fix);

/// How far the estimator's innovations are from what it trusts: above 1 it does not believe the sensor; above 0.8
/// ArduPilot's failsafe acts by default.
struct Estimator {
  std::optional<double> velocity;
  std::optional<double> position_horizontal;
  std::optional<double> position_vertical;
  std::optional<double> compass;
};

/// By what it knows where it is, and how well.
struct Positioning {
  Aged<Gps> gps;
  Aged<Estimator> estimator;
};

}  // namespace lapwing::vehicle
