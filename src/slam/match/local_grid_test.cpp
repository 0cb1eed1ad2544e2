#include "slam/match/local_grid.hpp"

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// Two metres along a corridor.
testing::Drive along(testing::Building const& building) {
  return testing::drive(building, {{6.0, 0.0}, {8.0, 0.0}}, {.most_range_m = 8.0});
}

/// What becomes of a scan that was searched for too far back, by that much.
std::optional<Correlation> searched_too_far_back(testing::Drive const& drive, double metres) {
  auto const frame_at = [&](std::size_t scan) { return frame_of(drive.log.scans[scan], drive.log.sensors[0], {}); };
  LocalGrid grid;
  grid.move_to(drive.truth.back());
  for (std::size_t i = 0; i + 5 < drive.truth.size(); ++i) grid.add(frame_at(i), drive.truth[i]);
  auto const last = drive.truth.size() - 1;
  auto const found = correlate(grid, frame_at(last), drive.truth[last] * Pose2{-metres, 0.0, 0.0}, {.reach_m = 0.2});
  return correlate_along(grid, frame_at(last), found);
}

TEST(LocalGrid, FindsHowFarWheelsHaveSlipped) {
  auto const drive = along(testing::office(20.0, 12.0, 4.0, 1.0, 5));
  auto const found = searched_too_far_back(drive, 1.0);
  ASSERT_TRUE(found);
  EXPECT_LT(distance_m(found->pose, drive.truth.back()), 0.1);
}

TEST(LocalGrid, LeavesWheelsThatAreRightAlone) {
  EXPECT_FALSE(searched_too_far_back(along(testing::office(20.0, 12.0, 4.0, 1.0, 5)), 0.0));
}

TEST(LocalGrid, BelievesWheelsWhereACorridorTellsNothing) {
  EXPECT_FALSE(searched_too_far_back(along({{{-20, -1}, {40, -1}}, {{-20, 1}, {40, 1}}}), 1.0));
}

}  // namespace
}  // namespace lapwing::slam
