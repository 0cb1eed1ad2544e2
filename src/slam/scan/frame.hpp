#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// What a scan (or several, joined along odometry) says of the walls: points in the robot's frame with the walls'
/// directions, sorted by bearing around `centre` so that the points near any place are found by its bearing alone.
struct Frame {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  std::vector<Eigen::Vector2f> points;
  std::vector<Eigen::Vector2f> normals;  ///< towards the sensor; zero where the neighbours show no line
  std::vector<float> ranges;             ///< of each point, from the centre

  // Bins of bearing: those of bin b are points first_of_bin[b] up to first_of_bin[b + 1].
  float first_bearing = 0.0F;  ///< the lower edge of bin 0
  float bin_width = 0.0F;
  bool goes_round = false;  ///< the bins close a full circle
  std::vector<std::int32_t> first_of_bin;
  /// How far was seen free in each bin, from the centre; 0 where nothing came back.
  std::vector<float> free_of_bin;

  [[nodiscard]] int bins() const { return static_cast<int>(free_of_bin.size()); }
  [[nodiscard]] bool has_normal(std::size_t point) const { return normals[point] != Eigen::Vector2f::Zero(); }
};

struct FrameOptions {
  float least_range_m = 0.1F;
  float most_range_m = 30.0F;  ///< beyond, footprints of beams are wider than what they hit
};

/// Precondition: as many ranges as the sensor has beams.
[[nodiscard]] Frame frame_of(Scan const& scan, Sensor const& sensor, FrameOptions const& options);

/// Gives each point the normal of the line through its neighbours in the order of bearing, where they lie on one.
/// `beam_step_rad`: between neighbouring beams.
void find_normals(Frame& frame, float beam_step_rad);

}  // namespace lapwing::slam
