#include "robot/mapping/stands_still.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace lapwing::robot {

namespace {

constexpr double least_way_m = 0.1;
constexpr double most_turn_rad = 0.06;  ///< beams are compared one by one, and turned by whole beams
constexpr float telling_m = 0.1F;       ///< by so much a reading must differ between having driven and standing
constexpr float same_m = 0.08F;         ///< several times the noise of a scanner
constexpr double most_of_them = 0.8;    ///< of the readings that tell
constexpr double longest_gap_m = 0.25;  ///< between two readings of one surface
constexpr int enough = 20;              ///< readings that say that it stands
constexpr double beside_m = 1.0;        ///< nearer may be somebody who walks along with it
constexpr int sectors = 12;             ///< of the full circle
constexpr int enough_sectors = 5;       ///< two people who walk along are in fewer
constexpr int enough_in_sector = 3;

double cross(Eigen::Vector2d const& a, Eigen::Vector2d const& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// What each beam would measure of the surfaces that the scan saw if the robot had moved on by `motion`; 0 where that
/// says nothing.
std::vector<float> expected_after(slam::Pose2 const& motion, slam::Scan const& scan, slam::Sensor const& sensor) {
  auto const& bearings = bearings_of(scan, sensor);
  slam::Turn const turn(motion.yaw);
  Eigen::Vector2d const mount = sensor.mount_m.cast<double>();
  auto const from_there = [&](std::size_t i) -> Eigen::Vector2d {
    double const bearing = bearings[i];
    Eigen::Vector2d const end = mount + scan.ranges_m[i] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    return turn.back(end - slam::place(motion)) - mount;
  };
  // Scanners count bearings from anywhere, some from 0 to a whole turn.
  auto const bearing_of = [&](Eigen::Vector2d const& point) {
    constexpr double whole = 2.0 * std::numbers::pi;
    double const beyond_first = std::atan2(point.y(), point.x()) - bearings.front();
    return static_cast<float>(bearings.front() + beyond_first - whole * std::floor(beyond_first / whole));
  };
  std::vector<float> expected(bearings.size(), 0.0F);
  for (std::size_t i = 1; i < bearings.size(); ++i) {
    if (!sensor.is_reading(scan.ranges_m[i - 1]) || !sensor.is_reading(scan.ranges_m[i])) continue;
    auto const from = from_there(i - 1);
    auto const to = from_there(i);
    Eigen::Vector2d const along = to - from;
    if (along.norm() > longest_gap_m) continue;
    auto const first = std::ranges::lower_bound(bearings, bearing_of(from));
    auto const last = std::ranges::upper_bound(bearings, bearing_of(to));
    for (auto beam = first; beam < last; ++beam) {
      Eigen::Vector2d const way(std::cos(*beam), std::sin(*beam));
      auto const range = static_cast<float>(cross(from, along) / cross(way, along));
      auto& nearest = expected[static_cast<std::size_t>(beam - bearings.begin())];
      if (nearest == 0.0F || range < nearest) nearest = range;
    }
  }
  return expected;
}

}  // namespace

bool stands_still(slam::Scan const& before, slam::Scan const& now, slam::Sensor const& sensor,
                  slam::Pose2 const& driven) {
  if (slam::place(driven).norm() < least_way_m || std::abs(driven.yaw) > most_turn_rad) return false;
  auto const if_driven = expected_after(driven, before, sensor);
  auto const if_standing = expected_after({.yaw = driven.yaw}, before, sensor);
  auto const& bearings = bearings_of(now, sensor);
  int telling = 0;
  int standing = 0;
  std::array<int, sectors> farther_off{};
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    float const range_m = now.ranges_m[i];
    bool const tells = if_driven[i] > 0.0F && if_standing[i] > 0.0F && sensor.is_reading(range_m) &&
                       std::abs(if_driven[i] - if_standing[i]) > telling_m;
    if (!tells) continue;
    ++telling;
    float const off_m = std::abs(range_m - if_standing[i]);
    if (off_m > same_m || off_m > std::abs(range_m - if_driven[i])) continue;
    ++standing;
    double const turns = bearings[i] / (2.0 * std::numbers::pi);
    auto const sector = static_cast<std::size_t>((turns - std::floor(turns)) * sectors) % sectors;
    if (range_m > beside_m) ++farther_off[sector];
  }
  auto const directions = std::ranges::count_if(farther_off, [](int readings) { return readings >= enough_in_sector; });
  return standing >= enough && standing > most_of_them * telling && directions >= enough_sectors;
}

}  // namespace lapwing::robot
