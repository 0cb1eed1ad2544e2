#include "slam/known/lay_on_map.hpp"

#include <Eigen/Dense>

namespace lapwing::slam {
namespace {

constexpr float near_m = 0.15F;
/// Of one point, 1 / m^2: cells are wider than what a laser errs, and beams err together.
constexpr double point_information = 60.0;

}  // namespace

double fit_of(KnownMap const& map, Frame const& frame, Pose2 const& pose) {
  if (frame.points.empty()) return 0.0;
  Turn const turn(pose.yaw);
  std::size_t near = 0;
  for (auto const& point : frame.points)
    near += map.distance(place(pose) + turn * point.cast<double>()).m <= near_m ? 1 : 0;
  return static_cast<double>(near) / static_cast<double>(frame.points.size());
}

Laid lay_on_map(KnownMap const& map, Frame const& frame, Pose2 const& start, Prior const& prior) {
  constexpr int most_rounds = 20;
  constexpr int wide_rounds = 6;
  constexpr double small_step = 1e-4;
  auto pose = start;
  for (int round = 0; round < most_rounds; ++round) {
    auto const scale_m = round < wide_rounds ? 0.2 : 0.07;
    Eigen::Matrix3d information = prior.trust.asDiagonal();
    Eigen::Vector3d off = numbers(pose) - numbers(prior.pose);
    off.z() = geo::wrap_pi(off.z());
    Eigen::Vector3d gradient = prior.trust.cwiseProduct(off);
    Turn const turn(pose.yaw);
    for (auto const& point : frame.points) {
      Eigen::Vector2d const arm = turn * point.cast<double>();
      auto const distance = map.distance(place(pose) + arm);
      if (distance.m >= KnownMap::far_m) continue;
      auto const residual = static_cast<double>(distance.m);
      Eigen::Vector2d const slope = distance.slope.cast<double>();
      Eigen::Vector3d const row(slope.x(), slope.y(), slope.y() * arm.x() - slope.x() * arm.y());
      auto weight = 1.0 / (1.0 + residual * residual / (scale_m * scale_m));
      weight *= weight * point_information;
      information.noalias() += weight * row * row.transpose();
      gradient += weight * residual * row;
    }
    // Never quite singular: a step along a corridor that shows nothing else stays where it is.
    information.diagonal().array() += 1e-6;
    Eigen::Vector3d const step = information.ldlt().solve(-gradient);
    pose = stepped(pose, step);
    if (round >= wide_rounds && step.norm() < small_step) break;
  }
  return {.pose = pose, .fit = fit_of(map, frame, pose)};
}

}  // namespace lapwing::slam
