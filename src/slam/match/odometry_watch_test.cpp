#include "slam/match/odometry_watch.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr LogTime scan_period(0.2);

TEST(OdometryWatch, KnowsALeapUntilTheNextKeyFrame) {
  OdometryWatch watch;
  watch.follow({5.0, 0.0, 0.0}, LogTime(0.0));
  EXPECT_FALSE(watch.has_leapt());  // where a drive begins is anywhere
  watch.follow({5.2, 0.0, 0.0}, scan_period);
  EXPECT_FALSE(watch.has_leapt());
  watch.follow({0.0, 0.0, 0.0}, scan_period);
  watch.follow({0.1, 0.0, 0.0}, scan_period);
  EXPECT_TRUE(watch.has_leapt());
  watch.begin_key_frame();
  EXPECT_FALSE(watch.has_leapt());
}

TEST(OdometryWatch, SuspectsWhatSaysNextToNothingForSeveralScans) {
  OdometryWatch watch;
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  EXPECT_FALSE(watch.is_suspiciously_still());  // odometry may come at half the rate of the scans
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  EXPECT_TRUE(watch.is_suspiciously_still());
  watch.follow({1.01, 0.0, 0.0}, scan_period);
  EXPECT_TRUE(watch.is_suspiciously_still());  // wheels that spin creep
  watch.follow({1.1, 0.0, 0.0}, scan_period);
  EXPECT_FALSE(watch.is_suspiciously_still());
}

TEST(OdometryWatch, LeavesARobotAloneThatWasSeenToStandUntilItMovesAgain) {
  OdometryWatch watch;
  for (int i = 0; i < 4; ++i) watch.follow({1.0, 0.0, 0.0}, scan_period);
  watch.found_still(true);
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  EXPECT_FALSE(watch.is_suspiciously_still());
  watch.follow({1.2, 0.0, 0.0}, scan_period);
  for (int i = 0; i < 3; ++i) watch.follow({1.2, 0.0, 0.0}, scan_period);
  EXPECT_TRUE(watch.is_suspiciously_still());
}

TEST(OdometryWatch, LooksAgainEverLessOftenWhereNothingShowsWhetherTheRobotMoves) {
  OdometryWatch watch;
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  int looks = 0;
  for (int i = 0; i < 100; ++i) {
    watch.follow({1.0, 0.0, 0.0}, scan_period);
    if (!watch.is_suspiciously_still()) continue;
    ++looks;
    watch.found_still(false);
  }
  EXPECT_GE(looks, 15);  // every second or so in twenty
  EXPECT_LE(looks, 22);
}

TEST(OdometryWatch, ComparesNothingAcrossTheBeginningOfADrive) {
  OdometryWatch watch;
  watch.follow({1.0, 0.0, 0.0}, scan_period);
  watch.begin_drive();
  watch.follow({40.0, 0.0, 0.0}, scan_period);
  EXPECT_FALSE(watch.has_leapt());
}

}  // namespace
}  // namespace lapwing::slam
