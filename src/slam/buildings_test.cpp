// Buildings in which one place looks like another: better a loop left open than one closed falsely.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "slam/mapper.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

Mapping mapped(ScanLog const& log) {
  return map_log(log, {}, one_by_one, [](std::string_view, double) {});
}

double error_of_odometry_m(testing::Drive const& drive) {
  std::vector<Pose2> odometry;
  for (auto const& scan : drive.log.scans) odometry.push_back(scan.odometry);
  return testing::greatest_error_m(odometry, drive.truth);
}

TEST(Buildings, SideCorridorsThatAreAllAlikeAreNotTakenForEachOther) {
  constexpr int teeth = 4;
  auto const building = testing::comb(teeth, 6.0, 9.0);
  auto const drive = testing::drive(building, testing::way_through_comb(teeth, 6.0, 9.0),
                                    {.beams = 91, .most_range_m = 8.0, .turn_bias_per_m = 0.006});
  EXPECT_GT(error_of_odometry_m(drive), 1.0);
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.5);
}

TEST(Buildings, OfficesThatAreAllAlikeAreNotTakenForEachOther) {
  auto const building = testing::office(20.0, 12.0, 4.0, 0.0, 5);
  auto const drive =
      testing::drive(building, {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 6}}, {.beams = 91});
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.5);
}

TEST(Buildings, ScansAMetreApartCloseTheLoopOfAnOffice) {
  auto const building = testing::office(20.0, 12.0, 4.0, 1.0, 5);
  auto drive = testing::drive(building, {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 6}},
                              {.beams = 181, .turn_bias_per_m = 0.02});
  testing::Drive thinned;
  thinned.log.sensors = drive.log.sensors;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    auto const is_far = thinned.truth.empty() || distance_m(thinned.truth.back(), drive.truth[i]) > 0.95 ||
                        turn_rad(thinned.truth.back(), drive.truth[i]) > 0.5;
    if (!is_far) continue;
    thinned.log.scans.push_back(drive.log.scans[i]);
    thinned.truth.push_back(drive.truth[i]);
  }
  auto const mapping = mapped(thinned.log);
  EXPECT_GT(mapping.loops.closures, 12);
  EXPECT_LT(testing::greatest_error_m(mapping.trajectory, thinned.truth), 0.25);
}

TEST(Buildings, AFewRangersCloseTheLoopOfAnOffice) {
  auto const building = testing::office(20.0, 12.0, 4.0, 1.0, 5);
  auto const drive = testing::drive(building, {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 6}},
                                    {.beams = 11, .most_range_m = 5.0, .range_noise_m = 0.01, .scale_bias = 0.01});
  EXPECT_GT(error_of_odometry_m(drive), 0.6);
  auto const mapping = mapped(drive.log);
  EXPECT_GT(mapping.loops.closures, 0);
  EXPECT_LT(testing::greatest_error_m(mapping.trajectory, drive.truth), 0.35);
}

/// Along the way, two decimetres to either side by turns.
std::vector<Eigen::Vector2d> weaving(std::vector<Eigen::Vector2d> const& way) {
  std::vector<Eigen::Vector2d> points{way.front()};
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    Eigen::Vector2d const step = (way[i + 1] - way[i]).normalized();
    Eigen::Vector2d const aside(-step.y(), step.x());
    for (double m = 1.0; m < (way[i + 1] - way[i]).norm() - 1.0; m += 2.0) {
      points.emplace_back(way[i] + m * step + 0.2 * aside);
      points.emplace_back(way[i] + (m + 1.0) * step - 0.2 * aside);
    }
    points.push_back(way[i + 1]);
  }
  return points;
}

TEST(Buildings, AFewRangersLookForLoopsFromEveryKeyFrame) {
  // Who weaves has driven a metre and is less than that from where it began. The second round meets the first.
  std::vector<Eigen::Vector2d> const rounds{{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 12}, {0, 12}};
  auto const drive =
      testing::drive(testing::office(20.0, 12.0, 4.0, 1.0, 5), weaving(rounds), {.beams = 11, .most_range_m = 5.0});
  auto const mapping = mapped(drive.log);
  std::set<int> looked_from;
  for (auto const& record : mapping.loop_records)
    if (!record.is_late) looked_from.insert(record.query);
  constexpr double round_m = 70.0;
  auto const is_second = [](KeyFrame const& frame) { return frame.path_m > round_m; };
  auto const all = std::ranges::count_if(mapping.graph.frames, is_second);
  auto const looked = std::ranges::count_if(
      looked_from, [&](int query) { return is_second(mapping.graph.frames[static_cast<std::size_t>(query)]); });
  EXPECT_GT(looked, all * 9 / 10) << "of " << all;
}

}  // namespace
}  // namespace lapwing::slam
