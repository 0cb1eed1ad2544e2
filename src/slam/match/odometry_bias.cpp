#include "slam/match/odometry_bias.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/assert.hpp"

namespace lapwing::slam {
namespace {

/// Scans `first` up to `last` of a log.
struct Stretch {
  std::size_t first;
  std::size_t last;
};

/// Spread over the log, each a few metres long.
std::vector<Stretch> stretches_of(std::vector<Pose2> const& odometry) {
  constexpr double length_m = 4.0;
  constexpr std::size_t most = 120;
  std::vector<Stretch> all;
  std::size_t first = 0;
  double driven_m = 0.0;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    driven_m += distance_m(odometry[i - 1], odometry[i]);
    if (driven_m < length_m) continue;
    all.push_back({first, i});
    first = i;
    driven_m = 0.0;
  }
  std::vector<Stretch> some;
  auto const step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

Pose2 mended(Pose2 const& step, OdometryBias const& bias) {
  return {step.x, step.y, step.yaw * (1.0 + bias.turn_per_rad) + bias.turn_per_m * step.x};
}

/// How many cells the stretch's points lie in.
std::size_t cells_of(ScanLog const& log, std::vector<Pose2> const& odometry, Stretch const& stretch,
                     OdometryBias const& bias) {
  constexpr double cell_m = 0.1;
  constexpr double still_m = 0.02;
  std::vector<std::int64_t> cells;
  Pose2 pose;
  for (auto i = stretch.first; i < stretch.last; ++i) {
    if (i > stretch.first) {
      auto const step = between(odometry[i - 1], odometry[i]);
      pose = pose * mended(step, bias);
      if (std::hypot(step.x, step.y) < still_m && std::abs(step.yaw) < still_m) continue;
    }
    auto const& scan = log.scans[i];
    auto const& sensor = log.sensors[scan.sensor];
    auto const& bearings = bearings_of(scan, sensor);
    Turn const turn(pose.yaw);
    Eigen::Vector2d const from = place(pose) + turn * sensor.mount_m.cast<double>();
    for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
      auto const range = double{scan.ranges_m[b]};
      if (!(range > 0.1 && scan.ranges_m[b] < sensor.no_return_m)) continue;
      auto const bearing = pose.yaw + double{bearings[b]};
      auto const x = std::floor((from.x() + range * std::cos(bearing)) / cell_m);
      auto const y = std::floor((from.y() + range * std::sin(bearing)) / cell_m);
      cells.push_back(static_cast<std::int64_t>(x) * 1'000'003 + static_cast<std::int64_t>(y));
    }
  }
  std::ranges::sort(cells);
  return static_cast<std::size_t>(std::ranges::unique(cells).begin() - cells.begin());
}

}  // namespace

std::vector<Pose2> without_bias(std::vector<Pose2> const& odometry, OdometryBias const& bias) {
  std::vector<Pose2> poses;
  poses.reserve(odometry.size());
  for (std::size_t i = 0; i < odometry.size(); ++i)
    poses.push_back(i == 0 ? odometry.front() : poses.back() * mended(between(odometry[i - 1], odometry[i]), bias));
  return poses;
}

OdometryBias find_bias(ScanLog const& log, std::vector<Pose2> const& odometry) {
  LAPWING_ASSERT(odometry.size() == log.scans.size(), odometry.size(), log.scans.size());
  auto const stretches = stretches_of(odometry);
  auto const cells = [&](OdometryBias const& bias) {
    std::size_t sum = 0;
    for (auto const& stretch : stretches) sum += cells_of(log, odometry, stretch, bias);
    return sum;
  };
  OdometryBias best;
  auto const untouched = cells(best);
  auto least = untouched;
  auto const vary = [&](double OdometryBias::* number, double step, int steps) {
    auto const middle = best.*number;
    for (int i = -steps; i <= steps; ++i) {
      auto tried = best;
      tried.*number = middle + i * step;
      if (auto const count = cells(tried); count < least) {
        least = count;
        best = tried;
      }
    }
  };
  vary(&OdometryBias::turn_per_m, 0.01, 9);
  vary(&OdometryBias::turn_per_rad, 0.02, 5);
  vary(&OdometryBias::turn_per_m, 0.0025, 5);
  vary(&OdometryBias::turn_per_rad, 0.005, 4);
  constexpr double sharper = 0.985;  // less is what chance does
  return static_cast<double>(least) < sharper * static_cast<double>(untouched) ? best : OdometryBias{};
}

}  // namespace lapwing::slam
