#include "slam/merge/merge_maps.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/async/parallel_for.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

using Way = std::vector<Eigen::Vector2d>;

testing::Building const& building() {
  static auto const office = testing::office(30.0, 16.0, 4.0, 1.0, 5);
  return office;
}
/// From a corner along one long side and a short one; from the middle of the short one on; the last short one alone.
Way const first_way{{0, 0}, {30, 0}, {30, 12}};
Way const second_way{{30, 4}, {30, 16}, {0, 16}, {0, 8}};
Way const third_way{{8, 16}, {0, 16}, {0, 2}};

/// Each robot counts from a place of its own.
testing::Drive drive(Way const& way, std::uint64_t seed) {
  auto drive = testing::drive(building(), way, {.beams = 91, .seed = seed});
  Pose2 const own{3.0 * static_cast<double>(seed), -40.0, 0.8 * static_cast<double>(seed)};
  for (auto& scan : drive.log.scans) scan.odometry = own * scan.odometry;
  return drive;
}

MappedLog mapped(ScanLog log, std::string name = "a.log") {
  auto mapping = map_log(log, {}, one_by_one, [](std::string_view, double) {});
  return {std::move(name), std::move(log), std::move(mapping)};
}

base::Result<MergedMaps> merged(std::vector<testing::Drive> const& drives, ForEach const& for_each = one_by_one) {
  std::vector<MappedLog> logs;
  logs.reserve(drives.size());
  for (auto const& one : drives) logs.push_back(mapped(one.log, fmt::format("{}.log", logs.size() + 1)));
  return merge_maps(std::move(logs), {}, for_each, [](std::string_view, double) {});
}

std::vector<Pose2> truth_of(std::vector<testing::Drive> const& drives) {
  std::vector<Pose2> truth;
  for (auto const& one : drives) truth.insert(truth.end(), one.truth.begin(), one.truth.end());
  return truth;
}

TEST(MergeMaps, MakesOneMapOfTwoDrivesThatMeet) {
  std::vector const drives{drive(first_way, 1), drive(second_way, 2)};
  auto const maps = merged(drives);
  ASSERT_TRUE(maps) << maps.error().message;
  // What a drive of sixty metres without a loop drifts by.
  EXPECT_LT(testing::greatest_error_m(maps->mapping.trajectory, truth_of(drives)), 0.35);
  ASSERT_EQ(maps->logs.size(), 2U);
  EXPECT_EQ(maps->logs[0].closures, 0);
  EXPECT_GE(maps->logs[1].closures, 3);
  EXPECT_EQ(maps->mapping.loops.searches, static_cast<int>(maps->mapping.loop_records.size()));
  auto const joins = [](LoopRecord const& record) {
    return record.verdict == LoopRecord::Verdict::closed && record.is_late;
  };
  EXPECT_GE(std::ranges::count_if(maps->mapping.loop_records, joins), maps->logs[1].closures);
  EXPECT_EQ(maps->logs[1].first_scan, drives[0].log.scans.size());
  EXPECT_EQ(maps->log.scans.size(), drives[0].log.scans.size() + drives[1].log.scans.size());
}

TEST(MergeMaps, LeavesTheFirstMapWhereItWas) {
  std::vector const drives{drive(first_way, 1), drive(second_way, 2)};
  auto const alone = mapped(drives[0].log);
  auto const maps = merged(drives);
  ASSERT_TRUE(maps);
  EXPECT_LT(distance_m(maps->mapping.trajectory.front(), alone.mapping.trajectory.front()), 1e-9);
  EXPECT_LT(turn_rad(maps->mapping.trajectory.front(), alone.mapping.trajectory.front()), 1e-9);
}

TEST(MergeMaps, TakesALogThatMeetsOnlyALaterOne) {
  std::vector const drives{drive(first_way, 1), drive(third_way, 3), drive(second_way, 2)};
  auto const maps = merged(drives);
  ASSERT_TRUE(maps) << maps.error().message;
  EXPECT_LT(testing::greatest_error_m(maps->mapping.trajectory, truth_of(drives)), 0.3);
}

TEST(MergeMaps, DoesNotLayHalfABuildingOnItsOtherHalf) {
  // They meet for two metres only. Turned by half a circle one lies in the other's corridors all along, and at a corner
  // it fits.
  auto const maps = merged({drive(first_way, 1), drive(third_way, 3)});
  ASSERT_FALSE(maps);
  EXPECT_NE(maps.error().message.find("seems to meet"), std::string::npos) << maps.error().message;
}

TEST(MergeMaps, IsTheSameOnAnyNumberOfThreads) {
  std::vector const drives{drive(first_way, 1), drive(second_way, 2)};
  auto const threads = [](std::size_t count, std::function<void(std::size_t)> const& work) {
    base::parallel_for(4, count, work);
  };
  auto const one = merged(drives);
  auto const four = merged(drives, threads);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->mapping.trajectory, four->mapping.trajectory);
}

TEST(MergeMaps, SaysWhichLogSharesNoPlaceWithTheOthers) {
  auto const maps = merged({drive(first_way, 1), drive({{0, 6}, {0, 14}}, 4)});
  ASSERT_FALSE(maps);
  EXPECT_EQ(maps.error().kind, base::ErrorKind::invalid_input);
  EXPECT_TRUE(maps.error().message.starts_with("2.log: ")) << maps.error().message;
  EXPECT_FALSE(maps.error().hint.empty());
}

TEST(MergeMaps, DoesNotMergeLogsOfFewBeams) {
  auto few = testing::drive(building(), first_way, {.beams = 11});
  auto const maps = merged({few, few});
  ASSERT_FALSE(maps);
  EXPECT_NE(maps.error().message.find("40 readings"), std::string::npos) << maps.error().message;
}

}  // namespace
}  // namespace lapwing::slam
