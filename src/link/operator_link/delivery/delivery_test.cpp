#include <gtest/gtest.h>

#include <fmt/format.h>

#include "link/operator_link/testing/delivery.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::Delivery;
using testing::Weather;

TEST_F(Delivery, GoesBothWays) {
  serve();
  connect();
  EXPECT_TRUE(at_station().send(command("Arm")));
  wait(100ms);
  EXPECT_TRUE(client->is_connected());
  EXPECT_EQ(take_all(at_drone()), Texts{"Arm"});
  EXPECT_TRUE(at_drone().send(durable("wall 1")));
  EXPECT_TRUE(at_drone().send(durable("wall 2")));
  wait(100ms);
  EXPECT_EQ(take_all(at_station()), (Texts{"wall 1", "wall 2"}));
  wait(100ms);
  EXPECT_EQ(at_drone().waiting(Kind::durable), 0u);
  EXPECT_EQ(at_station().waiting(Kind::command), 0u);
}

TEST_F(Delivery, IsConfirmedWhenTheProgramHasTakenIt) {
  serve();
  connect();
  wait(100ms);
  auto const late = loop.run_until_done(at_station().deliver(durable("a"), 500ms));
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(take_all(at_drone()), Texts{"a"});
  loop.post([this] { loop.post([this] { loop.post([this] { take_all(at_drone()); }); }); });
  base::Scope scope(loop);
  auto takes = [](Delivery& test) -> base::Task<> {
    while ((co_await test.at_drone().receive(1s)).has_value()) {
    }
  };
  scope.spawn(takes(*this));
  EXPECT_TRUE(loop.run_until_done(at_station().deliver(durable("b"), 500ms)));
}

TEST_F(Delivery, BringsWhatWasSaidDuringAnOutageOnceAndInOrder) {
  serve();
  connect();
  wait(100ms);
  network.weather = [] { return std::nullopt; };
  network.cut();
  wait(1ms);
  EXPECT_FALSE(client->is_connected());
  Texts said;
  for (int i = 0; i < 1000; ++i) {
    said.push_back(fmt::format("log {}", i));
    EXPECT_TRUE(at_drone().send(durable(said.back())));
  }
  wait(60s);
  network.weather = [] { return Weather{.delay = 10ms, .largest_piece = 50}; };
  Texts heard;
  for (int i = 0; i < 600; ++i) {
    wait(50ms);
    for (auto& text : take_all(at_station())) heard.push_back(std::move(text));
  }
  EXPECT_EQ(heard, said);
  EXPECT_TRUE(was_told("station lost: cut"));
}

/// The property: whatever is cut and whenever, durable messages of both sides arrive once and in order.
TEST_F(Delivery, SurvivesCutsAtRandomBytes) {
  std::size_t connections = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    client.reset();
    server.reset();
    // Between a byte and a few messages; hellos are 150 bytes long.
    network.weather = [&] {
      Weather weather{.delay = std::chrono::milliseconds(random() % 20), .largest_piece = 1 + random() % 100};
      if (random() % 20 != 0) weather.dies_after = 1 + random() % 3000;
      weather.tells_of_its_end = random() % 4 != 0;
      return weather;
    };
    serve();
    connect({.back_off = {.first = 10ms, .most = 100ms}});
    ASSERT_TRUE(server->expect("station"));
    Texts said_here, said_there, heard_here, heard_there;
    for (int round = 0; round < 20'000 && (heard_there.size() < much_said || heard_here.size() < much_said); ++round) {
      say_something(at_station(), said_here, random);
      say_something(at_drone(), said_there, random);
      wait(std::chrono::milliseconds(random() % 20));
      if (random() % 3 == 0)
        if (auto message = at_drone().take()) heard_there.push_back(message->text);
      for (auto& text : take_all(at_station())) heard_here.push_back(std::move(text));
    }
    ASSERT_EQ(heard_there, said_here) << "seed " << seed;
    ASSERT_EQ(heard_here, said_there) << "seed " << seed;
    connections += network.connections();
  }
  EXPECT_GT(connections, 1000u) << "there were cuts";
}

/// Every byte of one conversation in turn is the last that goes through.
TEST_F(Delivery, SurvivesACutAtEachByte) {
  for (std::size_t byte = 0; byte < 1200; ++byte) {
    client.reset();
    server.reset();
    bool is_first = true;
    network.weather = [&] {
      Weather weather;
      if (std::exchange(is_first, false)) weather.dies_after = byte;
      return weather;
    };
    serve();
    ASSERT_TRUE(server->expect("station"));
    connect({.back_off = {.first = 10ms, .most = 10ms}});
    Texts said;
    for (int i = 0; i < 5; ++i) {
      said.push_back(std::string(20, static_cast<char>('a' + i)));
      ASSERT_TRUE(at_station().send(durable(said.back())));
      ASSERT_TRUE(at_drone().send(durable(said.back())));
      ASSERT_TRUE(at_station().send(command(said.back())));
    }
    wait(1s);
    auto commands_first = said;
    commands_first.insert(commands_first.end(), said.begin(), said.end());
    ASSERT_EQ(take_all(at_drone()), commands_first) << "cut after byte " << byte;
    ASSERT_EQ(take_all(at_station()), said) << "cut after byte " << byte;
    wait(1s);
    ASSERT_EQ(at_station().waiting(Kind::durable) + at_station().waiting(Kind::command), 0u);
  }
}

