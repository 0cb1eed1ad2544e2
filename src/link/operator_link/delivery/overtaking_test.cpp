#include <gtest/gtest.h>

#include <fmt/format.h>

#include "link/operator_link/testing/delivery.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::Delivery;
using testing::Weather;

TEST_F(Delivery, KeepsOnlyTheNewestOfAKey) {
  serve();
  connect();
  wait(100ms);
  network.weather = [] { return std::nullopt; };
  network.cut();
  wait(1ms);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(at_drone().send(latest(fmt::format("pose {}", i), "pose")));
    EXPECT_TRUE(at_drone().send(latest(fmt::format("battery {}", i), "battery")));
  }
  EXPECT_EQ(at_drone().waiting(Kind::latest), 2u);
  network.weather = [] { return Weather{}; };
  wait(10s);
  EXPECT_EQ(take_all(at_station()), (Texts{"pose 999", "battery 999"}));
}

TEST_F(Delivery, LetsOnlyOneOfAKeyWaitAtTheFarEnd) {
  serve();
  connect();
  wait(100ms);
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(at_drone().send(latest(fmt::format("pose {}", i), "pose")));
    wait(10ms);
  }
  EXPECT_EQ(take_all(at_station()), Texts{"pose 0"}) << "it was under way when the others came";
  wait(100ms);
  EXPECT_EQ(take_all(at_station()), Texts{"pose 49"});
}

TEST_F(Delivery, LetsCommandsOvertakeWhatTheyMakeObsolete) {
  serve();
  connect();
  wait(100ms);
  network.weather = [] { return std::nullopt; };
  network.cut();
  wait(1ms);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(at_station().send(durable(fmt::format("log {}", i))));
  auto const first = at_station().send(command("move to 1", "move"));
  EXPECT_TRUE(at_station().send(command("Land")));
  base::Scope scope(loop);
  base::Result<> outcome;
  auto follows = [](Delivery& test, MessageId id, base::Result<>& result) -> base::Task<> {
    result = co_await test.at_station().taken(id, 60s);
  };
  scope.spawn(follows(*this, *first, outcome));
  EXPECT_TRUE(at_station().send(command("move to 2", "move")));
  network.weather = [] { return Weather{}; };
  wait(10s);
  auto heard = take_all(at_drone());
  heard.resize(3);
  EXPECT_EQ(heard, (Texts{"Land", "move to 2", "log 0"})) << "before what has waited for longer";
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().message, "a newer message took its place before it was taken");
}

TEST_F(Delivery, OvertakesAtTheFarEndToo) {
  serve();
  connect();
  wait(100ms);
  EXPECT_TRUE(at_station().send(command("move to 1", "move")));
  wait(100ms);
  EXPECT_TRUE(at_station().send(command("move to 2", "move")));
  wait(100ms);
  EXPECT_EQ(at_station().waiting(Kind::command), 1u) << "the first came back";
  EXPECT_EQ(take_all(at_drone()), Texts{"move to 2"});
}

TEST_F(Delivery, LetsNothingArriveAfterItsExpiry) {
  serve();
  connect();
  wait(100ms);
  network.weather = [] { return std::nullopt; };
  network.cut();
  wait(1ms);
  auto const result = loop.run_until_done(at_station().deliver(command("Takeoff", {}, 2s), 10s));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "it expired before it was taken");
  EXPECT_TRUE(at_station().send(command("Land", {}, 60s)));
  network.weather = [] { return Weather{}; };
  wait(30s);
  EXPECT_EQ(take_all(at_drone()), Texts{"Land"});
}

TEST_F(Delivery, ReturnsWhatExpiresAtTheFarEnd) {
  serve();
  connect();
  wait(100ms);
  base::Scope scope(loop);
  auto takes_late = [](Delivery& test) -> base::Task<> {
    co_await test.loop.sleep(5s);
    EXPECT_TRUE(take_all(test.at_drone()).empty());
  };
  scope.spawn(takes_late(*this));
  auto const result = loop.run_until_done(at_station().deliver(command("Takeoff", {}, 2s), 10s));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "it expired before it was taken");
}

TEST_F(Delivery, CountsTheTimeOnAWayThatHasBecomeSlow) {
  serve();
  connect();
  wait(2s);  // pings show how fast it can be
  auto slow = 0ms;
  network.weather = [&] { return Weather{.delay = slow}; };
  EXPECT_TRUE(at_station().send(command("quick", {}, 1s)));
  wait(900ms);
  EXPECT_EQ(take_all(at_drone()), Texts{"quick"});
  EXPECT_EQ(at_drone().counters().connections, 1u);
}

}  // namespace
}  // namespace lapwing::link::operator_link
