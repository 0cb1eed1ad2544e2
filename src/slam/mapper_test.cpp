#include "slam/mapper.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/async/parallel_for.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// Once and a half round a ring of corridors.
testing::Drive round_the_office(double variety) {
  auto const building = testing::office(20.0, 12.0, 4.0, variety, 5);
  return testing::drive(building, {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 6}}, {.beams = 91});
}

Mapping mapped(ScanLog const& log, ForEach const& for_each = one_by_one) {
  return map_log(log, {}, for_each, [](std::string_view, double) {});
}

TEST(Mapper, ClosesTheLoopOfAnOfficeAgainstDriftingOdometry) {
  auto const drive = round_the_office(1.0);
  std::vector<Pose2> odometry;
  for (auto const& scan : drive.log.scans) odometry.push_back(scan.odometry);
  ASSERT_GT(testing::greatest_error_m(odometry, drive.truth), 0.8);
  auto const mapping = mapped(drive.log);
  EXPECT_GT(mapping.loops.closures, 0);
  EXPECT_LT(testing::greatest_error_m(mapping.trajectory, drive.truth), 0.1);
}

TEST(Mapper, IsTheSameOnAnyNumberOfThreads) {
  auto const drive = round_the_office(1.0);
  auto const threads = [](std::size_t count, std::function<void(std::size_t)> const& work) {
    base::parallel_for(4, count, work);
  };
  EXPECT_EQ(mapped(drive.log).trajectory, mapped(drive.log, threads).trajectory);
}

TEST(Mapper, KnowsWhereTheRobotIsAfterEveryScan) {
  auto const drive = round_the_office(1.0);
  Mapper mapper({}, {}, one_by_one);
  auto most_m = 0.0;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    auto const pose = mapper.follow(drive.log.scans[i], drive.log.sensors[0]);
    mapper.close_loops();
    most_m = std::max(most_m, distance_m(pose, drive.truth[i]));
    EXPECT_EQ(mapper.graph().frames.size(), mapper.graph().poses.size());
  }
  EXPECT_LT(most_m, 0.6);
  EXPECT_FALSE(mapper.grid({}).tiles().empty());
}

TEST(Mapper, IsNotCarriedAwayByAJumpOfOdometry) {
  auto drive = round_the_office(1.0);
  Pose2 const jump{4.0, -3.0, 1.2};
  for (std::size_t i = drive.log.scans.size() / 3; i < drive.log.scans.size(); ++i)
    drive.log.scans[i].odometry = jump * drive.log.scans[i].odometry;
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.15);
}

TEST(Mapper, IsNotCarriedAwayByWheelsThatSlip) {
  auto drive = round_the_office(1.0);
  constexpr std::size_t every = 90;
  constexpr std::size_t slipping = 8;  // scans, over which the robot goes 0.8 m and the wheels tell a tenth of it
  auto& scans = drive.log.scans;
  std::vector<Pose2> told{scans[0].odometry};
  for (std::size_t i = 1; i < scans.size(); ++i) {
    auto step = between(scans[i - 1].odometry, scans[i].odometry);
    if (i % every < slipping) step.x *= 0.1;
    told.push_back(told.back() * step);
  }
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].odometry = told[i];
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.6);
}

TEST(Mapper, MapsByScansAloneWhereThereIsNoOdometry) {
  auto drive = round_the_office(1.0);
  for (auto& scan : drive.log.scans) scan.odometry = {};
  drive.log.has_odometry = false;
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.2);
}

TEST(Mapper, OfNothingIsNothing) {
  EXPECT_TRUE(mapped({}).trajectory.empty());
}

}  // namespace
}  // namespace lapwing::slam
