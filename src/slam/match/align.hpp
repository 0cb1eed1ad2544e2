#pragma once

#include <span>

#include <Eigen/Core>

#include "slam/match/point_to_line.hpp"
#include "slam/pose2.hpp"

namespace lapwing::slam {

/// What a frame is laid upon: another, and where it stands.
struct Target {
  Frame const* frame = nullptr;
  Pose2 pose;
};

/// Where a frame was expected, and how firmly: 1 / m^2, 1 / m^2, 1 / rad^2.
struct Prior {
  Pose2 pose;
  Eigen::Vector3d trust = Eigen::Vector3d::Zero();
};

struct AlignOptions {
  int rounds = 6;
  int wide_rounds = 2;  ///< of these, how many begin with the wide association
  double point_information = 250.0;
  int stride = 1;  ///< every n-th point, each counting for n
};

struct Alignment {
  Pose2 pose;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< along the map's axes, the prior included
  Eigen::Matrix3d seen = Eigen::Matrix3d::Zero();         ///< that of the scan alone
};

/// Point to line against all targets at once, from `start`, held to the prior.
[[nodiscard]] Alignment align(Frame const& frame, Pose2 const& start, Prior const& prior,
                              std::span<Target const> targets, AlignOptions const& options);

}  // namespace lapwing::slam
