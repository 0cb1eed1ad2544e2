#include "bus/participant/bus.hpp"

#include <chrono>
#include <optional>

#include <gtest/gtest.h>

#include "bus/messages/navigation.hpp"
#include "bus/participant/topics.hpp"
#include "bus/testing/own_domain.hpp"

namespace lapwing::bus {
namespace {

using namespace std::chrono_literals;

struct BusTest : ::testing::Test {
  /// Until it holds; false when it does not within ten seconds.
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }

  base::Loop loop;
  std::unique_ptr<Bus> one = Bus::open(loop, {.domain = testing::own_domain()}).value();
  std::unique_ptr<Bus> two = Bus::open(loop, {.domain = testing::own_domain()}).value();
};

TEST(BusNames, AreThoseThatRos2Makes) {
  EXPECT_EQ(dds_topic("/robot1/scan").value(), "rt/robot1/scan");
  EXPECT_EQ(dds_type("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
  for (auto const* name : {"", "/", "scan", "/a//b", "/a/", "/a b", "/a\n"}) EXPECT_FALSE(dds_topic(name)) << name;
}

TEST(BusDomains, ThatAreNoneAreRefused) {
  base::Loop loop;
  auto const opened = Bus::open(loop, {.domain = 102});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, base::ErrorKind::invalid_input);
}

TEST_F(BusTest, MessagesOfAnySizeComeAsTheyWere) {
  std::optional<OccupancyGrid> heard;
  auto const reading = Subscription<OccupancyGrid>::open(*two, "/map", Profile::standard,
                                                         [&](OccupancyGrid const& grid) { heard = grid; });
  ASSERT_TRUE(reading);
  auto writing = Publisher<OccupancyGrid>::open(*one, "/map", Profile::standard);
  ASSERT_TRUE(writing);
  ASSERT_TRUE(comes_true([&] { return writing->readers() == 1 && reading->writers() == 1; }));
  for (std::uint32_t const side : {1U, 1000U}) {
    OccupancyGrid grid{.header = {.frame_id = "map"}, .info = {.resolution = 0.05F, .width = side, .height = side}};
    grid.data.assign(std::size_t{side} * side, 42);
    heard.reset();
    writing->publish(grid);
    ASSERT_TRUE(comes_true([&] { return heard.has_value(); })) << side;
    EXPECT_EQ(*heard, grid);
  }
}

TEST_F(BusTest, WhoComesLateGetsWhatIsLatched) {
  auto writing = Publisher<String>::open(*one, "/site", Profile::latched);
  ASSERT_TRUE(writing);
  writing->publish({"first"});
  writing->publish({"second"});
  std::vector<std::string> heard;
  auto const reading = Subscription<String>::open(*two, "/site", Profile::latched,
                                                  [&](String const& text) { heard.push_back(text.data); });
  ASSERT_TRUE(reading);
  ASSERT_TRUE(comes_true([&] { return !heard.empty(); }));
  EXPECT_EQ(heard, std::vector<std::string>{"second"});
}

TEST_F(BusTest, WhatIsNoMessageIsCountedAndLeftOut) {
  int heard = 0;
  auto const reading =
      Subscription<OccupancyGrid>::open(*two, "/map", Profile::standard, [&](OccupancyGrid const&) { ++heard; });
  auto const writing = one->write_to("/map", Description<OccupancyGrid>::name, Profile::standard);
  ASSERT_TRUE(reading && writing);
  ASSERT_TRUE(comes_true([&] { return (*writing)->readers() == 1; }));
  (*writing)->write(std::string("\0\1\0\0 not a grid", 15));
  (*writing)->write(encode(OccupancyGrid{}));
  ASSERT_TRUE(comes_true([&] { return heard == 1; }));
  EXPECT_EQ(reading->malformed(), 1U);
}

TEST_F(BusTest, ATopicHasOneType) {
  auto const writing = one->write_to("/map", "nav_msgs/msg/OccupancyGrid", Profile::standard);
  ASSERT_TRUE(writing);
  auto const other = one->write_to("/map", "std_msgs/msg/String", Profile::standard);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("already"), std::string::npos) << other.error().message;
}

TEST_F(BusTest, ATopicMayHaveAnotherTypeWhenNothingHereUsesItAnyMore) {
  auto first = one->write_to("/map", "nav_msgs/msg/OccupancyGrid", Profile::standard);
  ASSERT_TRUE(first);
  first->reset();
  EXPECT_TRUE(one->write_to("/map", "std_msgs/msg/String", Profile::standard));
}

TEST_F(BusTest, KnowsByWhichTypeOthersReadATopic) {
  constexpr auto text = Description<String>::name;
  constexpr auto number = Description<Float64>::name;
  EXPECT_FALSE(one->is_read_as("/chatter", text));
  auto reading = Subscription<String>::open(*two, "/chatter", Profile::standard, [](String const&) {});
  ASSERT_TRUE(reading);
  EXPECT_TRUE(comes_true([&] { return one->is_read_as("/chatter", text); }));
  EXPECT_FALSE(one->is_read_as("/chatter", number));
  EXPECT_FALSE(one->is_read_as("/other", text));
  EXPECT_FALSE(one->is_read_as("no topic", text));
  reading = base::fail(base::ErrorKind::cancelled, "gone");
  EXPECT_TRUE(comes_true([&] { return !one->is_read_as("/chatter", text); }));
}

TEST_F(BusTest, NothingComesAfterAReaderHasGone) {
  int heard = 0;
  auto reading = Subscription<String>::open(*two, "/chatter", Profile::standard, [&](String const&) { ++heard; });
  auto writing = Publisher<String>::open(*one, "/chatter", Profile::standard);
  ASSERT_TRUE(reading && writing);
  ASSERT_TRUE(comes_true([&] { return writing->readers() == 1; }));
  for (int i = 0; i < 100; ++i) writing->publish({"x"});
  reading = base::fail(base::ErrorKind::cancelled, "gone");
  int const until_then = heard;
  ASSERT_TRUE(comes_true([&] { return writing->readers() == 0; }));
  EXPECT_EQ(heard, until_then);
}

}  // namespace
}  // namespace lapwing::bus
