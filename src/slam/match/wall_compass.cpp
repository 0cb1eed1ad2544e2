#include "slam/match/wall_compass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/assert.hpp"

namespace lapwing::slam {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double degree = std::numbers::pi / 180.0;
/// Of a key frame that was joined driving straight on.
constexpr double usual_rad = 1.5 * degree;
/// Directions are no nearer to each other, so that a robot that has drifted makes no new one.
constexpr double apart_rad = 12.0 * degree;

/// As walls at right angles are alike: within an eighth of a turn of zero.
double folded(double angle_rad) {
  return angle_rad - quarter * std::round(angle_rad / quarter);
}

struct Angle {
  double rad;
  double counts;
};

struct Middle {
  double rad = 0.0;
  double weight = 0.0;
  double spread2 = 0.0;  ///< squared, of what lies around it
};
/// The angle around which most weight lies, from `start`, counting what lies within `reach_rad` (mean shift).
Middle middle_near(std::vector<Angle> const& angles, double start, double reach_rad) {
  Middle middle{.rad = start};
  constexpr int rounds = 6;
  for (int round = 0; round < rounds; ++round) {
    double off = 0.0;
    double off2 = 0.0;
    double weight = 0.0;
    for (auto const& [angle, counts] : angles) {
      auto const away = folded(angle - middle.rad);
      if (std::abs(away) > reach_rad) continue;
      off += counts * away;
      off2 += counts * away * away;
      weight += counts;
    }
    if (weight == 0.0) return middle;
    middle.weight = weight;
    middle.spread2 = off2 / weight;
    middle.rad = folded(middle.rad + off / weight);
  }
  return middle;
}

/// What was joined while the robot turned is turned by a part of that.
double with_smear(double sigma_rad, double turned_rad) {
  constexpr double smeared = 0.1;
  return std::hypot(sigma_rad, smeared * turned_rad);
}

}  // namespace

std::optional<WallDirection> direction_of_walls(Frame const& frame) {
  constexpr double least = 12.0;        // points on lines
  constexpr double common_share = 0.6;  // of them, that must run in the direction
  constexpr double lines_reach_rad = 7.0 * degree;
  constexpr double err_together = 6.0;  // points in a row see the same line
  constexpr double surest_rad = 0.4 * degree;
  constexpr int bins = 30;
  std::vector<Angle> angles;
  std::array<double, bins> histogram{};
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    if (!frame.has_normal(k)) continue;
    auto const angle = folded(std::atan2(double{frame.normals[k].y()}, double{frame.normals[k].x()}));
    angles.push_back({angle, 1.0});
    auto const bin = static_cast<int>(std::floor((angle / quarter + 0.5) * bins));
    histogram[static_cast<std::size_t>(std::clamp(bin, 0, bins - 1))] += 1.0;
  }
  auto const count = static_cast<double>(angles.size());
  if (count < least) return std::nullopt;
  auto const peak = std::ranges::max_element(histogram) - histogram.begin();
  auto const middle = middle_near(angles, ((static_cast<double>(peak) + 0.5) / bins - 0.5) * quarter, lines_reach_rad);
  if (middle.weight < std::max(least, common_share * count)) return std::nullopt;
  return WallDirection{.rad = middle.rad,
                       .sigma_rad = std::hypot(surest_rad, std::sqrt(middle.spread2 * err_together / middle.weight))};
}

void WallCompass::learn(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses) {
  LAPWING_ASSERT(known_.size() <= frames.size(), known_.size(), frames.size());
  if (known_.size() == frames.size()) return;
  while (known_.size() < frames.size()) known_.push_back(direction_of_walls(frames[known_.size()].frame));
  if (!known_.back()) return;
  auto const at_rad = poses.back().yaw + known_.back()->rad;
  if (nearest(at_rad, apart_rad)) return;
  std::vector<Angle> angles;
  double whole = 0.0;
  for (std::size_t k = 1; k < known_.size(); ++k) {
    if (!known_[k]) continue;
    // All count alike but for what was joined while the robot turned.
    auto const sigma_rad = with_smear(usual_rad, turn_rad(poses[k - 1], poses[k]));
    angles.push_back({poses[k].yaw + known_[k]->rad, usual_rad * usual_rad / (sigma_rad * sigma_rad)});
    whole += angles.back().counts;
  }
  constexpr double reach_rad = 5.0 * degree;
  constexpr double enough = 10.0;
  constexpr double common_share = 0.25;
  auto const middle = middle_near(angles, at_rad, reach_rad);
  if (middle.weight < std::max(enough, common_share * whole) || nearest(middle.rad, apart_rad)) return;
  directions_.push_back(middle.rad);
}

std::optional<double> WallCompass::nearest(double angle_rad, double within_rad) const {
  std::optional<double> off_rad;
  for (auto const direction : directions_) {
    auto const off = folded(direction - angle_rad);
    if (std::abs(off) < within_rad && (!off_rad || std::abs(off) < std::abs(*off_rad))) off_rad = off;
  }
  return off_rad;
}

std::optional<Heading> WallCompass::heading(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses,
                                            Frame const& frame, Heading const& expected) {
  learn(frames, poses);
  auto const seen = direction_of_walls(frame);
  if (frames.empty() || !seen) return std::nullopt;
  constexpr double most_deviations = 3.0;
  auto const sigma_rad = with_smear(seen->sigma_rad, geo::wrap_pi(expected.yaw_rad - poses.back().yaw));
  auto const off_rad = nearest(expected.yaw_rad + seen->rad,
                               std::min(apart_rad, most_deviations * std::hypot(expected.sigma_rad, sigma_rad)));
  if (!off_rad) return std::nullopt;
  return Heading{expected.yaw_rad + *off_rad, sigma_rad};
}

std::vector<HeldHeading> WallCompass::headings(std::vector<KeyFrame> const& frames, std::vector<Pose2> const& poses) {
  learn(frames, poses);
  std::vector<HeldHeading> held;
  for (std::size_t k = 1; k < known_.size(); ++k) {
    if (!known_[k]) continue;
    auto const off_rad = nearest(poses[k].yaw + known_[k]->rad, apart_rad);
    auto const sigma_rad = with_smear(known_[k]->sigma_rad, turn_rad(poses[k - 1], poses[k]));
    if (off_rad)
      held.push_back({static_cast<int>(k), {geo::wrap_pi(poses[k].yaw + *off_rad), std::max(sigma_rad, usual_rad)}});
  }
  return held;
}

}  // namespace lapwing::slam
