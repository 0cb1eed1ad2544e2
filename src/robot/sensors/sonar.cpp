#include "robot/sensors/sonar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/frames/records.hpp"

namespace lapwing::robot {

namespace {

double constexpr degree = std::numbers::pi / 180;
/// A sonar that looks this far to a side is one of that side.
double constexpr least_side_angle_rad = 20 * degree;
double constexpr most_side_angle_rad = 160 * degree;
/// Nearer to the square than this a sonar sees the wall as it is beside the body.
double constexpr square_within_rad = 20 * degree;
/// A wall turned further away than this reflects the square sonar's sound elsewhere: the echo was of something else.
double constexpr most_wall_turn_rad = 40 * degree;

struct Hit {
  double x_m;
  double y_m;
};

std::optional<Hit> hit(SonarReading const& sonar) {
  if (!sonar.range_m) return std::nullopt;
  auto const angle = static_cast<double>(sonar.place.angle_rad);
  return Hit{.x_m = static_cast<double>(sonar.place.x_m) + *sonar.range_m * std::cos(angle),
             .y_m = static_cast<double>(sonar.place.y_m) + *sonar.range_m * std::sin(angle)};
}

std::optional<double> nearer(std::optional<double> a, double b) {
  return a ? std::min(*a, b) : b;
}

/// Perpendicular from the origin onto the line through both, or none where that is no wall of this side.
std::optional<double> line_distance(Hit const& a, Hit const& b) {
  double const dx = b.x_m - a.x_m;
  double const dy = b.y_m - a.y_m;
  if (std::abs(dy) > std::tan(most_wall_turn_rad) * std::abs(dx)) return std::nullopt;
  return std::abs(a.x_m * b.y_m - b.x_m * a.y_m) / std::hypot(dx, dy);
}

/// `side`: +1 for the left, -1 for the right.
std::optional<double> side_distance(std::span<SonarReading const> sonars, double side) {
  std::optional<Hit> square;
  std::optional<Hit> slanted;
  for (auto const& sonar : sonars) {
    double const angle = side * static_cast<double>(sonar.place.angle_rad);
    if (angle < least_side_angle_rad || angle > most_side_angle_rad) continue;
    auto const seen = hit(sonar);
    if (!seen) continue;
    bool const is_square = std::abs(angle - std::numbers::pi / 2) < square_within_rad;
    auto& place = is_square ? square : slanted;
    if (!place || side * seen->y_m < side * place->y_m) place = seen;
  }
  if (square && slanted)
    if (auto const distance = line_distance(*square, *slanted)) return distance;
  if (square) return std::abs(square->y_m);
  if (slanted) return std::abs(slanted->y_m);
  return std::nullopt;
}

}  // namespace

std::optional<double> range_of_echo(std::uint16_t echo_us, firmware::SonarPlace const& place) {
  if (echo_us == firmware::no_echo_us) return std::nullopt;
  double const range_m = echo_us / static_cast<double>(firmware::echo_us_per_m);
  if (range_m > static_cast<double>(place.longest_m)) return std::nullopt;
  return range_m;
}

WallDistances wall_distances(std::span<SonarReading const> sonars, firmware::Hull const& hull) {
  WallDistances walls{
      .left_m = side_distance(sonars, 1), .front_m = std::nullopt, .right_m = side_distance(sonars, -1)};
  for (auto const& sonar : sonars) {
    auto const seen = hit(sonar);
    if (!seen || std::abs(sonar.place.angle_rad) > std::numbers::pi_v<float> / 3) continue;
    bool const is_ahead = std::abs(static_cast<double>(sonar.place.angle_rad)) < least_side_angle_rad;
    bool const is_in_path = std::abs(seen->y_m) <= static_cast<double>(hull.half_width_m);
    if (is_ahead || is_in_path) walls.front_m = nearer(walls.front_m, seen->x_m);
  }
  return walls;
}

}  // namespace lapwing::robot
