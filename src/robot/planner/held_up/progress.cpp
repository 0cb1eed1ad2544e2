#include "robot/planner/held_up/progress.hpp"

#include <algorithm>

namespace lapwing::robot {

namespace {

constexpr double same_goal_m = 0.5;
constexpr double nearer_m = 0.2;
constexpr double grown_m2 = 0.25;

}  // namespace

void Progress::begin(double time_s) {
  goal_.reset();
  least_m_.reset();
  since_s_ = time_s;
}

void Progress::note(Now const& now) {
  bool const is_same = goal_ && now.goal && geo::distance_m(*goal_, *now.goal) < same_goal_m;
  if (!is_same) least_m_.reset();
  if (now.goal) goal_ = now.goal;
  if (now.left_m && !least_m_) least_m_ = now.left_m;
  bool const is_nearer = now.left_m && *now.left_m < *least_m_ - nearer_m;
  bool const has_grown = now.free_m2 > most_m2_ + grown_m2;
  if (is_nearer) least_m_ = now.left_m;
  if (has_grown) most_m2_ = now.free_m2;
  if (is_nearer || has_grown) since_s_ = now.time_s;
}

}  // namespace lapwing::robot
