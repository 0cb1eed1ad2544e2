#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Sparse>

namespace lapwing::slam {

/// The normal equations H x = -b of many poses: H symmetric, sparse, in blocks of three by three. Which poses are
/// coupled is fixed, so that the order of elimination is found once and every later solution costs the numbers alone.
class BlockSystem {
 public:
  using Couples = std::vector<std::pair<int, int>>;
  /// `couples`: pairs of different poses, in any order and as often as one likes.
  BlockSystem(int poses, Couples couples);

  void set_zero();
  void add(int pose, Eigen::Matrix3d const& hessian, Eigen::Vector3d const& gradient);
  /// The block of row `a` and column `b`; its mirror comes of itself. Precondition: a couple of this system.
  void add_coupling(int a, int b, Eigen::Matrix3d const& hessian);
  /// Where `add_coupling` will put it, for who adds there often.
  [[nodiscard]] int coupling(int a, int b) const;

  /// Holds a pose where it is.
  void fix(int pose);

  struct Solution {
    Eigen::VectorXd step;  ///< three numbers a pose
    bool is_valid = false;
  };
  /// With `damping` times the diagonal added to it (Marquardt 1963).
  [[nodiscard]] Solution solve(double damping = 0.0);
  /// How much a quadratic with this H and b falls over that step.
  [[nodiscard]] double expected_decrease(Eigen::VectorXd const& step) const;
  [[nodiscard]] double largest_gradient() const {
    return gradient_.size() == 0 ? 0.0 : gradient_.lpNorm<Eigen::Infinity>();
  }

 private:
  [[nodiscard]] double* block(int low, int position, int column);

  int poses_;
  std::vector<int> first_;               ///< of each pose's couples in `others_`
  std::vector<int> others_;              ///< the later poses that each is coupled with, ascending
  Eigen::SparseMatrix<double> hessian_;  ///< lower half
  Eigen::VectorXd gradient_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  bool is_ordered_ = false;
};

}  // namespace lapwing::slam
