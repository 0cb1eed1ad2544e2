#include "robot/mapping/wheel_spin.hpp"

namespace lapwing::robot {

namespace {

/// The map follows the wheels between one key frame and the next, and is put right there: this is several of them.
constexpr double long_ago_s = 6.0;
constexpr double way_m = 0.5;  ///< that the wheels must have made for anything to be said; near walls they turn slowly
constexpr double stays = 0.4;  ///< of that way, and less: it does not get on
constexpr double follows = 0.7;  ///< and more: it does again

}  // namespace

bool WheelSpin::feed(double time_s, slam::Pose2 const& by_wheels, slam::Pose2 const& on_map) {
  while (!lately_.empty() && time_s - lately_.front().time_s > long_ago_s) lately_.pop_front();
  lately_.push_back({time_s, by_wheels, on_map});
  double const turned_m = slam::distance_m(lately_.front().by_wheels, by_wheels);
  double const moved_m = slam::distance_m(lately_.front().on_map, on_map);
  if (turned_m < way_m) return is_spinning_;
  if (moved_m < stays * turned_m) is_spinning_ = true;
  if (moved_m > follows * turned_m) is_spinning_ = false;
  return is_spinning_;
}

void WheelSpin::forget() {
  lately_.clear();
  is_spinning_ = false;
}

}  // namespace lapwing::robot
