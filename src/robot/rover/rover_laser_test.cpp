// A rover with a laser on ROS 2 beside its autopilot: in real time, as the bus is.
#include <gtest/gtest.h>

#include "bus/messages/sensors.hpp"
#include "bus/testing/own_domain.hpp"
#include "robot/rover/rover_body.hpp"
#include "robot/rover/testing/scripted_rover.hpp"

namespace lapwing::robot::rover {
namespace {

using namespace std::chrono_literals;

TEST(RoverLaser, IsReadFromRosByItsOwnClock) {
  base::Loop loop;
  auto pipe = link::make_pipe(loop);
  testing::ScriptedRover rover(loop, std::move(pipe.b), robot::testing::small_office());
  RoverBody body(loop, std::move(pipe.a), {}, base::Logger());
  std::vector<slam::Scan> scans;
  body.listen({.on_scan = [&](slam::Scan const& scan) { scans.push_back(scan); }});
  ASSERT_TRUE(body.use(LaserOnRos{.domain = bus::testing::own_domain(), .name_space = "/r1"}));
  auto const ros = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  auto laser = bus::Publisher<bus::LaserScan>::open(*ros, "/r1/scan", bus::Profile::sensor_data).value();
  auto frames = bus::Publisher<bus::TFMessage>::open(*ros, "/tf_static", bus::Profile::latched).value();
  frames.publish({.transforms = {{.header = {.frame_id = "base_link"},
                                  .child_frame_id = "laser",
                                  .transform = {.translation = {.x = 0.3}}}}});
  auto const sees = [&](base::Loop& on) -> base::Task<bool> {
    for (std::int32_t i = 0; i < 200 && scans.empty(); ++i) {
      laser.publish(
          {.header = {.stamp = {.sec = 1000 + i / 10, .nanosec = static_cast<std::uint32_t>(i % 10) * 100'000'000U},
                      .frame_id = "laser"},
           .angle_min = -1.0F,
           .angle_increment = 1.0F,
           .range_min = 0.1F,
           .range_max = 10.0F,
           .ranges = {1.0F, 2.0F, 3.0F}});
      co_await on.sleep(100ms);
    }
    co_return !scans.empty();
  };
  auto watching = sees(loop);
  ASSERT_TRUE(loop.run_until_done(std::move(watching)));
  EXPECT_NEAR(body.sensor()->mount_m.x(), 0.3, 1e-6);
  EXPECT_EQ(scans.front().ranges_m, (std::vector<float>{1.0F, 2.0F, 3.0F})) << "not the companion's seventy-two";
  auto const now_s = base::to_seconds(loop.now().time_since_epoch());
  EXPECT_NEAR(scans.front().time.count(), now_s, 1.0) << "on our clock, whatever the laser's says";
}

}  // namespace
}  // namespace lapwing::robot::rover
