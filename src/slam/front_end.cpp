#include "slam/front_end.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "slam/match/point_to_line.hpp"

namespace lapwing::slam {
namespace {

struct Alignment {
  Pose2 pose;
  Eigen::Matrix3d information;  ///< along the map's axes, prediction included
  Eigen::Matrix3d seen;         ///< that of the scan alone
};

/// Point to line against some of the last key frames, held to the prediction by odometry.
Alignment align(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                Pose2 const& start, Pose2 const& predicted, OdometryNoise::Spread const& spread,
                double point_information) {
  constexpr int rounds = 6;
  constexpr Association wide{.gate_m = 0.25, .scale_m = 0.08};
  constexpr Association narrow{.gate_m = 0.12, .scale_m = 0.03};
  auto const last = static_cast<int>(frames.size());
  Eigen::Vector3d const trust(1.0 / (spread.shift_m * spread.shift_m), 1.0 / (spread.shift_m * spread.shift_m),
                              1.0 / (spread.turn_rad * spread.turn_rad));
  Alignment result{start, {}, {}};
  for (int round = 0; round < rounds; ++round) {
    result.seen.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (int back : {1, 2, 3, 5, 8}) {
      if (back > last) break;
      auto const term =
          point_to_line(frame, result.pose, frames[last - back].frame, poses[last - back], round < 2 ? wide : narrow);
      if (!term.is_usable()) continue;
      result.seen += point_information * term.hessian.topLeftCorner<3, 3>();
      gradient += point_information * term.gradient.head<3>();
    }
    result.information = result.seen;
    result.information.diagonal() += trust;
    Eigen::Vector3d off = numbers(result.pose) - numbers(predicted);
    off.z() = geo::wrap_pi(off.z());
    gradient += trust.cwiseProduct(off);
    Eigen::Vector3d const step = result.information.ldlt().solve(-gradient);
    result.pose = stepped(result.pose, step);
    if (step.norm() < 1e-3) break;
  }
  return result;
}

/// Whether the scan fixes its place in every direction.
bool is_pinned(Eigen::Matrix3d const& seen) {
  constexpr double enough = 250.0;  // ten points' worth across the weakest direction
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(seen.topLeftCorner<2, 2>()).eigenvalues()(0) > enough;
}

}  // namespace

bool FrontEnd::wants(Pose2 const& odometry) const {
  if (!last_odometry_) return true;
  return distance_m(*last_odometry_, odometry) >= options_.key_step_m ||
         turn_rad(*last_odometry_, odometry) >= options_.key_turn_rad;
}

FrontEnd::Step FrontEnd::add(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                             Pose2 const& odometry) {
  if (!last_odometry_) {
    last_odometry_ = odometry;
    return {.pose = odometry, .constraint = std::nullopt};
  }
  auto const driven = between(*last_odometry_, odometry);
  last_odometry_ = odometry;
  auto const predicted = poses.back() * driven;
  auto const spread = noise_.of(driven);
  auto const count = static_cast<int>(frames.size());
  grid_.move_to(predicted);
  for (auto k = std::max(0, count - options_.grid_frames); k < count; ++k) grid_.add(frames[k].frame, poses[k]);

  // The search leaves the prediction only for a better fit: so much of the score a squared standard deviation costs.
  constexpr double cost_of_deviation = 0.003;
  constexpr double deviations = 5.0;
  SearchWindow const window{.reach_m = std::clamp(deviations * spread.shift_m, 0.4, 0.8),
                            .reach_rad = std::clamp(deviations * spread.turn_rad, 0.35, 0.6),
                            .cost_per_m2 = cost_of_deviation / (spread.shift_m * spread.shift_m),
                            .cost_per_rad2 = cost_of_deviation / (spread.turn_rad * spread.turn_rad)};
  auto const found = correlate(grid_, frame, predicted, window);
  auto const aligned = align(frames, poses, frame, found, predicted, spread, options_.point_information);
  noise_.learn(predicted, aligned.pose, is_pinned(aligned.seen));

  // The information is along the map's axes; the constraint is measured in the frame of the last key frame.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-poses.back().yaw).toRotationMatrix();
  return {.pose = aligned.pose,
          .constraint = Constraint{.from = count - 1,
                                   .to = count,
                                   .from_to = between(poses.back(), aligned.pose),
                                   .information = options_.edge_share * turn * aligned.information * turn.transpose()}};
}

}  // namespace lapwing::slam
