#include "slam/match/scan_odometry.hpp"

#include <algorithm>
#include <vector>

#include "slam/match/align.hpp"

namespace lapwing::slam {
namespace {

// A robot or drone indoors changes its speed by about so much from scan to scan.
constexpr double shift_sigma_m = 0.12;
constexpr double turn_sigma_rad = 0.12;
constexpr SearchWindow window{.reach_m = 0.4,
                              .reach_rad = 0.4,
                              .cost_per_m2 = 0.003 / (shift_sigma_m * shift_sigma_m),
                              .cost_per_rad2 = 0.003 / (turn_sigma_rad * turn_sigma_rad)};
constexpr double keep_step_m = 0.15;
constexpr double keep_turn_rad = 0.1;
constexpr std::size_t kept = 10;

}  // namespace

Pose2 ScanOdometry::follow(Frame const& frame, LogTime time) {
  if (!since_) {
    since_ = {time, pose_};
    time_ = time;
    keep(frame);
    return pose_;
  }
  constexpr double longest_s = 1.0;  // after a longer gap nobody knows how it went on
  auto const elapsed = std::clamp((time - time_).count(), 0.0, longest_s);
  time_ = time;
  Eigen::Vector3d const motion = speed_ * elapsed;
  auto const predicted = pose_ * Pose2{motion.x(), motion.y(), motion.z()};
  auto const found = search(frame, predicted);
  std::vector<Target> targets;
  auto const count = static_cast<int>(last_.size());
  for (int const back : {1, 2, 4, 7})
    if (back <= count)
      targets.push_back(
          {&last_[static_cast<std::size_t>(count - back)].frame, last_[static_cast<std::size_t>(count - back)].pose});
  Prior const prior{.pose = found.predicted,
                    .trust = {1.0 / (shift_sigma_m * shift_sigma_m), 1.0 / (shift_sigma_m * shift_sigma_m),
                              1.0 / (turn_sigma_rad * turn_sigma_rad)}};
  auto const aligned = align(frame, found.pose, prior, targets, {});
  auto const next = aligned.seen.isZero() ? found.pose : aligned.pose;  // too few points for lines
  step_ = between(pose_, next);
  pose_ = next;
  note_speed(time);
  auto const& newest = last_.back().pose;
  if (distance_m(newest, pose_) >= keep_step_m || turn_rad(newest, pose_) >= keep_turn_rad) keep(frame);
  return pose_;
}

/// Where the robot would be by its speed and the stamps, or where it would be if it went on by as much as from the scan
/// before to the last one, whichever fits better: of stamps that come in bursts the one says little, of scans that are
/// left out the other.
ScanOdometry::Found ScanOdometry::search(Frame const& frame, Pose2 const& by_speed) const {
  constexpr double same_m = 0.1;
  constexpr double same_rad = 0.1;
  constexpr double clearly = 0.03;  // along a corridor many places fit alike
  auto const by_step = pose_ * step_;
  auto const found = correlate(grid_, frame, by_speed, window);
  if (distance_m(by_speed, by_step) < same_m && turn_rad(by_speed, by_step) < same_rad) return {found.pose, by_speed};
  auto const other = correlate(grid_, frame, by_step, window);
  return other.score > found.score + clearly ? Found{other.pose, by_step} : Found{found.pose, by_speed};
}

/// Over a moment, not from one scan to the next: stamps that a buffer gave come in bursts, and a centimetre in a
/// millisecond is no speed.
void ScanOdometry::note_speed(LogTime now) {
  constexpr LogTime moment(0.15);
  constexpr double most_m_s = 4.0;
  constexpr double most_rad_s = 4.0;
  auto const elapsed = now - since_->time;
  if (elapsed >= LogTime(0.0) && elapsed < moment) return;
  if (elapsed >= moment) {
    speed_ = numbers(between(since_->pose, pose_)) / elapsed.count();
    speed_ = speed_.cwiseMax(Eigen::Vector3d(-most_m_s, -most_m_s, -most_rad_s))
                 .cwiseMin(Eigen::Vector3d(most_m_s, most_m_s, most_rad_s));
  }
  since_ = {now, pose_};  // also where the stamps run back
}

void ScanOdometry::keep(Frame const& frame) {
  last_.push_back({frame, pose_});
  if (last_.size() > kept) last_.pop_front();
  grid_.move_to(pose_);
  for (auto const& seen : last_) grid_.add(seen.frame, seen.pose);
}

}  // namespace lapwing::slam
