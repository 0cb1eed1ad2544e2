#include "slam/graph/chordal.hpp"

#include <cmath>

#include <Eigen/Sparse>

namespace lapwing::slam {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double held = 1e9;  // how firmly the first pose is

/// H x = b of pairs of numbers, two a pose.
class PairSystem {
 public:
  explicit PairSystem(std::size_t poses)
      : size_(2 * static_cast<Eigen::Index>(poses)), b_(Eigen::VectorXd::Zero(size_)) {}

  void add(int row, int column, Eigen::Matrix2d const& block) {
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) triplets_.emplace_back(2 * row + r, 2 * column + c, block(r, c));
  }
  void add(int row, Eigen::Vector2d const& right) { b_.segment<2>(2 * static_cast<Eigen::Index>(row)) += right; }

  /// Of the terms w |x_to - m x_from - d|^2, w a matrix.
  void couple(int from, int to, Eigen::Matrix2d const& m, Eigen::Vector2d const& d, Eigen::Matrix2d const& w) {
    add(to, to, w);
    add(from, from, m.transpose() * w * m);
    add(to, from, -w * m);
    add(from, to, -m.transpose() * w);
    add(to, w * d);
    add(from, -m.transpose() * w * d);
  }
  void hold(int pose, Eigen::Vector2d const& value) {
    add(pose, pose, held * Eigen::Matrix2d::Identity());
    add(pose, held * value);
  }
  [[nodiscard]] Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> const solver(matrix);
    return solver.solve(b_);
  }

 private:
  Eigen::Index size_;
  Triplets triplets_;
  Eigen::VectorXd b_;
};

Eigen::Matrix2d rotation(double yaw) {
  Eigen::Matrix2d m;
  m << std::cos(yaw), -std::sin(yaw), std::sin(yaw), std::cos(yaw);
  return m;
}

}  // namespace

std::vector<Pose2> chordal_poses(std::size_t count, Pose2 const& first, std::vector<Constraint> const& constraints) {
  std::vector<Pose2> poses(count);
  if (count == 0) return poses;
  PairSystem directions(count);
  directions.hold(0, {std::cos(first.yaw), std::sin(first.yaw)});
  for (auto const& c : constraints)
    directions.couple(c.from, c.to, rotation(c.from_to.yaw), Eigen::Vector2d::Zero(),
                      c.information(2, 2) * Eigen::Matrix2d::Identity());
  auto const turned = directions.solve();
  for (std::size_t k = 0; k < count; ++k) {
    auto const at = 2 * static_cast<Eigen::Index>(k);
    poses[k].yaw = std::atan2(turned(at + 1), turned(at));
  }
  PairSystem places(count);
  places.hold(0, place(first));
  for (auto const& c : constraints) {
    auto const turn = rotation(poses[c.from].yaw);
    places.couple(c.from, c.to, Eigen::Matrix2d::Identity(), turn * place(c.from_to),
                  turn * c.information.topLeftCorner<2, 2>() * turn.transpose());
  }
  auto const placed = places.solve();
  for (std::size_t k = 0; k < count; ++k) {
    auto const at = 2 * static_cast<Eigen::Index>(k);
    poses[k].x = placed(at);
    poses[k].y = placed(at + 1);
  }
  return poses;
}

}  // namespace lapwing::slam
