#include "slam/scan/gather.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

/// Two rangers that look to the sides of a corridor 2 m wide, driven along its middle in steps of 5 cm.
Sensor const sides{.bearings_rad = {-1.5707963F, 1.5707963F}};
Scan side_scan() {
  return {.odometry = {}, .ranges_m = {1.0F, 1.0F}};
}

TEST(Gatherer, MakesWallsOfSingleReadingsAlongTheWay) {
  Gatherer gatherer({.least_m = 1.0, .enough_points = 30}, {});
  int scans = 0;
  for (; !gatherer.is_due(); ++scans) {
    ASSERT_LT(scans, 100);
    gatherer.add(side_scan(), sides, {3.0 + 0.05 * scans, 2.0, 0.0});
  }
  EXPECT_GE(scans, 20);
  auto const frame = gatherer.take();
  ASSERT_EQ(frame.points.size(), static_cast<std::size_t>(2 * scans));
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    EXPECT_NEAR(std::abs(frame.points[k].y()), 1.0F, 1e-4);
    EXPECT_LE(frame.points[k].x(), 1e-4F) << "what was passed lies behind";
    ASSERT_TRUE(frame.has_normal(k)) << k;
    EXPECT_NEAR(frame.normals[k].y(), frame.points[k].y() > 0 ? -1.0F : 1.0F, 1e-3) << "towards who saw it";
  }
  EXPECT_TRUE(std::ranges::is_sorted(frame.first_of_bin));
  EXPECT_EQ(frame.first_of_bin.back(), static_cast<std::int32_t>(frame.points.size()));
  EXPECT_TRUE(gatherer.is_empty());
}

TEST(Gatherer, TakesNothingTwiceFromWhereTheRobotStands) {
  Gatherer gatherer({}, {});
  for (int i = 0; i < 50; ++i) gatherer.add(side_scan(), sides, {});
  EXPECT_EQ(gatherer.take().points.size(), 2U);
}

TEST(Gatherer, IsDueAfterATurnAndWhereLittleIsSeen) {
  Gatherer turning({}, {});
  for (int i = 0; i < 12; ++i) turning.add(side_scan(), sides, {0.0, 0.0, 0.1 * i});
  EXPECT_TRUE(turning.is_due());
  Gatherer blind({}, {});
  for (int i = 0; i < 40; ++i) blind.add({.odometry = {}, .ranges_m = {0.0F, 0.0F}}, sides, {0.1 * i, 0.0, 0.0});
  EXPECT_TRUE(blind.is_due());
  EXPECT_TRUE(blind.take().points.empty());
}

}  // namespace
}  // namespace lapwing::slam
