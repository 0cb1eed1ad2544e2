#include "robot/sensors/sonar_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "firmware/frames/records.hpp"

namespace lapwing::robot {

namespace {

double constexpr stuck_turn_rad = 30 * std::numbers::pi / 180;
double constexpr stuck_way_m = 0.5;
/// Beyond this from the body's axis a sonar looks to a side.
double constexpr along_within_rad = 60 * std::numbers::pi / 180;
/// Half a metre in a tenth of a second: nothing that walks comes or goes so fast.
double constexpr jump_m = 0.5;
std::size_t constexpr jump_window = 10;
int constexpr jumps_that_tell = 4;
double constexpr one_thing_m = 1.0;

double range_m(std::uint16_t echo_us) {
  return echo_us / static_cast<double>(firmware::echo_us_per_m);
}

}  // namespace

SensorFault SonarWatch::feed(std::uint16_t echo_us, MovedSoFar const& moved) {
  echoes_[next_] = echo_us;
  next_ = (next_ + 1) % remembered;
  count_ = std::min(count_ + 1, remembered);
  if (is_stuck(echo_us, moved)) return SensorFault::stuck;
  if (is_jumping()) return SensorFault::jumping;
  return drops_out() ? SensorFault::dropouts : SensorFault::none;
}

bool SonarWatch::is_stuck(std::uint16_t echo_us, MovedSoFar const& moved) {
  // No echo at all is what a large room says.
  if (echo_us == firmware::no_echo_us || same_echo_ != echo_us) {
    same_echo_ = echo_us;
    same_since_ = moved;
    return false;
  }
  bool const looks_along = std::abs(std::sin(static_cast<double>(place_.angle_rad))) < std::sin(along_within_rad);
  return moved.turn_rad - same_since_.turn_rad > stuck_turn_rad ||
         (looks_along && moved.way_m - same_since_.way_m > stuck_way_m);
}

bool SonarWatch::is_jumping() const {
  if (count_ < jump_window) return false;
  int turns = 0;
  double last_change = 0;
  std::optional<double> before;
  for (std::size_t ago = jump_window; ago-- > 0;) {
    if (echo(ago) == firmware::no_echo_us) continue;
    double const range = range_m(echo(ago));
    double const change = before ? range - *before : 0;
    before = range;
    if (std::abs(change) < jump_m) continue;
    if (change * last_change < 0) ++turns;
    last_change = change;
  }
  return turns >= jumps_that_tell;
}

bool SonarWatch::drops_out() const {
  if (count_ < remembered) return false;
  auto const missing = std::ranges::count(echoes_, firmware::no_echo_us);
  if (missing < static_cast<std::ptrdiff_t>(remembered / 2) || missing > static_cast<std::ptrdiff_t>(remembered - 4))
    return false;
  double nearest = std::numeric_limits<double>::infinity();
  double furthest = 0;
  int gaps = 0;
  for (std::size_t ago = 0; ago < remembered; ++ago) {
    if (ago > 0 && (echo(ago) == firmware::no_echo_us) != (echo(ago - 1) == firmware::no_echo_us)) ++gaps;
    if (echo(ago) == firmware::no_echo_us) continue;
    nearest = std::min(nearest, range_m(echo(ago)));
    furthest = std::max(furthest, range_m(echo(ago)));
  }
  // Once gone and once come is a corner that was passed.
  return furthest - nearest < one_thing_m && gaps >= 4;
}

}  // namespace lapwing::robot
