#pragma once

#include <cstdint>

#include "sim/building/noise.hpp"
#include "sim/building/scene/faces.hpp"

namespace lapwing::sim::building {

/// An ultrasonic sensor that tells its range as the width of a pulse.
struct SonarSettings {
  double x_m = 0.0;  ///< in the body's frame
  double y_m = 0.0;
  double angle_rad = 0.0;
  double half_cone_rad = 0.13;  ///< about an HC-SR04's or a MaxSonar's
  double range_m = 5.0;
  double shortest_m = 0.03;
  double noise_m = 0.008;    ///< standard deviation: the seed's +-2 cm hold for 99 of 100
  double lost = 0.005;       ///< probability that an echo is not heard though there is one
  double second_echo = 0.2;  ///< that one mirrored away comes back over something else
};

/// The echo of one pulse in microseconds of pulse width (147 an inch); 0: none.
///
/// Sound is mirrored by what is smooth: a wall gives an echo where its normal points into the cone, with a margin for
/// its roughness, and is not heard where it is met more aslant. Edges and corners scatter, cloth does too and swallows:
/// it is heard up to half the range.
[[nodiscard]] std::uint16_t echo_us(SonarSettings const& settings, Place const& from, double yaw_rad,
                                    Surroundings const& around, Noise& noise);

}  // namespace lapwing::sim::building
