#pragma once

#include <deque>
#include <vector>

#include <Eigen/Core>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// How much a log's odometry errs a step, learned from what scan matching made of the steps before. Some robots' is
/// good to a centimetre, some is out of step with the scans by ten degrees; a fixed guess serves neither.
class OdometryNoise {
 public:
  struct Spread {
    double shift_m = 0.0;
    double turn_rad = 0.0;
  };
  /// Standard deviations to be expected of that step.
  [[nodiscard]] Spread of(Pose2 const& step) const;

  /// What a step turned out to be: where it was predicted to end, and where it was found to. `is_pinned`: the scan
  /// shows walls in both directions, so that its shift is known.
  void learn(Pose2 const& step, Pose2 const& predicted, Pose2 const& matched, bool is_pinned);

  /// What was learned, to go on from another day: errors of the last steps as shares of what was expected.
  struct Memory {
    std::vector<double> shift;
    std::vector<double> turn;
  };
  [[nodiscard]] Memory memory() const;
  void remember(Memory const& memory);

 private:
  struct Ratios {
    std::deque<double> last;  ///< of errors to what was expected
    double scale = 1.0;
    void add(double ratio);
  };
  [[nodiscard]] static Spread nominal(Pose2 const& step);

  Ratios shift_;
  Ratios turn_;
};

}  // namespace lapwing::slam
