#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware/frames/description.hpp"

namespace lapwing::robot {

/// One sonar's word: where it looks, as the board described it, and how far the nearest thing is.
struct SonarReading {
  firmware::SonarPlace place;
  std::optional<double> range_m;  ///< from the sonar; none: no echo, or one that is not believed
};

/// 147 us of pulse width an inch. None: no echo, or one from beyond the sonar's longest range.
[[nodiscard]] std::optional<double> range_of_echo(std::uint16_t echo_us, firmware::SonarPlace const& place);

/// Distances of walls from the middle of the axle: the three numbers of the seed's sensor interface.
struct WallDistances {
  std::optional<double> left_m;
  std::optional<double> front_m;
  std::optional<double> right_m;
};

/// The seed's AggregateSonarData. A side's wall is the line through the echoes of its slanted and its square sonar,
/// where such a line is plausible (within 40 degrees of the body's x axis), and its distance is the perpendicular; with
/// one echo the wall is taken to be parallel to the body. Ahead it is the nearest echo in the body's path.
[[nodiscard]] WallDistances wall_distances(std::span<SonarReading const> sonars, firmware::Hull const& hull);

}  // namespace lapwing::robot
