#include "bridge/flight_topics.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bridge/frames.hpp"
#include "bus/messages/mavros_names.hpp"
#include "bus/participant/topics.hpp"
#include "bus/testing/own_domain.hpp"

namespace lapwing::bridge {
namespace {

using namespace std::chrono_literals;

auto const origin = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);

struct HomeTest : ::testing::Test {
  HomeTest() {
    flight.heartbeat = mavlink::Heartbeat{};
    topics = FlightTopics::open(loop, *bus, flight, 0.0).value();
    reading.emplace(bus::Subscription<bus::mavros::HomePosition>::open(
                        *bus, bus::mavros::names::home, bus::Profile::latched,
                        [this](bus::mavros::HomePosition const& home) { heard.push_back(home); })
                        .value());
  }
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }
  void hear_home(double north_m) {
    topics->tell(mavlink::HomePosition{.position = geo::displaced(origin, {.north = north_m})});
  }
  void hear_origin() {
    flight.origin = origin;
    topics->tell(mavlink::GpsGlobalOrigin{.position = origin});
  }

  base::Loop loop;
  std::unique_ptr<bus::Bus> bus = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  FlightController flight;
  std::unique_ptr<FlightTopics> topics;
  std::vector<bus::mavros::HomePosition> heard;
  std::optional<bus::Subscription<bus::mavros::HomePosition>> reading;
};

// Both are told every two seconds: whoever waits for the next home waits for up to four.
TEST_F(HomeTest, IsToldAsSoonAsTheOriginIsKnownToo) {
  hear_home(7.0);
  hear_origin();
  ASSERT_TRUE(comes_true([&] { return !heard.empty(); }));
  EXPECT_NEAR(heard[0].position.y, 7.0, 1e-3);
}

TEST_F(HomeTest, IsToldOnceForEachTimeThatItComes) {
  hear_home(7.0);
  hear_origin();
  hear_origin();
  hear_home(9.0);
  ASSERT_TRUE(comes_true([&] { return !heard.empty() && heard.back().position.y > 8.0; }));
  EXPECT_LE(heard.size(), 2U);
}

struct PoseTest : HomeTest {
  PoseTest() {
    poses.emplace(
        bus::Subscription<bus::PoseStamped>::open(*bus, bus::mavros::names::local_pose, bus::Profile::standard,
                                                  [this](bus::PoseStamped const& pose) { told.push_back(pose); })
            .value());
  }
  /// Tells it again until the reader has been found.
  void hear(base::Duration since_boot) {
    mavlink::LocalPosition const position{.since_boot = since_boot, .position_m = geo::Ned{.north = 3.0}};
    auto const before = told.size();
    ASSERT_TRUE(comes_true([&, this] {
      if (told.size() == before) topics->tell(position);
      return told.size() > before;
    }));
  }
  [[nodiscard]] static double seconds(bus::PoseStamped const& pose) {
    return static_cast<double>(pose.header.stamp.sec) + 1e-9 * static_cast<double>(pose.header.stamp.nanosec);
  }

  std::vector<bus::PoseStamped> told;
  std::optional<bus::Subscription<bus::PoseStamped>> poses;
};

TEST_F(PoseTest, IsStampedWithWhenItWasMeasuredAndNotWithWhenItCame) {
  flight.attitude = mavlink::Attitude{};
  hear(1000ms);
  auto const held_up_until = loop.now() + 200ms;
  ASSERT_TRUE(comes_true([&] { return loop.now() > held_up_until; }));
  hear(1020ms);
  EXPECT_NEAR(seconds(told.back()) - seconds(told.front()), 0.02, 0.01);
}

TEST_F(PoseTest, IsTurnedAsItWasAtThatMoment) {
  flight.attitude = mavlink::Attitude{.since_boot = 900ms, .yaw_rad = 0.5, .yaw_rate_rad_s = 1.0};
  hear(1000ms);
  auto const as_then = ros_orientation({.yaw_rad = 0.6});
  EXPECT_NEAR(told.back().pose.orientation.z, as_then.z, 1e-6);
  EXPECT_NEAR(told.back().pose.orientation.w, as_then.w, 1e-6);
  // What is older says nothing of how it turns now.
  flight.attitude->since_boot = 100ms;
  hear(1010ms);
  EXPECT_NEAR(told.back().pose.orientation.z, ros_orientation({.yaw_rad = 0.5}).z, 1e-6);
}

}  // namespace
}  // namespace lapwing::bridge
