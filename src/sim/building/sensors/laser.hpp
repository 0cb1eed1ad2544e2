#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/building/noise.hpp"
#include "sim/building/scene/faces.hpp"

namespace lapwing::sim::building {

/// A turning scanner, or a ring of single ranges: angles to the left from the body's x axis.
struct LaserSettings {
  std::uint16_t beams = 360;  ///< 0: there is none
  double x_m = 0.0;           ///< in the body's frame
  double y_m = 0.0;
  double first_angle_rad = -3.141592653589793;
  double step_rad = 6.283185307179586 / 360.0;
  double range_m = 10.0;
  double shortest_m = 0.05;
  double period_s = 0.1;       ///< from scan to scan
  double duration_s = 0.1;     ///< from the first beam to the last; beams are measured while the robot moves on
  double noise_m = 0.01;       ///< standard deviation
  double noise_per_m = 0.001;  ///< more for each metre
  double lost = 0.002;         ///< probability that a beam comes back from nothing
  double lost_on_dark = 0.5;   ///< the same from something dark at half the range; nearer less, farther more
  /// So wide is a beam: of one that an edge cuts in two comes back what lies anywhere between (mixed pixels: Ye and
  /// Borenstein 2002, "Characterization of a 2-D laser scanner").
  double spot_rad = 0.0;
};

/// One whose beams are 5 mrad wide.
[[nodiscard]] LaserSettings wide_scanner();

/// A scanner at the front, `x_m` ahead, that sees half a circle before it up to 8 m.
[[nodiscard]] LaserSettings half_scanner(double x_m);

/// Four time-of-flight sensors, ahead, to the left, back and to the right, up to 4 m.
[[nodiscard]] LaserSettings tof_ring();

/// Measures beam by beam as time goes on.
class Laser {
 public:
  Laser(LaserSettings const& settings, std::uint64_t seed, std::uint32_t robot);

  /// What came by `now_s` since the last call, seen from where the body is. True when a scan has become whole.
  [[nodiscard]] bool sense(double now_s, Pose const& body, Surroundings const& around);

  struct Scan {
    double time_s = 0.0;                   ///< of the first beam
    std::vector<std::uint16_t> ranges_mm;  ///< 0: nothing came back
  };
  /// The last whole one.
  [[nodiscard]] Scan const& scan() const { return whole_; }

  /// One beam, without waiting for it and without a width.
  [[nodiscard]] std::uint16_t range_mm(Place const& from, double yaw_rad, Surroundings const& around);

 private:
  /// What comes back of a beam that an edge between it and the last one may cut in two.
  [[nodiscard]] std::uint16_t mixed_mm(std::uint16_t last_mm, std::uint16_t range_mm);

  LaserSettings settings_;
  Noise noise_;
  Scan begun_;
  std::uint16_t last_mm_ = 0;  ///< of the beam before, as if it had no width
  Scan whole_;
};

}  // namespace lapwing::sim::building
