#include "link/operator_link/message_socket.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;

class MessageSocketTest : public ::testing::Test {
 public:
  static ServeSettings to_serve(std::uint16_t port = 0) { return {.port = port, .server = {.end = {.name = "drone"}}}; }
  static ConnectSettings to_connect(std::uint16_t port) {
    return {.port = port, .client = {.end = {.name = "station"}, .back_off = {.first = 10ms, .most = 50ms}}};
  }
  /// The server's port is only known once its `init` waits.
  void open() {
    drone = std::make_unique<MessageSocket>(loop, to_serve(), MessageSocket::Times{5s, 2s});
    auto serving = drone->init();
    serving.start();
    station = std::make_unique<MessageSocket>(loop, to_connect(drone->port()), MessageSocket::Times{5s, 2s});
    auto const connected = loop.run_until_done(station->init());
    ASSERT_TRUE(connected) << connected.error().message;
    while (!serving.done()) loop.run_until_done(turn());
    ASSERT_TRUE(serving.take());
  }
  base::Task<int> turn() {
    co_await loop.sleep(1ms);
    co_return 0;
  }
  /// As a program would: asks until there is one.
  base::Task<std::string> get(MessageSocket& socket) {
    for (int tries = 0; tries < 5000; ++tries) {
      auto message = socket.get_message();
      if (message) co_return *message;
      co_await loop.sleep(1ms);
    }
    co_return "nothing came";
  }

  base::Loop loop;
  std::unique_ptr<MessageSocket> drone;
  std::unique_ptr<MessageSocket> station;
};

TEST_F(MessageSocketTest, CarriesTextsBothWays) {
  open();
  EXPECT_TRUE(station->is_connected());
  EXPECT_TRUE(drone->is_connected());
  EXPECT_TRUE(drone->send_message_async("first"));
  EXPECT_TRUE(drone->send_message_async("second"));
  EXPECT_EQ(loop.run_until_done(get(*station)), "first") << "the earliest first";
  EXPECT_EQ(loop.run_until_done(get(*station)), "second");
  auto getting = get(*drone);
  getting.start();
  EXPECT_TRUE(loop.run_until_done(station->send_message_sync("{\"Type\":\"Arm\"}")));
  EXPECT_EQ(getting.take(), "{\"Type\":\"Arm\"}") << "sync returns when the far end has it";
}

TEST_F(MessageSocketTest, SaysThatThereIsNoMessage) {
  open();
  auto const nothing = station->get_message();
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().error, SocketError::no_messages);
  EXPECT_EQ(to_string(nothing.error().error), "NoMessagesError");
}

TEST_F(MessageSocketTest, TimesOutWhenNobodyIsThere) {
  MessageSocket alone(loop, to_serve(), {.connect = 50ms, .send = 50ms});
  auto const served = loop.run_until_done(alone.init());
  ASSERT_FALSE(served);
  EXPECT_EQ(served.error().error, SocketError::connection_timeout);
  EXPECT_NE(served.error().message.find("nobody has connected"), std::string::npos) << served.error().message;

  MessageSocket caller(loop, to_connect(1), {.connect = 50ms, .send = 50ms});
  auto const connected = loop.run_until_done(caller.init());
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().error, SocketError::connection_timeout);
  EXPECT_NE(connected.error().message.find("cannot connect to 127.0.0.1:1: Connection refused"), std::string::npos)
      << connected.error().message;
  EXPECT_FALSE(caller.is_connected());
}

TEST_F(MessageSocketTest, CannotBeginOnATakenPort) {
  open();
  MessageSocket second(loop, to_serve(drone->port()), {.connect = 50ms, .send = 50ms});
  auto const begun = loop.run_until_done(second.init());
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().error, SocketError::cannot_begin);
}

TEST_F(MessageSocketTest, FailsToSendWhenNobodyTakesIt) {
  open();
  drone.reset();
  station = std::make_unique<MessageSocket>(loop, to_connect(1), MessageSocket::Times{20ms, 20ms});
  auto const before = loop.run_until_done(station->send_message_sync("text"));
  ASSERT_FALSE(before);
  EXPECT_EQ(before.error().error, SocketError::failed_to_send) << "init was not called";
  open();
  auto const port = drone->port();
  drone.reset();
  auto const sent = loop.run_until_done(station->send_message_sync("text"));
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().error, SocketError::failed_to_send);
  EXPECT_EQ(sent.error().message, "'server' has not confirmed it within 2.0 s; it is not connected");
  // It reconnects by itself, and what was kept arrives.
  drone = std::make_unique<MessageSocket>(loop, to_serve(port), MessageSocket::Times{5s, 2s});
  ASSERT_TRUE(loop.run_until_done(drone->init()));
  EXPECT_EQ(loop.run_until_done(get(*drone)), "text");
}

TEST_F(MessageSocketTest, ClosesUnderWhoeverWaits) {
  open();
  auto sending = station->send_message_sync("text");
  sending.start();
  station->close();
  EXPECT_FALSE(station->is_connected());
  EXPECT_FALSE(station->get_message());
  while (!sending.done()) loop.run_until_done(turn());
  EXPECT_FALSE(sending.take());

  MessageSocket caller(loop, to_connect(1), {.connect = 5s, .send = 50ms});
  auto waiting = caller.init();
  waiting.start();
  caller.close();
  while (!waiting.done()) loop.run_until_done(turn());
  auto const result = waiting.take();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "the socket was closed meanwhile");
}

}  // namespace
}  // namespace lapwing::link::operator_link
