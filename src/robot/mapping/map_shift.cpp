#include "robot/mapping/map_shift.hpp"

#include <cstddef>
#include <limits>
#include <optional>

#include "base/assert.hpp"

namespace lapwing::robot {

namespace {

constexpr double reach_m = 8.0;  ///< as far as a robot places what it sees
constexpr double apart_m = 0.4;  ///< nearer ones moved alike, and everything placed is held against all of them

}  // namespace

MapShift::MapShift(std::span<slam::Pose2 const> from, std::span<slam::Pose2 const> to) {
  LAPWING_ASSERT(from.size() == to.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!from_.empty() && slam::distance_m(from_.back(), from[k]) < apart_m) continue;
    from_.push_back(from[k]);
    to_.push_back(to[k]);
  }
}

slam::Pose2 MapShift::moved(slam::Pose2 const& before) const {
  std::optional<std::size_t> nearest;
  double least_m = reach_m;
  for (std::size_t k = 0; k < from_.size(); ++k) {
    auto const away_m = slam::distance_m(from_[k], before);
    if (away_m >= least_m) continue;
    least_m = away_m;
    nearest = k;
  }
  return nearest ? to_[*nearest] * slam::between(from_[*nearest], before) : before;
}

}  // namespace lapwing::robot
