#include "slam/loops/spread.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include <Eigen/Dense>

namespace lapwing::slam {
namespace {

/// What has added up along a path. A turn by e at place c moves the end p by e x (p - c); summed over independent
/// errors, the variance of the end is sum s^2 |p - c|^2, which the three moments of s^2 over c give for every p.
struct Sums {
  double shift2 = 0.0;
  double turn2 = 0.0;
  Eigen::Vector2d turn2_at = Eigen::Vector2d::Zero();
  Eigen::Matrix2d turn2_at2 = Eigen::Matrix2d::Zero();
  double path = 0.0;

  void pass(Constraint const& edge, Pose2 const& at, DriftRates const& rates) {
    auto const length = std::hypot(edge.from_to.x, edge.from_to.y);
    auto turn = rates.turn_per_sqrt_m * rates.turn_per_sqrt_m * length +
                rates.turn_per_rad * rates.turn_per_rad * std::abs(edge.from_to.yaw);
    auto shift = rates.shift_per_sqrt_m * rates.shift_per_sqrt_m * length;
    if (edge.is_loop) {
      turn = rates.loop_turn_rad * rates.loop_turn_rad;
      shift = rates.loop_shift_m * rates.loop_shift_m;
    } else {
      path += length;
      if (rates.unseen_share > 0.0)
        turn = std::max(turn, rates.unseen_share * rates.unseen_share * edge.information.inverse()(2, 2));
    }
    shift2 += shift;
    turn2 += turn;
    turn2_at += turn * place(at);
    turn2_at2 += turn * place(at) * place(at).transpose();
  }

  [[nodiscard]] Drift at(Pose2 const& end) const {
    Eigen::Vector2d const p = place(end);
    Eigen::Matrix2d const arms2 =
        turn2 * p * p.transpose() - p * turn2_at.transpose() - turn2_at * p.transpose() + turn2_at2;
    Eigen::Matrix2d const quarter_turn = (Eigen::Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished();
    Drift drift{
        .shift_m = std::sqrt(shift2 + std::max(0.0, arms2.trace())), .turn_rad = std::sqrt(turn2), .path_m = path};
    drift.covariance.topLeftCorner<2, 2>() =
        quarter_turn * arms2 * quarter_turn.transpose() + shift2 * Eigen::Matrix2d::Identity();
    drift.covariance.topRightCorner<2, 1>() = quarter_turn * (turn2 * p - turn2_at);
    drift.covariance.bottomLeftCorner<1, 2>() = drift.covariance.topRightCorner<2, 1>().transpose();
    drift.covariance(2, 2) = turn2;
    return drift;
  }
};

struct Neighbour {
  int frame;
  int constraint;
};

}  // namespace

std::vector<Drift> drift_from(int origin, std::vector<Pose2> const& poses, std::vector<Constraint> const& constraints,
                              DriftRates const& rates) {
  std::vector<int> first(poses.size() + 1, 0);
  for (auto const& c : constraints) {
    ++first[c.from + 1];
    ++first[c.to + 1];
  }
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<Neighbour> neighbours(2 * constraints.size());
  auto next = first;
  for (int c = 0; c < static_cast<int>(constraints.size()); ++c) {
    neighbours[next[constraints[c].from]++] = {constraints[c].to, c};
    neighbours[next[constraints[c].to]++] = {constraints[c].from, c};
  }

  std::vector<Drift> drifts(poses.size());
  std::vector<Sums> sums(poses.size());
  std::vector<double> best(poses.size(), 1e18);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  best[origin] = 0.0;
  queue.emplace(0.0, origin);
  while (!queue.empty()) {
    auto const [cost, k] = queue.top();
    queue.pop();
    if (cost > best[k]) continue;
    drifts[k] = sums[k].at(poses[k]);
    for (int n = first[k]; n < first[k + 1]; ++n) {
      auto const [other, constraint] = neighbours[n];
      auto sum = sums[k];
      sum.pass(constraints[constraint], poses[k], rates);
      if (sum.turn2 >= best[other]) continue;
      best[other] = sum.turn2;
      sums[other] = sum;
      queue.emplace(sum.turn2, other);
    }
  }
  return drifts;
}

}  // namespace lapwing::slam
