// A robot on the map of another drive: where it is, that it is found, and that nobody claims to know when nobody does.
#include "slam/known/localizer.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "slam/grid/draw_grid.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

std::vector<Eigen::Vector2d> const round_trip = {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}};

testing::Building an_office() {
  return testing::office(20.0, 12.0, 4.0, 1.0, 5);
}

KnownMap map_of(testing::Building const& building) {
  auto const drive = testing::drive(building, round_trip, {.seed = 7});
  return *KnownMap::make(draw_grid(drive.log, drive.truth, {}));
}

/// The other way round, and only half of it.
testing::Drive another_drive(std::vector<Eigen::Vector2d> const& way = {{0, 6}, {0, 12}, {20, 12}, {20, 4}}) {
  return testing::drive(an_office(), way, {.beams = 91, .seed = 3});
}

Localization localized(KnownMap const& map, ScanLog const& log, std::optional<Pose2> const& start = {}) {
  return localize_log(map, log, start, {}, [](std::string_view, double) {});
}

/// The largest error of all scans that are not lost.
double greatest_error_m(Localization const& done, testing::Drive const& drive) {
  double most = 0.0;
  for (std::size_t i = 0; i < done.scans.size(); ++i)
    if (!done.scans[i].is_lost) most = std::max(most, distance_m(done.scans[i].pose, drive.truth[i]));
  return most;
}

auto lost(Localization const& done) {
  return std::ranges::count_if(done.scans, &LocalizedScan::is_lost);
}

TEST(Localizer, FollowsFromAKnownStart) {
  auto const drive = another_drive();
  auto const done = localized(map_of(an_office()), drive.log, drive.truth.front());
  EXPECT_EQ(lost(done), 0);
  EXPECT_FALSE(done.start);
  EXPECT_LT(greatest_error_m(done, drive), 0.12);
}

TEST(Localizer, FindsItsStartOnTheWholeMap) {
  // In that of the other tests rooms are so much alike that a third of all drives do not tell where they began.
  auto const office = testing::office(20.0, 12.0, 4.0, 1.0, 6);
  auto const drive = testing::drive(office, {{0, 6}, {0, 12}, {20, 12}, {20, 4}}, {.beams = 91, .seed = 3});
  auto const done = localized(map_of(office), drive.log);
  ASSERT_TRUE(done.start);
  EXPECT_EQ(lost(done), 0);
  EXPECT_LT(greatest_error_m(done, drive), 0.12);
}

TEST(Localizer, FindsAStartThatLooksAlongMinusX) {
  // Half a turn to the left and half a turn to the right are the same.
  auto const drive = another_drive({{14, 12}, {2, 12}});
  auto const found = find_start(map_of(an_office()), drive.log, 0, {});
  ASSERT_TRUE(found);
  EXPECT_LT(distance_m(found->pose, drive.truth.front()), 0.2);
}

TEST(Localizer, NoticesThatItsStartWasWrongAndFindsItself) {
  auto const drive = another_drive({{0, 6}, {0, 12}, {20, 12}, {20, 0}, {0, 0}, {0, 8}});
  auto const done = localized(map_of(an_office()), drive.log, Pose2{20.0, 3.0, 1.0});
  EXPECT_GE(done.times_lost, 1);
  EXPECT_LT(lost(done), static_cast<std::ptrdiff_t>(done.scans.size() / 4));
  EXPECT_FALSE(done.scans.back().is_lost);
  EXPECT_LT(distance_m(done.scans.back().pose, drive.truth.back()), 0.12);
}

TEST(Localizer, NoticesThatTheRobotWasCarriedElsewhere) {
  // The wheels have not turned while it was carried from one corridor to the other.
  auto drive = another_drive({{2, 12}, {12, 12}});
  auto const rest = another_drive({{20, 8}, {20, 1}, {10, 0}});
  auto const carried = drive.log.scans.back().odometry;
  auto const time = drive.log.scans.back().time;
  for (std::size_t i = 0; i < rest.log.scans.size(); ++i) {
    auto scan = rest.log.scans[i];
    scan.odometry = carried * between(rest.log.scans.front().odometry, scan.odometry);
    scan.time += time;
    drive.log.scans.push_back(scan);
    drive.truth.push_back(rest.truth[i]);
  }
  auto const done = localized(map_of(an_office()), drive.log, drive.truth.front());
  EXPECT_EQ(done.times_lost, 1);
  EXPECT_FALSE(done.scans.front().is_lost);
  EXPECT_FALSE(done.scans.back().is_lost);
  EXPECT_LT(distance_m(done.scans.back().pose, drive.truth.back()), 0.12);
}

TEST(Localizer, SaysThatItIsLostInAnotherBuilding) {
  auto const drive = another_drive();
  auto const done = localized(map_of(testing::comb(3, 5.0, 9.0)), drive.log);
  EXPECT_EQ(lost(done), static_cast<std::ptrdiff_t>(done.scans.size()));
}

TEST(Localizer, IsNotSureWhereOneHalfOfTheBuildingIsLikeTheOther) {
  // Offices that are all alike look the same from the other end of the building.
  auto const alike = testing::office(20.0, 12.0, 4.0, 0.0, 5);
  auto const drive = testing::drive(alike, {{4, 0}, {16, 0}}, {.beams = 91, .seed = 3});
  auto const found = find_start(map_of(alike), drive.log, 0, {});
  EXPECT_FALSE(found);
}

TEST(Localizer, LivesThroughScansThatShowNothing) {
  auto drive = another_drive();
  for (std::size_t i = 20; i < 24; ++i) std::ranges::fill(drive.log.scans[i].ranges_m, 0.0F);
  auto const done = localized(map_of(an_office()), drive.log, drive.truth.front());
  EXPECT_FALSE(done.scans.back().is_lost);
  EXPECT_LT(distance_m(done.scans.back().pose, drive.truth.back()), 0.12);
  EXPECT_TRUE(localized(map_of(an_office()), {}).scans.empty());
}

}  // namespace
}  // namespace lapwing::slam
