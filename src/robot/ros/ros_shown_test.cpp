#include "robot/ros/ros_shown.hpp"

#include <chrono>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "bus/testing/own_domain.hpp"
#include "scans/planar.hpp"

namespace lapwing::robot::ros {
namespace {

using namespace std::chrono_literals;

map::OccupancyGrid a_small_map() {
  map::OccupancyGrid grid(0.05);
  grid.set({-2, -1}, map::Evidence::of_probability(0.1));
  grid.set({-1, -1}, map::Evidence::of_probability(0.45));
  grid.set({0, 0}, map::Evidence::of_probability(0.6));
  return grid;
}

TEST(GridMessage, IsFreeTakenOrUnknownAndNoLargerThanWhatWasSeen) {
  auto const message = grid_message(a_small_map());
  EXPECT_FLOAT_EQ(message.info.resolution, 0.05F);
  ASSERT_EQ(message.info.width, 3U);
  ASSERT_EQ(message.info.height, 2U);
  EXPECT_EQ(message.data, (std::vector<std::int8_t>{0, 0, -1, -1, -1, 100}));
  EXPECT_DOUBLE_EQ(message.info.origin.position.x, -0.1);
  EXPECT_DOUBLE_EQ(message.info.origin.position.y, -0.05);
}

TEST(GridMessage, OfNothingHasNoCells) {
  auto const message = grid_message(map::OccupancyGrid(0.05));
  EXPECT_EQ(message.info.width, 0U);
  EXPECT_TRUE(message.data.empty());
}

struct RosShownTest : ::testing::Test {
  template <bus::Message M>
  bus::Subscription<M> hear(std::string_view topic, bus::Profile profile, std::vector<M>& into) {
    return bus::Subscription<M>::open(*other, topic, profile, [&into](M const& told) { into.push_back(told); }).value();
  }
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(20ms);
      co_return wanted();
    }(loop, holds));
  }
  base::Loop loop;
  std::unique_ptr<bus::Bus> own = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  std::unique_ptr<bus::Bus> other = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  std::unique_ptr<RosShown> shown = RosShown::open(loop, *own, "/r1").value();
};

TEST_F(RosShownTest, TellsWhereItIsAndTheFrameOfItsOdometry) {
  std::vector<bus::PoseWithCovarianceStamped> poses;
  std::vector<bus::TFMessage> frames;
  auto const pose_heard = hear("/r1/pose", bus::Profile::standard, poses);
  auto const frames_heard = hear("/tf", bus::Profile::standard, frames);
  shown->set_odometry(10s + 900ms, "r1/odom");
  PoseOnMap const here{.pose = {1.0, 2.0, std::numbers::pi / 2.0},
                       .covariance = Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal(),
                       .odometry = {0.5, 0.0, 0.0}};
  ASSERT_TRUE(comes_true([&] {
    shown->show_pose(here, "/tf");
    return !poses.empty() && !frames.empty();
  }));
  auto const& pose = poses.back();
  EXPECT_EQ(pose.header.frame_id, "r1/map");
  EXPECT_EQ(pose.header.stamp, (bus::Time{.sec = 10, .nanosec = 900'000'000}));
  EXPECT_DOUBLE_EQ(pose.pose.pose.position.x, 1.0);
  EXPECT_NEAR(scans::yaw_of(pose.pose.pose.orientation), std::numbers::pi / 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(pose.pose.covariance[0], 0.01);
  EXPECT_DOUBLE_EQ(pose.pose.covariance[7], 0.02);
  EXPECT_DOUBLE_EQ(pose.pose.covariance[35], 0.03);
  ASSERT_EQ(frames.back().transforms.size(), 1U);
  auto const& frame = frames.back().transforms[0];
  EXPECT_EQ(frame.header.frame_id, "r1/map");
  EXPECT_EQ(frame.child_frame_id, "r1/odom");
  EXPECT_EQ(frame.header.stamp, (bus::Time{.sec = 11, .nanosec = 100'000'000})) << "for who has the newest scan";
  auto const there = scans::planar(frame.transform).pose * here.odometry;
  EXPECT_NEAR(slam::distance_m(there, here.pose), 0.0, 1e-9);
}

TEST_F(RosShownTest, TellsItsMapToWhoeverComesLate) {
  shown->set_odometry(10s, "odom");
  shown->show_map(a_small_map());
  ASSERT_TRUE(comes_true([this, since = loop.now()] { return loop.now() - since > 1s; }));
  std::vector<bus::OccupancyGrid> maps;
  auto const heard = hear("/r1/map", bus::Profile::latched, maps);
  ASSERT_TRUE(comes_true([&] { return !maps.empty(); }));
  EXPECT_EQ(maps.back().header.frame_id, "map");
  EXPECT_EQ(maps.back().data.size(), 6U);
}

TEST_F(RosShownTest, TellsTheWayThatItFollowsAndThatItFollowsNoneAnyMore) {
  std::vector<bus::Path> ways;
  auto const heard = hear("/r1/plan", bus::Profile::standard, ways);
  shown->set_odometry(10s, "odom");
  shown->show_way({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}});
  ASSERT_TRUE(comes_true([&] { return !ways.empty() && ways.back().poses.size() == 3; }));
  EXPECT_EQ(ways.back().header.frame_id, "map");
  EXPECT_NEAR(scans::yaw_of(ways.back().poses[0].pose.orientation), 0.0, 1e-9);
  EXPECT_NEAR(scans::yaw_of(ways.back().poses[2].pose.orientation), std::numbers::pi / 2.0, 1e-9) << "as it came";
  shown->show_way({});
  EXPECT_TRUE(comes_true([&] { return ways.back().poses.empty(); }));
}

}  // namespace
}  // namespace lapwing::robot::ros
