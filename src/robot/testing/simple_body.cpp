#include "robot/testing/simple_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::robot::testing {

using namespace std::chrono_literals;
using slam::Pose2;

namespace {

constexpr base::Duration step = 100ms;
constexpr double step_s = 0.1;
constexpr double acceleration_m_s2 = 0.5;
constexpr double turn_acceleration_rad_s2 = 4.0;

double cast(Wall const& wall, Eigen::Vector2d const& from, Eigen::Vector2d const& direction, double most) {
  Eigen::Vector2d const along = wall.to - wall.from;
  auto const cross = direction.x() * along.y() - direction.y() * along.x();
  if (std::abs(cross) < 1e-12) return most;
  Eigen::Vector2d const to = wall.from - from;
  auto const way = (to.x() * along.y() - to.y() * along.x()) / cross;
  auto const share = (to.x() * direction.y() - to.y() * direction.x()) / cross;
  return way > 1e-6 && share >= 0.0 && share <= 1.0 ? std::min(way, most) : most;
}

double distance_m(Wall const& wall, Eigen::Vector2d const& point) {
  Eigen::Vector2d const along = wall.to - wall.from;
  auto const share = std::clamp((point - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (wall.from + share * along - point).norm();
}

double cast(SimpleBody const& other, Eigen::Vector2d const& from, Eigen::Vector2d const& direction, double most) {
  Eigen::Vector2d const to = slam::place(other.truth()) - from;
  double const along = to.dot(direction);
  double const aside2 = to.squaredNorm() - along * along;
  double const in2 = other.limits().radius_m * other.limits().radius_m - aside2;
  return along > 0.0 && in2 > 0.0 ? std::clamp(along - std::sqrt(in2), 0.0, most) : most;
}

double towards(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

Walls small_office() {
  Walls walls;
  auto const line = [&](double x0, double y0, double x1, double y1) { walls.push_back({{x0, y0}, {x1, y1}}); };
  constexpr double left = -1.0;
  constexpr double right = 13.0;
  constexpr double depth = 3.5;
  constexpr double half_door = 0.45;
  line(left, -1.0, left, 1.0);
  line(right, -1.0, right, 1.0);
  for (double const side : {1.0, -1.0}) {
    double last = left;
    for (double const door : {1.0, 5.5, 10.0}) {
      line(last, side, door - half_door, side);
      last = door + half_door;
      double const low = door - 2.0;
      double const high = door + 2.0;
      double const back = side * (1.0 + depth);
      line(low, side, low, back);
      line(low, back, high, back);
      line(high, back, high, side);
    }
    line(last, side, right, side);
  }
  return walls;
}

Walls narrow_corridor() {
  return {{{-1.0, -0.5}, {9.0, -0.5}}, {{9.0, -0.5}, {9.0, 0.5}},  {{9.0, 0.5}, {5.2, 0.5}},
          {{5.2, 0.5}, {5.2, 1.7}},    {{5.2, 1.7}, {4.0, 1.7}},   {{4.0, 1.7}, {4.0, 0.5}},
          {{4.0, 0.5}, {-1.0, 0.5}},   {{-1.0, 0.5}, {-1.0, -0.5}}};
}

SimpleBody::SimpleBody(base::Loop& loop, Walls walls, SimpleBodyOptions const& options)
    : loop_(loop), walls_(std::move(walls)), options_(options), random_(options.seed), pose_(options.start) {
  laser_.no_return_m = static_cast<float>(options.laser_m);
  laser_.mount_m.x() = static_cast<float>(options.laser_x_m);
  for (int b = 0; b < options.beams; ++b)
    laser_.bearings_rad.push_back(static_cast<float>(options.view_rad * (1.0 * b / options.beams - 0.5)));
  life_ = live();
  life_.start();
}

void SimpleBody::drive(Motion motion) {
  wanted_ = motion;
  told_at_ = loop_.now();
}

base::Task<> SimpleBody::live() {
  for (int i = 0;; ++i) {
    co_await loop_.sleep(step);
    battery = std::max(0.0, battery - drain_per_s * step_s);
    move();
    if (is_silent || !listener_.on_reading) continue;
    if (!is_numb) tell_reading();
    if (!is_blind && i % 2 == 0) look();
  }
}

void SimpleBody::tell_reading() {
  bool const is_waiting = loop_.now() - told_at_ > 500ms;
  listener_.on_reading(
      {.at = loop_.now(),
       .odometry = odometry_,
       .speed_m_s = motion_.speed_m_s,
       .battery = battery,
       .sides = {range_m(slam::place(pose_), pose_.yaw + std::numbers::pi / 2), range_m(slam::place(pose_), pose_.yaw),
                 range_m(slam::place(pose_), pose_.yaw - std::numbers::pi / 2)},
       .is_killed = is_killed_,
       .is_waiting = is_waiting,
       .sensors_code = sensors_code});
}

void SimpleBody::move() {
  bool const is_stopped = is_killed_ || loop_.now() - told_at_ > 500ms;
  auto const wanted = is_stopped ? Motion{} : wanted_;
  motion_.speed_m_s = is_killed_ ? 0.0 : towards(motion_.speed_m_s, wanted.speed_m_s, acceleration_m_s2 * step_s);
  motion_.turn_rad_s =
      is_killed_ ? 0.0 : towards(motion_.turn_rad_s, wanted.turn_rad_s, turn_acceleration_rad_s2 * step_s);
  double const length = motion_.speed_m_s * step_s;
  double const turn = motion_.turn_rad_s * step_s;
  pose_ = pose_ * Pose2{length * std::cos(turn / 2), length * std::sin(turn / 2), turn};
  driven_m_ += std::abs(length);
  odometry_ = odometry_ * Pose2{length * (1.0 + options_.scale_bias) + noise(options_.shift_noise * std::abs(length)),
                                0.0, turn + noise(options_.turn_noise * std::abs(turn))};
  auto const hits = [&](Wall const& wall) { return distance_m(wall, slam::place(pose_)) < options_.radius_m; };
  auto const touches = [&](SimpleBody const* other) {
    return slam::distance_m(pose_, other->pose_) < options_.radius_m + other->options_.radius_m;
  };
  if (std::ranges::any_of(walls_, hits) || std::ranges::any_of(put_in_the_way, hits) ||
      std::ranges::any_of(others_there, touches))
    ++collisions_;
}

double SimpleBody::range_m(Eigen::Vector2d const& from, double yaw) const {
  Eigen::Vector2d const direction(std::cos(yaw), std::sin(yaw));
  double range = options_.laser_m;
  for (auto const& wall : walls_) range = cast(wall, from, direction, range);
  for (auto const& wall : put_in_the_way) range = cast(wall, from, direction, range);
  for (auto const* other : others_there) range = cast(*other, from, direction, range);
  return range;
}

void SimpleBody::look() {
  slam::Scan scan;
  scan.time = slam::LogTime(base::to_seconds(loop_.now().time_since_epoch()));
  scan.odometry = odometry_;
  for (auto const bearing : laser_.bearings_rad) {
    double range = range_m(slam::place(pose_ * slam::Pose2{options_.laser_x_m, 0.0, 0.0}), pose_.yaw + double{bearing});
    if (range < options_.laser_m) range = std::max(0.02, range + noise(options_.range_noise_m));
    scan.ranges_m.push_back(static_cast<float>(range));
  }
  listener_.on_scan(scan);
}

}  // namespace lapwing::robot::testing
