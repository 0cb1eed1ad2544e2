#include "robot/ros/ros_body.hpp"

#include <chrono>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "bus/testing/own_domain.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot::ros {
namespace {

using namespace std::chrono_literals;

/// A robot on ROS 2: the other end of the topics.
struct RosBodyTest : ::testing::Test {
  RosBodyTest() {
    body->listen({.on_reading = [this](Reading const& reading) { readings.push_back(reading); },
                  .on_scan = [this](slam::Scan const& scan) { scans.push_back(scan); }});
    // Each end finds the other in its own time; what is said before both have is lost.
    say_where_the_laser_is();
    EXPECT_TRUE(comes_true([&] {
      be_at(1, 0.0);
      see(0, 0, 1.0F);
      body->drive({.speed_m_s = 0.3});
      return !readings.empty() && body->sensor() && !scans.empty() && !driven.empty();
    }));
    EXPECT_TRUE(comes_true([&] { return is_quiet(); }));
    readings.clear();
    scans.clear();
    driven.clear();
  }
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }
  /// What was under way has come: nothing did for a while.
  bool is_quiet() {
    auto const before = std::tuple(readings.size(), scans.size(), driven.size());
    if (heard_then_ != before) quiet_since_ = loop.now();
    heard_then_ = before;
    return loop.now() - quiet_since_ > 200ms;
  }
  void be_at(std::int32_t second, double x, std::uint32_t nanosecond = 0) {
    bus::Odometry message{.header = {.stamp = {.sec = second, .nanosec = nanosecond}, .frame_id = "odom"},
                          .child_frame_id = "base_link"};
    message.pose.pose.position.x = x;
    message.twist.twist.linear.x = 0.2;
    odometry.publish(message);
  }
  void see(std::int32_t second, std::uint32_t nanosecond, float range_m) {
    laser.publish({.header = {.stamp = {.sec = second, .nanosec = nanosecond}, .frame_id = "laser"},
                   .angle_min = -1.0F,
                   .angle_increment = 1.0F,
                   .range_min = 0.1F,
                   .range_max = 10.0F,
                   .ranges = {range_m, range_m, range_m}});
  }
  /// A scanner that turns from its right to its left in 0.4 s.
  void see_slowly(std::int32_t second) {
    laser.publish({.header = {.stamp = {.sec = second}, .frame_id = "laser"},
                   .angle_min = -1.0F,
                   .angle_increment = 1.0F,
                   .time_increment = 0.2F,
                   .range_min = 0.1F,
                   .range_max = 10.0F,
                   .ranges = {3.0F, 3.0F, 3.0F}});
  }
  void say_where_the_laser_is() {
    frames.publish({.transforms = {{.header = {.frame_id = "base_link"},
                                    .child_frame_id = "laser",
                                    .transform = {.translation = {.x = 0.3}}}}});
  }

  base::Loop loop;
  base::LogHub hub;
  std::unique_ptr<bus::Bus> ros = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  bus::Publisher<bus::Odometry> odometry =
      bus::Publisher<bus::Odometry>::open(*ros, "/r1/odom", bus::Profile::standard).value();
  bus::Publisher<bus::LaserScan> laser =
      bus::Publisher<bus::LaserScan>::open(*ros, "/r1/scan", bus::Profile::sensor_data).value();
  bus::Publisher<bus::TFMessage> frames =
      bus::Publisher<bus::TFMessage>::open(*ros, "/tf_static", bus::Profile::latched).value();
  std::vector<bus::Twist> driven;
  /// Its driver.
  std::optional<bus::Subscription<bus::Twist>> commands =
      bus::Subscription<bus::Twist>::open(*ros, "/r1/cmd_vel", bus::Profile::standard, [this](bus::Twist const& twist) {
        driven.push_back(twist);
      }).value();
  std::vector<Reading> readings;
  std::vector<slam::Scan> scans;
  std::unique_ptr<RosBody> body =
      RosBody::open(loop, {.domain = bus::testing::own_domain(), .name_space = "/r1"}, base::Logger(hub, "robot"))
          .value();

 private:
  std::tuple<std::size_t, std::size_t, std::size_t> heard_then_;
  base::TimePoint quiet_since_{};
};

