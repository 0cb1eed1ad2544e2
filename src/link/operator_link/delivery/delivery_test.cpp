#include <gtest/gtest.h>

#include <fmt/format.h>

#include "link/operator_link/client.hpp"
#include "link/operator_link/server.hpp"
#include "link/operator_link/testing/memory_network.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::MemoryNetwork;
using testing::Weather;

/// A drone that serves and a station that connects, over a network in memory, in simulated time.
class Delivery : public ::testing::Test {
 public:
  void serve(Server::Options options = {}) {
    options.end.name = "drone";
    options.end.seed = ++starts;
    auto opened = Server::open(loop, network.listener(), std::move(options),
                               {.arrived = {}, .event = [this](Event event) { note("drone", event); }});
    ASSERT_TRUE(opened) << opened.error().message;
    server = *std::move(opened);
  }
  void connect(Client::Options options = {}) {
    if (options.end.name.empty()) options.end.name = "station";
    options.end.seed = 100 + ++starts;
    auto opened = Client::open(loop, network.dialler(), std::move(options),
                               {.arrived = {}, .event = [this](Event event) { note("station", event); }});
    ASSERT_TRUE(opened) << opened.error().message;
    client = *std::move(opened);
  }
  void note(std::string_view who, Event const& event) {
    events.push_back(fmt::format("{} {}: {}", who, to_string(event.kind), event.text));
  }
  [[nodiscard]] bool was_told(std::string_view of) const {
    return std::ranges::any_of(events, [&](auto const& event) { return event.starts_with(of); });
  }
  void wait(base::Duration time) { loop.run_until_done(sleep(time)); }
  base::Task<int> sleep(base::Duration time) {
    co_await loop.sleep(time);
    co_return 0;
  }
  PeerSession& at_station() const { return client->session(); }
  PeerSession& at_drone() const { return *server->find("station"); }
  using Texts = std::vector<std::string>;
  static constexpr std::size_t much_said = 200;
  /// Every other time, until much was said.
  static void say_something(PeerSession& by, Texts& said, std::mt19937_64& random) {
    if (said.size() >= much_said || random() % 2 != 0) return;
    said.push_back(fmt::format("{} {}", said.size(), std::string(random() % 300, 'x')));
    EXPECT_TRUE(by.send(durable(said.back())));
  }
  static std::vector<std::string> take_all(PeerSession& session) {
    std::vector<std::string> texts;
    while (auto message = session.take()) texts.push_back(message->text);
    return texts;
  }
  static Message durable(std::string text) { return {.kind = Kind::durable, .text = std::move(text)}; }
  static Message command(std::string text, std::string key = {}, base::Duration lifetime = {}) {
    return {.kind = Kind::command, .text = std::move(text), .key = std::move(key), .lifetime = lifetime};
  }
  static Message latest(std::string text, std::string key) {
    return {.kind = Kind::latest, .text = std::move(text), .key = std::move(key)};
  }

  base::Loop loop{{.unpaced = true}};
  MemoryNetwork network{loop, 1};
  std::vector<std::string> events;
  std::uint64_t starts = 0;
  std::unique_ptr<Server> server;
  std::unique_ptr<Client> client;
};

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
