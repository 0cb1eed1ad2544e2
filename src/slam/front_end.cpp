#include "slam/front_end.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

namespace lapwing::slam {
namespace {

/// Whether the scan fixes its place in every direction.
bool is_pinned(Eigen::Matrix3d const& seen) {
  constexpr double enough = 250.0;  // ten points' worth across the weakest direction
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(seen.topLeftCorner<2, 2>()).eigenvalues()(0) > enough;
}

/// Of a search's fit: what fits less well, as leaves and legs do, may have been found anywhere.
constexpr double well = 0.45;

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

std::size_t points_of_last(std::vector<KeyFrame> const& frames, int most) {
  std::size_t points = 0;
  for (auto k = std::ssize(frames) - last_on_the_way(frames, most); k < std::ssize(frames); ++k)
    points += frames[static_cast<std::size_t>(k)].frame.points.size();
  return points;
}

Eigen::Vector3d trust_of(OdometryNoise::Spread const& spread) {
  auto const shift = 1.0 / (spread.shift_m * spread.shift_m);
  return {shift, shift, 1.0 / (spread.turn_rad * spread.turn_rad)};
}

/// Of where the robot is after a step of which odometry says nothing true.
constexpr OdometryNoise::Spread unknown{.shift_m = 0.3, .turn_rad = 0.2};

/// Whether odometry that is as good as that errs so seldom.
bool is_beyond(double deviations, Pose2 const& error, OdometryNoise::Spread const& spread) {
  return std::hypot(error.x, error.y) > deviations * std::numbers::sqrt2 * spread.shift_m ||
         std::abs(error.yaw) > deviations * spread.turn_rad;
}

/// Whether a key frame's step was wrong as a whole.
bool is_gross(Pose2 const& error) {
  return std::hypot(error.x, error.y) > 0.2 || std::abs(error.yaw) > 0.2;
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
  return !last_odometry_ || is_a_step(between(*last_odometry_, odometry));
}

bool FrontEnd::is_a_step(Pose2 const& motion) const {
  return std::hypot(motion.x, motion.y) >= options_.key_step_m || std::abs(motion.yaw) >= options_.key_turn_rad;
}

FrontEnd::SeenMotion FrontEnd::seen_motion(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                           Frame const& frame) {
  draw_last(frames, poses, poses.back());
  auto window = window_of(unknown);
  window.reach_m = 0.4;  // enough since it was looked at last, and a sixth of the time
  window.reach_rad = 0.35;
  auto const found = correlate(grid_, frame, poses.back(), window).pose;
  std::vector<Target> const last{{&frames.back().frame, poses.back()}};
  auto const aligned = align(frame, found, {.pose = found, .trust = trust_of(unknown)}, last,
                             {.point_information = options_.point_information});
  return {between(poses.back(), aligned.pose), is_pinned(aligned.seen)};
}

void FrontEnd::draw_last(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Pose2 const& around) {
  auto const count = static_cast<int>(frames.size());
  grid_.move_to(around);
  for (auto k = count - last_on_the_way(frames, options_.grid_frames); k < count; ++k)
    grid_.add(frames[k].frame, poses[k]);
}

FrontEnd::Found FrontEnd::search(Frame const& frame, Guess const& guess) const {
  auto const found = correlate(grid_, frame, guess.pose, window_of(guess.spread));
  auto const slid = options_.may_slip ? correlate_along(grid_, frame, found) : std::nullopt;
  return slid && slid->score > well ? Found{slid->pose, slid->score, true} : Found{found.pose, found.score, false};
}

FrontEnd::Guess FrontEnd::by_odometry(Pose2 const& last, Pose2 const& driven) const {
  auto spread = noise_.of(driven);
  spread.shift_m *= options_.odometry_spread;
  spread.turn_rad *= options_.odometry_spread;
  return {.pose = last * driven, .spread = spread};
}

FrontEnd::Guess FrontEnd::by_walls(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                   Frame const& frame, Guess guess) {
  auto const expected_rad = std::hypot(heading_sigma_rad_, guess.spread.turn_rad);
  auto const told = compass_.heading(frames, poses, frame, {guess.pose.yaw, expected_rad});
  heading_sigma_rad_ = expected_rad;
  if (!told) return guess;
  auto const both_rad = std::hypot(expected_rad, told->sigma_rad);
  auto const share = expected_rad / both_rad;
  guess.pose.yaw += share * share * (told->yaw_rad - guess.pose.yaw);
  heading_sigma_rad_ = share * told->sigma_rad;
  guess.spread.turn_rad = std::min(guess.spread.turn_rad, heading_sigma_rad_);
  return guess;
}

bool FrontEnd::is_misleading(Pose2 const& driven, OdometryDoubt doubt, Frame const& last, Frame const& now) {
  constexpr double farthest_m = 3.0;  // that a robot may have gone while nothing was recorded
  if (doubt == OdometryDoubt::has_spun) return true;
  // What odometry missed while it was frozen it may tell now, all at once, though it is known.
  auto const was_frozen = std::exchange(is_frozen_, doubt == OdometryDoubt::has_frozen);
  if (is_frozen_ || was_frozen) return true;
  // Counters that began anew: what is seen is what was seen just now. After a gap in the recording something else is
  // seen, and odometry is right.
  return doubt == OdometryDoubt::has_leapt && (std::hypot(driven.x, driven.y) > farthest_m || look_alike(now, last));
}

Alignment FrontEnd::lay_on_last(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                Frame const& frame, Pose2 const& found, Guess const& guess) const {
  auto const count = static_cast<int>(frames.size());
  std::vector<Target> targets;
  constexpr int farthest_back = 8;
  auto const reach = last_on_the_way(frames, farthest_back);
  for (int const back : {1, 2, 3, 5, farthest_back})
    if (back <= reach) targets.push_back({&frames[count - back].frame, poses[count - back]});
  auto const held_to = [&](Guess const& expected) {
    return align(frame, found, {.pose = expected.pose, .trust = trust_of(expected.spread)}, targets,
                 {.point_information = options_.point_information});
  };
  // Who was wrong a moment ago is not asked where the scan shows by itself where it was taken.
  constexpr double unusual = 2.0;
  if (distrusted_ > 0 && is_beyond(unusual, between(guess.pose, found), guess.spread))
    if (auto const alone = held_to({.pose = found, .spread = unknown}); is_pinned(alone.seen)) return alone;
  return held_to(guess);
}

FrontEnd::Step FrontEnd::add(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses, Frame const& frame,
                             Pose2 const& odometry, OdometryDoubt doubt) {
  if (!last_odometry_) {
    last_odometry_ = odometry;
    return {.pose = start_.value_or(odometry), .constraint = std::nullopt};
  }
  auto const driven = between(*last_odometry_, odometry);
  last_odometry_ = odometry;
  auto const count = static_cast<int>(frames.size());
  auto const told = by_odometry(poses.back(), driven);
  auto const is_misled = is_misleading(driven, doubt, frames.back().frame, frame);
  // Wheels that spin do not turn the robot beside what its odometry says.
  auto const unmisled = doubt == OdometryDoubt::has_spun ? Pose2{.yaw = driven.yaw} : last_motion_;
  auto const by_last = is_misled ? Guess{.pose = poses.back() * unmisled, .spread = unknown} : told;
  auto const guess = options_.heads_by_walls ? by_walls(frames, poses, frame, by_last) : by_last;
  draw_last(frames, poses, guess.pose);
  // What begins with a single look of a few rangers shows no place.
  constexpr std::size_t enough_to_know = 20;
  bool const knows_place = points_of_last(frames, options_.grid_frames) >= enough_to_know;
  auto const found = knows_place ? search(frame, guess) : Found{guess.pose, 0.0, false};
  auto const is_wrong = is_misled || found.has_slipped;
  auto const error = between(told.pose, found.pose);
  constexpr double incredible = 4.5;
  // By how well the wheels have done, not by how much they are trusted. A search that ends elsewhere by a hair, as
  // along a corridor, refutes nothing.
  constexpr double clearly = 0.06;
  // Nor does one that fits by a few points and nothing holds.
  auto const shows_where = [&] {
    return found.fit > well ||
           is_pinned(lay_on_last(frames, poses, frame, found.pose, {.pose = found.pose, .spread = unknown}).seen);
  };
  auto const is_refuted = is_wrong || (options_.may_be_refuted && is_beyond(incredible, error, noise_.of(driven)) &&
                                       found.fit > fit(grid_, frame, told.pose) + clearly && shows_where());
  auto const held_to = is_refuted ? Guess{.pose = found.pose, .spread = unknown} : guess;
  auto const aligned = lay_on_last(frames, poses, frame, found.pose, held_to);
  constexpr int while_distrusted = 5;
  auto const is_broken = is_wrong || (is_refuted && is_gross(error));
  distrusted_ = is_broken ? while_distrusted : std::max(0, distrusted_ - 1);
  if (!is_broken) noise_.learn(driven, told.pose, aligned.pose, is_pinned(aligned.seen));
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
