#include "slam/front_end.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "slam/match/align.hpp"

namespace lapwing::slam {
namespace {

/// Whether the scan fixes its place in every direction.
bool is_pinned(Eigen::Matrix3d const& seen) {
  constexpr double enough = 250.0;  // ten points' worth across the weakest direction
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(seen.topLeftCorner<2, 2>()).eigenvalues()(0) > enough;
}

/// Whether most beams of the two end at about the same range.
bool look_alike(Frame const& a, Frame const& b) {
  constexpr double most = 0.7;
  constexpr float near_m = 0.2F;
  constexpr float share = 0.1F;
  if (a.bins() != b.bins()) return false;
  int seen = 0;
  int same = 0;
  for (std::size_t bin = 0; bin < a.free_of_bin.size(); ++bin) {
    auto const x = a.free_of_bin[bin];
    auto const y = b.free_of_bin[bin];
    if (x == 0.0F && y == 0.0F) continue;
    ++seen;
    same += std::abs(x - y) < near_m + share * x ? 1 : 0;
  }
  return same > most * seen;
}

/// How many of the last key frames were taken on one way, up to `most`.
int last_on_the_way(std::vector<KeyFrame> const& frames, int most) {
  int found = 0;
  for (auto frame = frames.rbegin(); frame != frames.rend() && found < most; ++frame) {
    ++found;
    if (frame->is_cut) break;
  }
  return found;
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

void FrontEnd::remember(Memory const& memory) {
  last_odometry_ = memory.last_odometry;
  last_motion_ = memory.last_motion;
  noise_.remember(memory.noise);
}

void FrontEnd::begin_at(Pose2 const& start) {
  start_ = start;
  last_odometry_.reset();
  last_motion_ = {};
}

bool FrontEnd::wants(Pose2 const& odometry) const {
  if (!last_odometry_) return true;
  return distance_m(*last_odometry_, odometry) >= options_.key_step_m ||
         turn_rad(*last_odometry_, odometry) >= options_.key_turn_rad;
}

FrontEnd::Found FrontEnd::search(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                 Frame const& frame, Guess const& guess) {
  auto const count = static_cast<int>(frames.size());
  grid_.move_to(guess.pose);
  for (auto k = count - last_on_the_way(frames, options_.grid_frames); k < count; ++k)
    grid_.add(frames[k].frame, poses[k]);
  auto const found = correlate(grid_, frame, guess.pose, window_of(guess.spread));
  auto const slid = options_.may_slip ? correlate_along(grid_, frame, found) : std::nullopt;
  return slid ? Found{slid->pose, true} : Found{found.pose, false};
}

FrontEnd::Step FrontEnd::add(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                             Pose2 const& odometry, bool has_leapt) {
  if (!last_odometry_) {
    last_odometry_ = odometry;
    return {.pose = start_.value_or(odometry), .constraint = std::nullopt};
  }
  auto const driven = between(*last_odometry_, odometry);
  last_odometry_ = odometry;
  auto const count = static_cast<int>(frames.size());
  auto spread = noise_.of(driven);
  spread.shift_m *= options_.odometry_spread;
  spread.turn_rad *= options_.odometry_spread;
  Guess guess{.pose = poses.back() * driven, .spread = spread};
  // Counters that began anew: what is seen is what was seen just now, so it went on as before. After a gap in the
  // recording something else is seen, and odometry is right.
  constexpr double farthest_m = 3.0;  // that a robot may have gone while nothing was recorded
  constexpr OdometryNoise::Spread unknown{.shift_m = 0.3, .turn_rad = 0.2};
  auto is_misled = has_leapt && (std::hypot(driven.x, driven.y) > farthest_m || look_alike(frame, frames.back().frame));
  if (is_misled) guess = {.pose = poses.back() * last_motion_, .spread = unknown};
  auto const found = search(frames, poses, frame, guess);
  if (found.has_slipped) {
    guess = {.pose = found.pose, .spread = unknown};
    is_misled = true;
  }

  std::vector<Target> targets;
  constexpr int farthest_back = 8;
  auto const reach = last_on_the_way(frames, farthest_back);
  for (int const back : {1, 2, 3, 5, farthest_back})
    if (back <= reach) targets.push_back({&frames[count - back].frame, poses[count - back]});
  auto const aligned = align(frame, found.pose, {.pose = guess.pose, .trust = trust_of(guess.spread)}, targets,
                             {.point_information = options_.point_information});
  if (!is_misled) noise_.learn(driven, guess.pose, aligned.pose, is_pinned(aligned.seen));
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
