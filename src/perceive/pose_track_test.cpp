#include "perceive/pose_track.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;
using Place = geo::Point3<geo::SiteFrame>;

base::UtcTime at(base::Duration since) {
  return base::UtcTime(std::chrono::hours(24 * 365 * 50)) + std::chrono::duration_cast<base::UtcTime::duration>(since);
}

video::BodyPlace pose(double x, double yaw_rad = 0.0) {
  return {Place(x, 2.0, 10.0), Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))};
}

TEST(PoseTrack, TellsWhereTheDroneWasBetweenTwoPoses) {
  PoseTrack track;
  track.add(at(0ms), pose(0.0, 3.0));
  track.add(at(100ms), pose(1.0, -3.0));
  auto const there = track.at(at(25ms));
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->origin().x(), 0.25, 1e-9);
  EXPECT_NEAR(there->origin().z(), 10.0, 1e-9);
  // The shorter way round, over south.
  EXPECT_NEAR(there->yaw_rad(), 3.0 + 0.25 * (2.0 * std::numbers::pi - 6.0), 1e-9);
  EXPECT_NEAR(track.at(at(100ms))->origin().x(), 1.0, 1e-9);
}

TEST(PoseTrack, TellsNothingOfWhatItDidNotSee) {
  PoseTrack track;
  EXPECT_FALSE(track.at(at(0ms)));
  track.add(at(0ms), pose(0.0));
  track.add(at(100ms), pose(1.0));
  track.add(at(900ms), pose(9.0));
  EXPECT_FALSE(track.at(at(-1ms)));
  EXPECT_FALSE(track.at(at(500ms))) << "a gap";
  EXPECT_FALSE(track.at(at(901ms)));
  EXPECT_TRUE(track.at(at(50ms)));
}

TEST(PoseTrack, LeavesOutWhatIsNoPlaceOrLate) {
  PoseTrack track;
  track.add(at(100ms), pose(1.0));
  track.add(at(50ms), pose(7.0));
  track.add(at(150ms), pose(std::nan("")));
  ASSERT_NE(track.newest(), nullptr);
  EXPECT_EQ(track.newest()->at, at(100ms));
}

TEST(PoseTrack, BeginsAnewWhenTheClockWasSetBack) {
  PoseTrack track;
  track.add(at(10s), pose(1.0));
  track.add(at(2s), pose(3.0));
  ASSERT_NE(track.newest(), nullptr);
  EXPECT_EQ(track.newest()->at, at(2s));
  EXPECT_FALSE(track.at(at(10s)));
}

TEST(PoseTrack, KnowsHowFastTheDroneIs) {
  PoseTrack track;
  EXPECT_EQ(track.speed_m_s(), 0.0);
  for (int i = 0; i < 20; ++i) track.add(at(i * 100ms), pose(0.4 * i));
  EXPECT_NEAR(track.speed_m_s(), 4.0, 1e-9);
}

}  // namespace
}  // namespace lapwing::perceive
