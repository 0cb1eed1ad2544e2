#include "slam/testing/simulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

namespace lapwing::slam::testing {
namespace {

void box(Building& building, Eigen::Vector2d const& low, Eigen::Vector2d const& high) {
  Eigen::Vector2d const right(high.x(), low.y());
  Eigen::Vector2d const left(low.x(), high.y());
  building.insert(building.end(), {{low, right}, {right, high}, {high, left}, {left, low}});
}

/// A wall from `a` to `b` with a doorway of 0.9 m every `spacing` metres, behind which lies an office of 3 by 3 m.
void wall_with_offices(Building& building, Eigen::Vector2d const& a, Eigen::Vector2d const& b,
                       Eigen::Vector2d const& behind, double spacing, double variety, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  auto const length = (b - a).norm();
  Eigen::Vector2d const along = (b - a) / length;
  constexpr double half_door = 0.45;
  constexpr double depth = 3.0;
  auto last = 0.0;
  for (double at = 0.5 * spacing; at + 1.6 < length; at += spacing) {
    auto const door = at + variety * (share(random) - 0.5) * 0.4 * spacing;
    building.push_back({a + last * along, a + (door - half_door) * along});
    last = door + half_door;
    Eigen::Vector2d const left = a + (door - 1.4) * along;
    Eigen::Vector2d const right = a + (door + 1.4) * along;
    auto const back = depth + variety * (share(random) - 0.5);
    building.insert(
        building.end(),
        {{left, left + back * behind}, {left + back * behind, right + back * behind}, {right + back * behind, right}});
    if (share(random) >= variety) continue;
    Eigen::Vector2d const desk = left + (0.5 + 1.5 * share(random)) * along + (1.0 + share(random)) * behind;
    box(building, desk, desk + Eigen::Vector2d(0.3 + 0.5 * share(random), 0.3 + 0.5 * share(random)));
  }
  building.push_back({a + last * along, b});
}

/// How far a ray goes before it meets the wall; `most` when it does not.
double cast(Wall const& wall, Eigen::Vector2d const& from, Eigen::Vector2d const& direction, double most) {
  Eigen::Vector2d const along = wall.to - wall.from;
  auto const cross = direction.x() * along.y() - direction.y() * along.x();
  if (std::abs(cross) < 1e-12) return most;
  Eigen::Vector2d const to = wall.from - from;
  auto const way = (to.x() * along.y() - to.y() * along.x()) / cross;
  auto const share = (to.x() * direction.y() - to.y() * direction.x()) / cross;
  return way > 1e-6 && share >= 0.0 && share <= 1.0 ? std::min(way, most) : most;
}

class Robot {
 public:
  Robot(Building const& building, Pose2 const& start, DriveOptions const& options)
      : building_(building), options_(options), random_(options.seed), pose_(start) {
    Sensor sensor;
    sensor.no_return_m = static_cast<float>(options.most_range_m);
    auto const steps = options.field_of_view_rad > 6.2 ? options.beams : options.beams - 1;
    for (int b = 0; b < options.beams; ++b)
      sensor.bearings_rad.push_back(
          static_cast<float>(-0.5 * options.field_of_view_rad + options.field_of_view_rad * b / std::max(1, steps)));
    drive_.log.sensors.push_back(sensor);
    last_ = start;
    look();
  }

  void turn_to(double yaw) {
    auto const whole = geo::wrap_pi(yaw - pose_.yaw);
    auto const scans = static_cast<int>(std::ceil(std::abs(whole) / options_.turn_rad_per_scan));
    for (int i = 0; i < scans; ++i) step({0.0, 0.0, whole / scans});
  }
  void go(double metres) {
    auto const each = options_.speed_m_s / options_.scans_per_s;
    auto const scans = static_cast<int>(std::ceil(metres / each));
    for (int i = 0; i < scans; ++i) step({metres / scans, 0.0, 0.0});
  }

  [[nodiscard]] Pose2 const& pose() const { return pose_; }
  [[nodiscard]] Drive take() { return std::move(drive_); }

 private:
  double noise(double deviation) { return deviation * std::normal_distribution<double>()(random_); }

  void step(Pose2 const& motion) {
    last_ = pose_;
    pose_ = pose_ * motion;
    auto const length = motion.x;
    Pose2 const told{length * (1.0 + options_.scale_bias) + noise(options_.shift_noise * length),
                     noise(0.3 * options_.shift_noise * length),
                     motion.yaw +
                         noise(options_.turn_noise * std::abs(motion.yaw) + options_.turn_noise_per_m * length) +
                         options_.turn_bias_per_m * length};
    odometry_ = odometry_ * told;
    look();
  }

