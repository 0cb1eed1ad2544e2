#include "slam/match/align.hpp"

#include <Eigen/Dense>

namespace lapwing::slam {

Alignment align(Frame const& frame, Pose2 const& start, Prior const& prior, std::span<Target const> targets,
                AlignOptions const& options) {
  Association const wide{.gate_m = 0.25, .scale_m = 0.08, .stride = options.stride};
  Association const narrow{.gate_m = 0.12, .scale_m = 0.03, .stride = options.stride};
  auto const point_information = options.stride * options.point_information;
  constexpr double small_step = 1e-3;
  Alignment result{.pose = start};
  for (int round = 0; round < options.rounds; ++round) {
    result.seen.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (auto const& target : targets) {
      auto const term =
          point_to_line(frame, result.pose, *target.frame, target.pose, round < options.wide_rounds ? wide : narrow);
      if (!term.is_usable()) continue;
      result.seen += point_information * term.hessian.topLeftCorner<3, 3>();
      gradient += point_information * term.gradient.head<3>();
    }
    result.information = result.seen;
    result.information.diagonal() += prior.trust;
    Eigen::Vector3d off = numbers(result.pose) - numbers(prior.pose);
    off.z() = geo::wrap_pi(off.z());
    gradient += prior.trust.cwiseProduct(off);
    Eigen::Vector3d const step = result.information.ldlt().solve(-gradient);
    result.pose = stepped(result.pose, step);
    if (step.norm() < small_step) break;
  }
  return result;
}

}  // namespace lapwing::slam
