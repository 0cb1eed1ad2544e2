#include "slam/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <ranges>

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
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.15);
}

/// What odometry would say if of every `every` scans the first `held` repeated what was said before. `is_late`: what
/// they missed is told afterwards all at once; else it is lost.
void hold_odometry(ScanLog& log, std::size_t every, std::size_t held, bool is_late) {
  std::vector<Pose2> told{log.scans[0].odometry};
  for (std::size_t i = 1; i < log.scans.size(); ++i) {
    auto const step = between(log.scans[i - 1].odometry, log.scans[i].odometry);
    auto const is_held = i >= every && i % every < held;
    auto const after = is_late ? log.scans[i].odometry : told.back() * step;
    told.push_back(is_held ? told.back() : after);
  }
  for (std::size_t i = 0; i < told.size(); ++i) log.scans[i].odometry = told[i];
}

TEST(Mapper, FollowsTheRobotWhileItsOdometryIsLate) {
  auto drive = round_the_office(1.0);
  hold_odometry(drive.log, 60, 8, true);
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.25);
}

TEST(Mapper, FollowsTheRobotWhileItsOdometryIsStuck) {
  auto drive = round_the_office(1.0);
  hold_odometry(drive.log, 150, 40, false);
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.25);
}

TEST(Mapper, FollowsARobotThatBacksWhereItsOdometryTellsItGoingAhead) {
  auto const building = testing::office(20.0, 12.0, 4.0, 1.0, 5);
  auto drive = testing::drive(building, {{0, 0}, {14, 0}}, {.beams = 91});
  // Back by the way it came: what was seen then is seen again, in the other order.
  auto const count = drive.log.scans.size();
  auto const backs = count / 3;
  auto const step_s = drive.log.scans[1].time - drive.log.scans[0].time;
  for (std::size_t i = 1; i <= backs; ++i) {
    auto scan = drive.log.scans[count - 1 - i];
    scan.time = drive.log.scans.back().time + step_s;
    scan.odometry = drive.log.scans.back().odometry *
                    between(drive.log.scans[count - 1 - i].odometry, drive.log.scans[count - i].odometry);
    drive.log.scans.push_back(scan);
    drive.truth.push_back(drive.truth[count - 1 - i]);
  }
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.25);
}

/// Once round and on: at the far corner the scans see nothing for 4 m and the turn, over which the wheels tell so much
/// too far a turn in all.
testing::Drive round_a_corner_unseen(double too_far_rad) {
  auto drive = round_the_office(1.0);
  auto& scans = drive.log.scans;
  auto const is_unseen = [&](std::size_t i) {
    return std::hypot(drive.truth[i].x - 20.0, drive.truth[i].y - 12.0) < 2.0;
  };
  auto const unseen = std::ranges::count_if(std::views::iota(std::size_t{0}, scans.size()), is_unseen);
  std::vector<Pose2> told{scans[0].odometry};
  for (std::size_t i = 1; i < scans.size(); ++i) {
    auto step = between(scans[i - 1].odometry, scans[i].odometry);
    if (is_unseen(i)) step.yaw += too_far_rad / static_cast<double>(unseen);
    told.push_back(told.back() * step);
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].odometry = told[i];
    if (is_unseen(i)) std::ranges::fill(scans[i].ranges_m, 0.0F);
  }
  return drive;
}

TEST(Mapper, ClosesALoopAfterATurnThatNoScanSaw) {
  auto const drive = round_a_corner_unseen(0.5);
  EXPECT_LT(testing::greatest_error_m(mapped(drive.log).trajectory, drive.truth), 0.5);
}

TEST(Mapper, BelievesOdometryRatherThanAScanOfNothingInParticular) {
  auto drive = round_the_office(1.0);
  std::mt19937_64 chance(3);
  std::uniform_real_distribution<float> range_m(0.4F, 3.0F);
  constexpr std::size_t every = 60;
  constexpr std::size_t a_few = 9;  // beams, a leaf or a leg each
  auto& scans = drive.log.scans;
  for (std::size_t i = every; i < scans.size(); i += every)
    for (std::size_t beam = 0; beam < scans[i].ranges_m.size(); ++beam)
      scans[i].ranges_m[beam] = beam % a_few == 0 ? range_m(chance) : 0.0F;
  Mapper mapper({}, {}, one_by_one);
  Pose2 pose;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    auto const before = pose;
    pose = mapper.follow(scans[i], drive.log.sensors[0]);
    if (i > 0 && i % every == 0) {
      auto const off = between(between(drive.truth[i - 1], drive.truth[i]), between(before, pose));
      EXPECT_LT(std::hypot(off.x, off.y), 0.1) << i;
      EXPECT_LT(std::abs(off.yaw), 0.1) << i;
    }
  }
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
