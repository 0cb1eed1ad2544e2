#include "slam/graph/block_system.hpp"

#include <algorithm>

#include "base/assert.hpp"

namespace lapwing::slam {

// Column 3 * j + c of the lower half holds the rows c..2 of the diagonal block j, then three rows of each block below
// it.

BlockSystem::BlockSystem(int poses, Couples couples) : poses_(poses), hessian_(3L * poses, 3L * poses) {
  for (auto& [a, b] : couples) {
    LAPWING_ASSERT(a != b && a >= 0 && b >= 0 && a < poses && b < poses, a, b, poses);
    if (a > b) std::swap(a, b);
  }
  std::ranges::sort(couples);
  couples.erase(std::ranges::unique(couples).begin(), couples.end());
  first_.assign(static_cast<std::size_t>(poses) + 1, 0);
  for (auto const& [low, high] : couples) {
    ++first_[low + 1];
    others_.push_back(high);
  }
  for (int j = 0; j < poses; ++j) first_[j + 1] += first_[j];

  hessian_.resizeNonZeros(6 * static_cast<Eigen::Index>(poses) + 9 * static_cast<Eigen::Index>(others_.size()));
  int at = 0;
  for (int j = 0; j < poses; ++j) {
    for (int c = 0; c < 3; ++c) {
      hessian_.outerIndexPtr()[3 * j + c] = at;
      for (int r = c; r < 3; ++r) hessian_.innerIndexPtr()[at++] = 3 * j + r;
      for (int p = first_[j]; p < first_[j + 1]; ++p)
        for (int r = 0; r < 3; ++r) hessian_.innerIndexPtr()[at++] = 3 * others_[p] + r;
    }
  }
  hessian_.outerIndexPtr()[3L * poses] = at;
  gradient_.resize(3L * poses);
  set_zero();
}

void BlockSystem::set_zero() {
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  gradient_.setZero();
}

void BlockSystem::add(int pose, Eigen::Matrix3d const& hessian, Eigen::Vector3d const& gradient) {
  for (int c = 0; c < 3; ++c) {
    auto* column = hessian_.valuePtr() + hessian_.outerIndexPtr()[3 * pose + c];
    for (int r = c; r < 3; ++r) column[r - c] += hessian(r, c);
  }
  gradient_.segment<3>(3L * pose) += gradient;
}

int BlockSystem::coupling(int a, int b) const {
  auto const low = std::min(a, b);
  auto const begin = others_.begin() + first_[low];
  auto const end = others_.begin() + first_[low + 1];
  auto const found = std::lower_bound(begin, end, std::max(a, b));
  LAPWING_ASSERT(found != end && *found == std::max(a, b), a, b);
  return static_cast<int>(found - begin);
}

double* BlockSystem::block(int low, int position, int column) {
  return hessian_.valuePtr() + hessian_.outerIndexPtr()[3L * low + column] + (3 - column) + 3L * position;
}

void BlockSystem::add_coupling(int a, int b, Eigen::Matrix3d const& hessian) {
  auto const low = std::min(a, b);
  auto const position = coupling(a, b);
  for (int c = 0; c < 3; ++c) {
    auto* values = block(low, position, c);
    for (int r = 0; r < 3; ++r) values[r] += a > b ? hessian(r, c) : hessian(c, r);
  }
}

void BlockSystem::fix(int pose) {
  constexpr double wall = 1e12;
  add(pose, wall * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
}

BlockSystem::Solution BlockSystem::solve(double damping) {
  if (!is_ordered_) {
    solver_.analyzePattern(hessian_);
    is_ordered_ = true;
  }
  constexpr double least = 1e-9;  // a pose that nothing holds stays where it is
  std::vector<double> diagonal(static_cast<std::size_t>(3 * poses_));
  for (int i = 0; i < 3 * poses_; ++i) {
    auto& value = hessian_.valuePtr()[hessian_.outerIndexPtr()[i]];
    diagonal[i] = value;
    value += damping * value + least;
  }
  solver_.factorize(hessian_);
  for (int i = 0; i < 3 * poses_; ++i) hessian_.valuePtr()[hessian_.outerIndexPtr()[i]] = diagonal[i];
  if (solver_.info() != Eigen::Success) return {};
  Solution solution{.step = solver_.solve(-gradient_), .is_valid = true};
  solution.is_valid = solution.step.allFinite();
  return solution;
}

double BlockSystem::expected_decrease(Eigen::VectorXd const& step) const {
  Eigen::VectorXd const product = hessian_.selfadjointView<Eigen::Lower>() * step;
  return -gradient_.dot(step) * 2.0 - step.dot(product);
}

}  // namespace lapwing::slam