TEST_F(RosBodyTest, LaysScansWhereTheRobotWasThen) {
  EXPECT_NEAR(body->sensor()->mount_m.x(), 0.3, 1e-6);
  be_at(10, 1.0);
  ASSERT_TRUE(comes_true([&] { return !readings.empty(); }));
  EXPECT_DOUBLE_EQ(readings.back().odometry.x, 1.0);
  EXPECT_DOUBLE_EQ(readings.back().speed_m_s, 0.2);
  see(10, 500'000'000, 3.0F);
  ASSERT_TRUE(comes_true([&] { return is_quiet(); }));
  EXPECT_TRUE(scans.empty()) << "nobody knows yet where it was";
  be_at(11, 2.0);
  ASSERT_TRUE(comes_true([&] { return !scans.empty(); }));
  EXPECT_DOUBLE_EQ(scans.back().odometry.x, 1.5) << "halfway between the two moments";
  EXPECT_EQ(scans.back().ranges_m, (std::vector<float>{3.0F, 3.0F, 3.0F}));
  EXPECT_DOUBLE_EQ(scans.back().time.count(), 10.5);
}

// Scanners of small robots turn five times a second. What was seen at first is then many messages of odometry ago.
TEST_F(RosBodyTest, LaysTheBeamsOfASlowScannerWhereEachLookedFrom) {
  be_at(10, 1.0);
  see_slowly(10);
  be_at(10, 1.2, 200'000'000);
  be_at(10, 1.3, 300'000'000);
  ASSERT_TRUE(comes_true([&] { return is_quiet(); }));
  EXPECT_TRUE(scans.empty()) << "nobody knows yet where its last beam looked from";
  be_at(10, 1.5, 500'000'000);
  ASSERT_TRUE(comes_true([&] { return !scans.empty(); }));
  auto const& scan = scans.back();
  EXPECT_NEAR(scan.time.count(), 10.2, 1e-6);
  EXPECT_NEAR(scan.odometry.x, 1.2, 1e-6);
  auto const end_x = [&](std::size_t beam) {
    return scan.ranges_m[beam] * std::cos(bearings_of(scan, *body->sensor())[beam]);
  };
  EXPECT_NEAR(end_x(0), 3.0 * std::cos(1.0) - 0.2, 1e-4);
  EXPECT_NEAR(end_x(1), 3.0, 1e-4);
  EXPECT_NEAR(end_x(2), 3.0 * std::cos(1.0) + 0.2, 1e-4);
}

TEST_F(RosBodyTest, SaysHowItsBaseIsAndWhenItIsAway) {
  be_at(10, 1.0);
  ASSERT_TRUE(comes_true([&] { return !readings.empty(); }));
  EXPECT_EQ(body->take_carrier_code(), code::none);
  EXPECT_EQ(body->take_carrier_code(), std::nullopt) << "nothing new was heard of it";
  std::optional<std::uint16_t> said;
  auto const says = [&](std::uint16_t code) {
    if (auto const now = body->take_carrier_code()) said = now;
    return said == code;
  };
  EXPECT_TRUE(comes_true([&] { return says(code::board_away); }));
  body->kill();
  be_at(11, 1.0);
  EXPECT_TRUE(comes_true([&] { return says(code::killed); }));
}

TEST_F(RosBodyTest, DrivesAndLeavesARobotAloneThatStands) {
  body->drive({.speed_m_s = 0.3, .turn_rad_s = -0.5});
  ASSERT_TRUE(comes_true([&] { return driven.size() == 1; }));
  EXPECT_DOUBLE_EQ(driven[0].linear.x, 0.3);
  EXPECT_DOUBLE_EQ(driven[0].angular.z, -0.5);
  for (int i = 0; i < 10; ++i) body->drive({});
  body->drive({.speed_m_s = 0.1});
  ASSERT_TRUE(comes_true([&] { return driven.size() == 5 && driven.back().linear.x == 0.1; })) << driven.size();
  EXPECT_EQ(driven[1], bus::Twist{});
}

TEST_F(RosBodyTest, StandsWhileItIsKilledWhateverItIsTold) {
  body->kill();
  body->drive({.speed_m_s = 0.3});
  ASSERT_TRUE(comes_true([&] { return driven.size() >= 5; })) << "zero again and again";
  for (auto const& twist : driven) EXPECT_EQ(twist, bus::Twist{});
  be_at(1, 0.0);
  ASSERT_TRUE(comes_true([&] { return !readings.empty(); }));
  EXPECT_TRUE(readings.back().is_killed);
  body->release();
  body->drive({.speed_m_s = 0.3});
  ASSERT_TRUE(comes_true([&] { return driven.back().linear.x == 0.3; }));
}