  void look() {
    Scan scan{.time = LogTime(static_cast<double>(drive_.truth.size()) / options_.scans_per_s),
              .odometry = odometry_,
              .ranges_m = {}};
    auto const& bearings = drive_.log.sensors[0].bearings_rad;
    auto const moved = between(last_, pose_);
    for (std::size_t b = 0; b < bearings.size(); ++b) {
      auto const share =
          options_.turns_while_driving ? static_cast<double>(b + 1) / static_cast<double>(bearings.size()) : 1.0;
      auto const from = last_ * Pose2{share * moved.x, share * moved.y, share * moved.yaw};
      auto const yaw = from.yaw + double{bearings[b]};
      Eigen::Vector2d const direction(std::cos(yaw), std::sin(yaw));
      auto range = options_.most_range_m;
      for (auto const& wall : building_) range = cast(wall, place(from), direction, range);
      if (range < options_.most_range_m) range = std::max(0.02, range + noise(options_.range_noise_m));
      scan.ranges_m.push_back(static_cast<float>(range));
    }
    drive_.log.scans.push_back(std::move(scan));
    drive_.truth.push_back(pose_);
  }

  Building const& building_;
  DriveOptions options_;
  std::mt19937_64 random_;
  Pose2 pose_;
  Pose2 last_;  ///< of the scan before
  Pose2 odometry_;
  Drive drive_;
};

}  // namespace

Building office(double width, double height, double spacing, double variety, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Building building;
  constexpr double half = 1.0;  // of a corridor's width
  auto const ring = [&](double grow, double inwards) {
    Eigen::Vector2d const low(-grow, -grow);
    Eigen::Vector2d const high(width + grow, height + grow);
    Eigen::Vector2d const right(high.x(), low.y());
    Eigen::Vector2d const left(low.x(), high.y());
    wall_with_offices(building, low, right, {0.0, inwards}, spacing, variety, random);
    wall_with_offices(building, right, high, {-inwards, 0.0}, spacing, variety, random);
    wall_with_offices(building, high, left, {0.0, -inwards}, spacing, variety, random);
    wall_with_offices(building, left, low, {inwards, 0.0}, spacing, variety, random);
  };
  ring(half, -1.0);
  ring(-half, 1.0);
  return building;
}

Building comb(int teeth, double apart, double depth) {
  constexpr double half = 1.0;
  auto const end = (teeth - 1) * apart + 3.0;
  Building building{{{-3.0, -half}, {end, -half}}, {{-3.0, -half}, {-3.0, half}}, {{end, -half}, {end, half}}};
  auto last = -3.0;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    auto const left = tooth * apart - half;
    auto const right = tooth * apart + half;
    building.insert(building.end(), {{{last, half}, {left, half}},
                                     {{left, half}, {left, depth}},
                                     {{left, depth}, {right, depth}},
                                     {{right, depth}, {right, half}}});
    last = right;
  }
  building.push_back({{last, half}, {end, half}});
  return building;
}

std::vector<Eigen::Vector2d> way_through_comb(int teeth, double apart, double depth) {
  std::vector<Eigen::Vector2d> way{{-2.0, 0.0}};
  for (int tooth = 0; tooth < teeth; ++tooth)
    way.insert(way.end(), {{tooth * apart, 0.0}, {tooth * apart, depth - 1.5}, {tooth * apart, 0.0}});
  way.emplace_back(-2.0, 0.0);
  return way;
}

Drive drive(Building const& building, std::vector<Eigen::Vector2d> const& way, DriveOptions const& options) {
  Robot robot(building, {way.front().x(), way.front().y(), 0.0}, options);
  for (auto const& next : way) {
    Eigen::Vector2d const ahead = next - place(robot.pose());
    if (ahead.norm() < 1e-6) continue;
    robot.turn_to(std::atan2(ahead.y(), ahead.x()));
    robot.go(ahead.norm());
  }
  return robot.take();
}

double greatest_error_m(std::vector<Pose2> const& mapped, std::vector<Pose2> const& truth) {
  Eigen::Matrix2Xd from(2, static_cast<Eigen::Index>(mapped.size()));
  Eigen::Matrix2Xd to(2, static_cast<Eigen::Index>(truth.size()));
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = place(mapped[i]);
    to.col(static_cast<Eigen::Index>(i)) = place(truth[i]);
  }
  Eigen::Matrix3d const laid = Eigen::umeyama(from, to, false);
  return ((laid.topLeftCorner<2, 2>() * from).colwise() + laid.topRightCorner<2, 1>() - to).colwise().norm().maxCoeff();
}

}  // namespace lapwing::slam::testing
