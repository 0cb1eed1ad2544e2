#include "slam/loops/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::slam {
namespace {

constexpr float round = 2.0F * std::numbers::pi_v<float>;

/// How far the beams around a bearing saw: the nearest and the farthest of three neighbours, 0 where one saw nothing.
struct Sight {
  float nearest = 0.0F;
  float farthest = 0.0F;
};

Sight sight(Frame const& frame, float bearing) {
  auto turned = bearing - frame.first_bearing;
  if (frame.goes_round || turned < 0.0F) turned -= round * std::floor(turned / round);
  auto const bins = frame.bins();
  auto const bin = static_cast<int>(std::floor(turned / frame.bin_width));
  if (bin < 0 || bin >= bins) return {};
  Sight seen{1e9F, 0.0F};
  for (int b = bin - 1; b <= bin + 1; ++b) {
    auto at = b;
    if (frame.goes_round) at = (at + bins) % bins;
    if (at < 0 || at >= bins) return {};
    seen.nearest = std::min(seen.nearest, frame.free_of_bin[at]);
    seen.farthest = std::max(seen.farthest, frame.free_of_bin[at]);
  }
  return seen;
}

Agreement points_against_beams(Frame const& points, Pose2 const& points_pose, Frame const& beams,
                               Pose2 const& beams_pose) {
  // Walls are thin and poses are good to a decimetre before they are refined; far away, a degree more counts.
  constexpr float near_m = 0.2F;
  constexpr float per_m = 0.02F;
  Agreement result;
  auto const beams_from_points = between(beams_pose, points_pose);
  Turn const turn(beams_from_points.yaw);
  for (std::size_t k = 0; k < points.points.size(); ++k) {
    if (!points.has_normal(k)) continue;  // thin things and people
    Eigen::Vector2f const ray =
        (place(beams_from_points) + turn * points.points[k].cast<double>()).cast<float>() - beams.centre;
    auto const range = ray.norm();
    auto const seen = sight(beams, std::atan2(ray.y(), ray.x()));
    auto const tolerance = near_m + per_m * range;
    if (seen.nearest > 0.0F && range < seen.nearest - tolerance) {
      ++result.in_free_space;
    } else if (seen.farthest > 0.0F && range > seen.nearest - tolerance && range < seen.farthest + tolerance) {
      ++result.on_wall;
    } else {
      ++result.out_of_sight;
    }
  }
  return result;
}

}  // namespace

Agreement agreement(Frame const& a, Pose2 const& a_pose, Frame const& b, Pose2 const& b_pose) {
  auto result = points_against_beams(a, a_pose, b, b_pose);
  return result += points_against_beams(b, b_pose, a, a_pose);
}

}  // namespace lapwing::slam