TEST_F(RosBodyTest, StandsWhenItGoes) {
  body->drive({.speed_m_s = 0.3});
  ASSERT_TRUE(comes_true([&] { return driven.size() == 1; }));
  body.reset();
  ASSERT_TRUE(comes_true([&] { return driven.size() == 2; }));
  EXPECT_EQ(driven.back(), bus::Twist{});
}

// As most drivers want it since ROS 2 Jazzy.
TEST_F(RosBodyTest, DrivesABaseThatTakesStampedCommands) {
  commands.reset();
  std::vector<bus::TwistStamped> stamped;
  auto const elsewhere = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  auto const driver =
      bus::Subscription<bus::TwistStamped>::open(*elsewhere, "/r1/cmd_vel", bus::Profile::standard,
                                                 [&](bus::TwistStamped const& command) { stamped.push_back(command); });
  ASSERT_TRUE(driver);
  ASSERT_TRUE(comes_true([&] {
    be_at(10, 0.0);
    body->drive({.speed_m_s = 0.2, .turn_rad_s = -0.5});
    return !stamped.empty();
  }));
  EXPECT_EQ(stamped.back().twist.linear.x, 0.2);
  EXPECT_EQ(stamped.back().twist.angular.z, -0.5);
  EXPECT_EQ(stamped.back().header.frame_id, "base_link");
  EXPECT_EQ(stamped.back().header.stamp, bus::Time{}) << "which drivers take for now";
  body->kill();
  EXPECT_TRUE(comes_true([&] { return stamped.back().twist == bus::Twist{}; }));
}

TEST_F(RosBodyTest, KeepsToADriverOfOneTypeWhoeverWatchesByTheOther) {
  auto const elsewhere = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  auto const watching = bus::Subscription<bus::TwistStamped>::open(*elsewhere, "/r1/cmd_vel", bus::Profile::standard,
                                                                   [](bus::TwistStamped const&) {});
  ASSERT_TRUE(watching);
  auto const knows_of_it = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  ASSERT_TRUE(comes_true([&] {
    return knows_of_it->is_read_as("/r1/cmd_vel", bus::Description<bus::TwistStamped>::name) &&
           knows_of_it->is_read_as("/r1/cmd_vel", bus::Description<bus::Twist>::name);
  }));
  driven.clear();
  body->drive({.speed_m_s = 0.1});
  EXPECT_TRUE(comes_true([&] { return !driven.empty(); }));
}

TEST_F(RosBodyTest, SaysThatNobodyListensToItsCommands) {
  commands.reset();
  std::optional<std::uint16_t> said;
  EXPECT_TRUE(comes_true([&] {
    be_at(10, 0.0);
    body->drive({.speed_m_s = 0.2});
    if (auto const now = body->take_carrier_code()) said = now;
    return said == code::nobody_drives;
  }));
  body->drive({});
  EXPECT_TRUE(comes_true([&] {
    be_at(10, 0.0);
    if (auto const now = body->take_carrier_code()) said = now;
    return said == code::none;
  })) << "it is not driven";
}

TEST_F(RosBodyTest, KnowsItsBatteryFromZeroToOneAndInPercent) {
  auto battery = bus::Publisher<bus::BatteryState>::open(*ros, "/r1/battery_state", bus::Profile::sensor_data).value();
  auto const shows = [&](float told, double wanted) {
    return comes_true([&] {
      battery.publish({.percentage = told});
      be_at(10, 0.0);
      return !readings.empty() && std::abs(readings.back().battery.value_or(-1.0) - wanted) < 1e-6;
    });
  };
  EXPECT_TRUE(shows(0.25F, 0.25));
  EXPECT_TRUE(shows(1.02F, 1.0)) << "a full one";
  EXPECT_TRUE(shows(40.0F, 0.4)) << "as a Kobuki's driver tells it";
  EXPECT_TRUE(shows(1.0F, 0.01)) << "which is nearly empty, then";
}

}  // namespace
}  // namespace lapwing::robot::ros
