#include <gtest/gtest.h>

#include <fmt/format.h>

#include "link/operator_link/testing/delivery.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::Delivery;
using testing::Weather;

TEST_F(Delivery, FindsALinkThatFellSilent) {
  network.weather = [] { return Weather{.dies_after = 2000, .tells_of_its_end = false}; };
  serve();
  connect();
  wait(60s);
  EXPECT_TRUE(was_told("station lost: silent for 3.0 s"));
  EXPECT_TRUE(was_told("drone lost: silent for 3.0 s"));
  EXPECT_GT(network.connections(), 2u);
}

TEST_F(Delivery, KeepsAQuietLinkOpen) {
  serve();
  connect();
  wait(3600s);
  EXPECT_EQ(network.connections(), 1u);
  EXPECT_EQ(at_station().counters().round_trip, base::Duration(0));
}

TEST_F(Delivery, TellsTheSenderThatItIsFull) {
  serve({.end = {.queues = {.memory_bytes = 10'000}}, .expected = {"station"}});
  int taken = 0;
  base::Result<MessageId> last;
  while ((last = at_drone().send(durable(std::string(100, 'x'))))) ++taken;
  EXPECT_EQ(taken, 60);
  EXPECT_EQ(last.error().kind, base::ErrorKind::refused);
  EXPECT_TRUE(was_told("drone crowded: 9840 bytes wait to be sent, which is all there is room for"));
  connect();
  wait(1s);
  EXPECT_EQ(take_all(at_station()).size(), 60u);
  wait(1s);
  EXPECT_TRUE(was_told("drone relieved"));
  EXPECT_TRUE(at_drone().send(durable("again")));
}

TEST_F(Delivery, SendsNoMoreThanASlowReaderHasRoomFor) {
  serve({.expected = {"station"}});
  connect({.end = {.session = {.window = {.messages = 10, .bytes = 1000}}}});
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(at_drone().send(durable(fmt::format("{:0100}", i))));
  wait(60s);
  EXPECT_EQ(at_drone().counters().messages_sent, 10u);
  Texts heard;
  while (heard.size() < 500) {
    auto message = loop.run_until_done(at_station().receive(1s));
    ASSERT_TRUE(message);
    heard.push_back(message->text);
  }
  EXPECT_EQ(heard.back(), fmt::format("{:0100}", 499));
  EXPECT_EQ(network.connections(), 1u);
}

TEST_F(Delivery, GivesUpWhoTakesNothingFromItsSocket) {
  network.weather = [] { return Weather{.is_deaf = true}; };
  serve();
  connect();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(at_station().send(durable(std::string(100'000, 'x'))));
  wait(60s);
  EXPECT_FALSE(client->is_connected());
  EXPECT_EQ(client->last_error(), "the far end takes connections and says nothing");
}

TEST_F(Delivery, RefusesAWrongToken) {
  serve({.end = {.token = "right token"}});
  connect({.end = {.token = "wrong token"}});
  wait(10s);
  EXPECT_FALSE(client->is_connected());
  EXPECT_EQ(client->last_error(), "this is not the server's token");
  client.reset();
  connect();
  wait(10s);
  EXPECT_EQ(client->last_error(), "this server asks for a token");
  client.reset();
  connect({.end = {.token = "right token"}});
  wait(10s);
  EXPECT_TRUE(client->is_connected());
}

TEST_F(Delivery, RefusesAServerOfAnotherName) {
  serve();
  connect({.server = "robot"});
  wait(10s);
  EXPECT_FALSE(client->is_connected());
  EXPECT_EQ(client->last_error(), "this is 'drone', not 'robot'");
}

TEST_F(Delivery, RefusesASecondProgramOfOneName) {
  serve();
  connect();
  wait(100ms);
  auto const first = std::move(client);
  connect();
  wait(10s);
  EXPECT_TRUE(first->is_connected());
  EXPECT_EQ(client->last_error(), "another program is connected as 'station'");
}

TEST_F(Delivery, ServesSeveralEachWithItsOwn) {
  serve();
  connect();
  auto const first = std::move(client);
  connect({.end = {.name = "second"}});
  wait(100ms);
  EXPECT_EQ(server->send_to_all(durable("to all")), 0u);
  EXPECT_TRUE(server->find("second")->send(durable("to one")));
  wait(100ms);
  EXPECT_EQ(take_all(first->session()), Texts{"to all"});
  EXPECT_EQ(take_all(client->session()), (Texts{"to all", "to one"}));
}

TEST_F(Delivery, ForgetsWhomNothingWaitsForAndRefusesWhenThereIsNoRoom) {
  serve({.most_peers = 2});
  connect({.end = {.name = "a"}});
  wait(100ms);
  client.reset();
  wait(100ms);
  ASSERT_TRUE(server->find("a")->send(durable("for a")));
  connect({.end = {.name = "b"}});
  wait(100ms);
  client.reset();
  wait(100ms);
  connect({.end = {.name = "c"}});
  wait(100ms);
  EXPECT_TRUE(client->is_connected());
  EXPECT_EQ(server->find("b"), nullptr);
  auto const c = std::move(client);
  connect({.end = {.name = "d"}});
  wait(10s);
  EXPECT_EQ(client->last_error(), "2 far ends are known, and messages wait for each");
}

TEST_F(Delivery, EndsStrangersThatSayNothing) {
  serve({.most_strangers = 3});
  std::vector<std::unique_ptr<ByteStream>> silent;
  for (int i = 0; i < 10; ++i) {
    auto stream = loop.run_until_done(network.dialler()->dial());
    ASSERT_TRUE(stream);
    silent.push_back(*std::move(stream));
    wait(1ms);
  }
  EXPECT_EQ(server->strangers(), 3u);
  wait(6s);
  EXPECT_EQ(server->strangers(), 0u);
}

TEST_F(Delivery, EndsWhoSpeaksSomethingElse) {
  serve();
  auto stream = loop.run_until_done(network.dialler()->dial());
  ASSERT_TRUE(stream);
  std::string const request = "GET / HTTP/1.1\r\n\r\n";
  (*stream)->write(Bytes(reinterpret_cast<std::uint8_t const*>(request.data()), request.size()));
  wait(100ms);
  EXPECT_EQ(server->strangers(), 0u);
}

}  // namespace
}  // namespace lapwing::link::operator_link
