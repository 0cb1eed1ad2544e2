#include "slam/match/point_to_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::slam {
namespace {

constexpr float round = 2.0F * std::numbers::pi_v<float>;

/// The point of `target` with a normal that is nearest to `place`, within the gate; -1 when there is none.
int nearest(Frame const& target, Eigen::Vector2f const& place, float gate) {
  constexpr int least_bins = 3;
  constexpr int most_bins = 12;
  Eigen::Vector2f const ray = place - target.centre;
  auto const range = ray.norm();
  if (range < 0.05F) return -1;
  auto bearing = std::atan2(ray.y(), ray.x()) - target.first_bearing;
  if (target.goes_round) bearing -= round * std::floor(bearing / round);
  auto const bins = target.bins();
  auto const bin = static_cast<int>(std::floor(bearing / target.bin_width));
  auto const reach = std::clamp(static_cast<int>(gate / (range * target.bin_width)), least_bins, most_bins);
  auto closest = gate * gate;
  int found = -1;
  auto const look = [&](int first_bin, int last_bin) {
    if (first_bin > last_bin) return;
    for (auto k = target.first_of_bin[first_bin]; k < target.first_of_bin[last_bin + 1]; ++k) {
      auto const apart = (place - target.points[k]).squaredNorm();
      if (apart < closest && target.has_normal(static_cast<std::size_t>(k))) {
        closest = apart;
        found = k;
      }
    }
  };
  look(std::max(0, bin - reach), std::min(bins - 1, bin + reach));
  if (target.goes_round && bin - reach < 0) look(bins + bin - reach, bins - 1);
  if (target.goes_round && bin + reach >= bins) look(0, bin + reach - bins);
  return found;
}

}  // namespace

PairTerm point_to_line(Frame const& source, Pose2 const& source_pose, Frame const& target, Pose2 const& target_pose,
                       Association const& association) {
  // Walls that are seen from different sides or that turn by more are not the same.
  constexpr double least_agreement = 0.8;
  PairTerm term;
  Turn const from_source(source_pose.yaw);
  Turn const from_target(target_pose.yaw);
  auto const gate = static_cast<float>(association.gate_m);
  auto const scale = 1.0 / (association.scale_m * association.scale_m);
  for (std::size_t k = 0; k < source.points.size(); k += static_cast<std::size_t>(association.stride)) {
    if (!source.has_normal(k)) continue;
    Eigen::Vector2d const arm = from_source * source.points[k].cast<double>();
    Eigen::Vector2d const apart = place(source_pose) + arm - place(target_pose);
    Eigen::Vector2d const seen = from_target.back(apart);
    auto const match = nearest(target, seen.cast<float>(), gate);
    if (match < 0) continue;
    Eigen::Vector2d const normal = target.normals[match].cast<double>();
    Eigen::Vector2d const normal_in_map = from_target * normal;
    if ((from_source * source.normals[k].cast<double>()).dot(normal_in_map) < least_agreement) continue;
    // r = n . (R_t^T (R_s p + t_s - t_t) - q), its derivatives by both poses.
    auto const residual = normal.dot(seen - target.points[match].cast<double>());
    Eigen::Matrix<double, 6, 1> slope;
    slope << normal_in_map, normal_in_map.y() * arm.x() - normal_in_map.x() * arm.y(), -normal_in_map,
        normal_in_map.x() * apart.y() - normal_in_map.y() * apart.x();
    auto weight = 1.0 / (1.0 + residual * residual * scale);
    weight *= weight;
    term.hessian.noalias() += weight * slope * slope.transpose();
    term.gradient += weight * residual * slope;
    term.cost += weight * residual * residual;
    ++term.matches;
  }
  return term;
}

}  // namespace lapwing::slam
