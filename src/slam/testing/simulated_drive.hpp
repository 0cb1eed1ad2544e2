#pragma once

#include <cstdint>
#include <vector>

#include "slam/log/scan_log.hpp"

namespace lapwing::slam::testing {

/// Walls as straight pieces, in metres.
struct Wall {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};
using Building = std::vector<Wall>;

/// A ring of corridors, 2 m wide, around a block of `width` by `height` metres (their middle lines), with doors' niches
/// and offices every `spacing` metres. `variety` 0: every office is like every other; 1: each has furniture of its own.
[[nodiscard]] Building office(double width, double height, double spacing, double variety, std::uint64_t seed);

/// A corridor 2 m wide along x, from which `teeth` others, all alike, go off to the left every `apart` metres.
[[nodiscard]] Building comb(int teeth, double apart, double depth);
/// The way through the first corridor, into each of the others and back out, and home.
[[nodiscard]] std::vector<Eigen::Vector2d> way_through_comb(int teeth, double apart, double depth);

struct DriveOptions {
  int beams = 181;
  double field_of_view_rad = 3.14159265358979;
  double most_range_m = 30.0;
  double range_noise_m = 0.015;
  double speed_m_s = 0.5;
  double scans_per_s = 5.0;
  double turn_rad_per_scan = 0.12;
  double shift_noise = 0.05;       ///< of odometry: standard deviation of a step, per metre
  double turn_noise = 0.02;        ///< per radian
  double turn_noise_per_m = 0.01;  ///< radians per metre
  double scale_bias = 0.02;        ///< every metre is told as so much more
  double turn_bias_per_m = 0.003;  ///< radians: the robot pulls to one side
  /// Its beams are taken one after the other on the way from the place of the scan before, and not at once.
  bool turns_while_driving = false;
  std::uint64_t seed = 1;
};

struct Drive {
  ScanLog log;
  std::vector<Pose2> truth;  ///< one a scan
};

/// Drives along the way points, turning on the spot at each. Equal for equal seeds.
[[nodiscard]] Drive drive(Building const& building, std::vector<Eigen::Vector2d> const& way,
                          DriveOptions const& options);

/// How far the mapped poses are from the true ones, when laid upon them as well as can be: the greatest of all.
[[nodiscard]] double greatest_error_m(std::vector<Pose2> const& mapped, std::vector<Pose2> const& truth);

}  // namespace lapwing::slam::testing
