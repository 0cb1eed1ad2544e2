#include "slam/front_end.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Dense>

#include "slam/match/align.hpp"

namespace lapwing::slam {
namespace {

/// Whether the scan fixes its place in every direction.
bool is_pinned(Eigen::Matrix3d const& seen) {
  constexpr double enough = 250.0;  // ten points' worth across the weakest direction
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(seen.topLeftCorner<2, 2>()).eigenvalues()(0) > enough;
}

Eigen::Vector3d trust_of(OdometryNoise::Spread const& spread) {
  auto const shift = 1.0 / (spread.shift_m * spread.shift_m);
  return {shift, shift, 1.0 / (spread.turn_rad * spread.turn_rad)};
}

/// The search leaves the prediction only for a better fit: so much of the score a squared standard deviation costs.
SearchWindow window_of(OdometryNoise::Spread const& spread) {
  constexpr double cost_of_deviation = 0.003;
  constexpr double deviations = 5.0;
  return {.reach_m = std::clamp(deviations * spread.shift_m, 0.4, 0.8),
          .reach_rad = std::clamp(deviations * spread.turn_rad, 0.35, 0.6),
          .cost_per_m2 = cost_of_deviation / (spread.shift_m * spread.shift_m),
          .cost_per_rad2 = cost_of_deviation / (spread.turn_rad * spread.turn_rad)};
}

}  // namespace

bool FrontEnd::wants(Pose2 const& odometry) const {
  if (!last_odometry_) return true;
  return distance_m(*last_odometry_, odometry) >= options_.key_step_m ||
         turn_rad(*last_odometry_, odometry) >= options_.key_turn_rad;
}

Correlation FrontEnd::search(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                             Guess const& guess) {
  auto const count = static_cast<int>(frames.size());
  grid_.move_to(guess.pose);
  for (auto k = std::max(0, count - options_.grid_frames); k < count; ++k) grid_.add(frames[k].frame, poses[k]);
  return correlate(grid_, frame, guess.pose, window_of(guess.spread));
}

FrontEnd::Step FrontEnd::add(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                             Pose2 const& odometry) {
  if (!last_odometry_) {
    last_odometry_ = odometry;
    return {.pose = odometry, .constraint = std::nullopt};
  }
  auto const driven = between(*last_odometry_, odometry);
  last_odometry_ = odometry;
  auto const count = static_cast<int>(frames.size());
  Guess guess{.pose = poses.back() * driven, .spread = noise_.of(driven)};
  auto found = search(frames, poses, frame, guess);
  auto is_by_odometry = true;
  if (found.score < poor_share * usual_score_) {
    // Wheels that were lifted, or counters that began anew: as if it had gone on as before.
    Guess const onward{.pose = poses.back() * last_motion_, .spread = {.shift_m = 0.3, .turn_rad = 0.2}};
    auto const other = search(frames, poses, frame, onward);
    if (other.score > clearly_better * found.score) {
      guess = onward;
      found = other;
      is_by_odometry = false;
    }
  }
  usual_score_ += score_memory * (found.score - usual_score_);

  std::vector<Target> targets;
  for (int const back : {1, 2, 3, 5, 8})
    if (back <= count) targets.push_back({&frames[count - back].frame, poses[count - back]});
  auto const aligned = align(frame, found.pose, {.pose = guess.pose, .trust = trust_of(guess.spread)}, targets,
                             {.point_information = options_.point_information});
  if (is_by_odometry) noise_.learn(guess.pose, aligned.pose, is_pinned(aligned.seen));
  last_motion_ = between(poses.back(), aligned.pose);

  // The information is along the map's axes; the constraint is measured in the frame of the last key frame.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-poses.back().yaw).toRotationMatrix();
  return {.pose = aligned.pose,
          .constraint = Constraint{.from = count - 1,
                                   .to = count,
                                   .from_to = last_motion_,
                                   .information = options_.edge_share * turn * aligned.information * turn.transpose()}};
}

}  // namespace lapwing::slam