TEST_F(Delivery, GivesUpCommandsOfAProgramThatEnded) {
  serve();
  connect();
  wait(100ms);
  base::Scope scope(loop);
  base::Result<> outcome;
  auto asks = [](Delivery& test, base::Result<>& result) -> base::Task<> {
    result = co_await test.at_station().deliver(command("Takeoff"), 60s);
  };
  scope.spawn(asks(*this, outcome));
  wait(100ms);
  server.reset();
  serve();
  wait(10s);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().kind, base::ErrorKind::lost);
  EXPECT_TRUE(take_all(at_drone()).empty()) << "it may have been carried out";
}

TEST_F(Delivery, SaysDurableMessagesAgainToAProgramThatStartsAnew) {
  serve();
  connect();
  wait(100ms);
  EXPECT_TRUE(at_station().send(durable("a")));
  EXPECT_TRUE(at_station().send(durable("b")));
  wait(100ms);
  EXPECT_EQ(at_drone().take()->text, "a");
  wait(100ms);
  server.reset();
  serve();
  wait(10s);
  EXPECT_EQ(take_all(at_drone()), Texts{"b"});
}

TEST_F(Delivery, ConfirmsNothingThatWasOnlyLookedAt) {
  serve();
  connect();
  wait(100ms);
  EXPECT_TRUE(at_station().send(durable("a")));
  wait(100ms);
  ASSERT_NE(at_drone().front(), nullptr);
  auto const number = at_drone().front()->number;
  EXPECT_EQ(at_drone().front()->text, "a");
  wait(100ms);
  EXPECT_EQ(at_station().waiting(Kind::durable), 1u);
  server.reset();
  serve();
  wait(10s);
  auto const again = at_drone().take();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->number, number);
  EXPECT_EQ(at_drone().front(), nullptr);
}

TEST_F(Delivery, SaysGoodBye) {
  serve();
  connect();
  wait(100ms);
  client.reset();
  wait(100ms);
  EXPECT_TRUE(was_told("drone lost: the program closed the link"));
}

TEST_F(Delivery, SpeaksJsonWithOldParts) {
  serve({.end = {.mode = Mode::json}});
  auto& drone = *server->find(Server::plain_peer);
  EXPECT_TRUE(drone.send(durable("{\"Type\":\"ErrorLog\",\"Message\":\"said before\"}")));
  network.weather = [] { return Weather{.largest_piece = 3}; };
  connect({.end = {.mode = Mode::json}});
  EXPECT_TRUE(at_station().send(command("{\"Type\":\"Arm\"}")));
  EXPECT_TRUE(at_station().send(command("no object")));
  EXPECT_TRUE(at_station().send(command("{\"Type\":\"Land\"}")));
  wait(1s);
  EXPECT_EQ(take_all(drone), (Texts{"{\"Type\":\"Arm\"}", "{\"Type\":\"Land\"}"}));
  EXPECT_TRUE(was_told("drone malformed: 'n' where an object must begin"));
  EXPECT_EQ(take_all(at_station()), Texts{"{\"Type\":\"ErrorLog\",\"Message\":\"said before\"}"});
  network.cut();
  EXPECT_TRUE(drone.send(durable("{\"n\":1}")));
  EXPECT_TRUE(drone.send(durable("{\"n\":2}")));
  wait(10s);
  EXPECT_EQ(take_all(at_station()), (Texts{"{\"n\":1}", "{\"n\":2}"}));
}

TEST_F(Delivery, ReadsNoMoreJsonThanIsTaken) {
  serve({.end = {.mode = Mode::json, .session = {.window = {.messages = 10}}}});
  auto& drone = *server->find(Server::plain_peer);
  network.weather = [] { return Weather{.largest_piece = 20}; };
  connect({.end = {.mode = Mode::json}});
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(at_station().send(durable(fmt::format("{{\"n\":{}}}", i))));
  wait(10s);
  Texts heard;
  while (auto message = loop.run_until_done(drone.receive(1s))) heard.push_back(message->text);
  ASSERT_EQ(heard.size(), 200u);
  EXPECT_EQ(heard.back(), "{\"n\":199}");
}

}  // namespace
}  // namespace lapwing::link::operator_link
