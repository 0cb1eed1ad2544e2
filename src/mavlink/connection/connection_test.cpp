#include "mavlink/connection/connection.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "link/testing/noting_link.hpp"
#include "mavlink/connection/connection_link.hpp"
#include "mavlink/connection/inbox.hpp"
#include "mavlink/testing/fake_vehicle.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

std::ptrdiff_t count(std::vector<CommandLong> const& commands, MavCmd command) {
  return std::ranges::count(commands, command, &CommandLong::command);
}

TEST(Connection, GreetsANewPeerAndBeatsOnceASecond) {
  Bench bench;
  bench.run_for(10s);
  auto const beats = bench.vehicle->all<Heartbeat>();
  EXPECT_GE(beats.size(), 10u);
  EXPECT_LE(beats.size(), 13u);
  EXPECT_EQ(beats.front().type, MavType::gcs);
  EXPECT_EQ(beats.front().autopilot, MavAutopilot::invalid);
  EXPECT_EQ(bench.ground.counters({1, 1}).lost, 0u);
}

TEST(Connection, KnowsItsOwnPacketsWhenTheyComeBack) {
  Bench bench;
  auto mirror = bench.hub.connect();
  int reflected = 0;
  mirror->start([&](link::Peer peer, link::Bytes bytes) {
    ++reflected;
    mirror->send(peer, bytes);
  });
  int heard = 0;
  auto const subscription =
      bench.ground.subscribe(255, [&](Received const& received) { heard += received.source.component == 190; });
  FakeVehicle other_station(bench.loop, bench.hub.connect(), {255, 190});
  // Speaks, so that it is spoken to.
  auto const hello = serialize(encode(Heartbeat{.type = MavType::gcs}, {7, 1}, 0));
  mirror->send(mirror->standing_peers().front(), hello.bytes());
  bench.run_for(500ms);
  heard = 0;
  reflected = 0;
  bench.run_for(5s);
  EXPECT_GT(reflected, 3);
  EXPECT_GE(heard, 4);
  EXPECT_LE(heard, 6) << "the heartbeats of another station with the same id alone";
}

TEST(Connection, SendsToNobodyThatItNeverHeard) {
  Bench bench;
  auto const sent = bench.ground.send({7, 1}, CommandLong{});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().kind, base::ErrorKind::lost);
  EXPECT_NE(sent.error().message.find("vehicle 7"), std::string::npos);
}

TEST(Connection, FollowsAVehicleThatRebootedToItsNewAddress) {
  Bench bench;
  auto const before = bench.ground.whereabouts(1);
  bench.vehicle.reset();
  bench.vehicle = std::make_unique<FakeVehicle>(bench.loop, bench.hub.connect());
  bench.run_for(2s);
  EXPECT_NE(bench.ground.whereabouts(1), before);
  EXPECT_FALSE(bench.ground.conflict(1));
  EXPECT_TRUE(bench.ground.is_contested(1)) << "that it was no second vehicle shows later";
  ASSERT_TRUE(bench.ground.send({1, 1}, CommandLong{.command = MavCmd::mission_start}));
  bench.run_for(1s);
  EXPECT_EQ(count(bench.vehicle->all<CommandLong>(), MavCmd::mission_start), 1);
  bench.run_for(5s);
  EXPECT_FALSE(bench.ground.is_contested(1));
}

TEST(Connection, NamesBothVehiclesOfOneSystemIdAndRefusesToSend) {
  Bench bench;
  auto twin = std::make_unique<FakeVehicle>(bench.loop, bench.hub.connect());
  bench.run_for(8s);
  auto const conflict = bench.ground.conflict(1);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->first, "pipe from client 1");
  EXPECT_EQ(conflict->second, "pipe from client 2");
  auto const sent = bench.ground.send({1, 1}, CommandLong{});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().kind, base::ErrorKind::refused);
  EXPECT_NE(sent.error().message.find("client 2"), std::string::npos);

  twin.reset();
  bench.run_for(7s);
  EXPECT_FALSE(bench.ground.conflict(1)) << "one of them is gone";
  EXPECT_TRUE(bench.ground.send({1, 1}, CommandLong{}));
}

TEST(Connection, SeesNoConflictInASecondComponentOfAVehicle) {
  Bench bench;
  FakeVehicle const companion(bench.loop, bench.hub.connect(), {1, 191});
  bench.run_for(5s);
  EXPECT_FALSE(bench.ground.conflict(1));
  ASSERT_TRUE(bench.ground.send({1, 1}, CommandLong{}));
  bench.run_for(1s);
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 1u) << "the autopilot's address, not the companion's";
}

TEST(Connection, KeepsVehiclesOnOneLinkApart) {
  Bench bench;
  FakeVehicle const second(bench.loop, bench.hub.connect(), {2, 1});
  bench.run_for(2s);
  ASSERT_TRUE(bench.ground.send({2, 1}, CommandLong{}));
  bench.run_for(1s);
  EXPECT_EQ(second.all<CommandLong>().size(), 1u);
  EXPECT_TRUE(bench.vehicle->all<CommandLong>().empty());
}

TEST(Connection, CountsWhatWasLostAndDropsWhatCameTwice) {
  Bench bench({.loss = 0.2, .duplication = 0.2, .seed = 3});
  int heard = 0;
  auto const subscription = bench.ground.subscribe(
      1, [&](Received const& received) { heard += std::holds_alternative<Attitude>(received.message); });
  int constexpr sent = 2000;
  for (int i = 0; i < sent; ++i) {
    bench.vehicle->connection.send_to_all(Attitude{.since_boot = std::chrono::milliseconds(i)});
    bench.run_for(1ms);
  }
  bench.run_for(1s);
  auto const counters = bench.ground.counters({1, 1});
  EXPECT_NEAR(heard, sent * 0.8, 60);
  EXPECT_NEAR(static_cast<double>(counters.lost), sent * 0.2, 60);
  EXPECT_NEAR(static_cast<double>(counters.duplicated), sent * 0.8 * 0.2, 60);
}

TEST(Connection, FindsLateFramesOutOfOrderNotLost) {
  Bench bench({.jitter = 20ms, .seed = 3});
  for (int i = 0; i < 500; ++i) {
    bench.vehicle->connection.send_to_all(Attitude{.since_boot = std::chrono::milliseconds(i)});
    bench.run_for(10ms);
  }
  bench.run_for(1s);
  auto const counters = bench.ground.counters({1, 1});
  EXPECT_GT(counters.out_of_order, 20u);
  EXPECT_EQ(counters.lost, 0u);
}

/// A bare client that sends what it is told, byte by byte.
class Raw {
 public:
  explicit Raw(std::unique_ptr<link::ByteLink> link) : link_(std::move(link)) {
    link_->start([this](link::Peer, link::Bytes data) {
      parser_.feed(data, [this](Frame const& frame) { heard.push_back(frame); });
    });
  }
  void say(std::string_view text) { say_bytes({text.begin(), text.end()}); }
  void say(Frame const& frame) {
    auto const out = serialize(frame);
    say_bytes({out.bytes().begin(), out.bytes().end()});
  }
  std::vector<Frame> heard;

 private:
  void say_bytes(std::vector<std::uint8_t> const& bytes) { link_->send(link_->standing_peers().front(), bytes); }
  std::unique_ptr<link::ByteLink> link_;
  FrameParser parser_;
};

TEST(Connection, IsNotPutOffByBootTextsOnTheLink) {
  Bench bench;
  Raw raw(bench.hub.connect());
  raw.say("Init Gyro");
  raw.say("*");
  raw.say(encode(FakeVehicle::heartbeat(), {5, 1}, 0));
  bench.run_for(100ms);
  EXPECT_TRUE(bench.ground.whereabouts(5));
  EXPECT_GE(bench.ground.parser_counters(0).junk_bytes, 10u);
  EXPECT_FALSE(raw.heard.empty()) << "greeted, so that its texts come";
}

TEST(Connection, AnswersInVersion1WhoeverSpeaksOnlyThat) {
  Bench bench;
  Raw raw(bench.hub.connect());
  auto frame = encode(FakeVehicle::heartbeat(), {5, 1}, 0);
  frame.version = 1;
  raw.say(frame);
  bench.run_for(100ms);
  ASSERT_FALSE(raw.heard.empty());
  for (auto const& answer : raw.heard) EXPECT_EQ(answer.version, 1);
  raw.heard.clear();
  raw.say(encode(FakeVehicle::heartbeat(), {5, 1}, 1));
  bench.run_for(2s);
  ASSERT_FALSE(raw.heard.empty());
  EXPECT_EQ(raw.heard.back().version, 2);
}

TEST(Connection, OutlastsAFloodOfGarbageFromManyAddresses) {
  Bench bench;
  for (int i = 0; i < 3000; ++i) {
    Raw raw(bench.hub.connect());
    raw.say("\xFD\xFF junk that begins like a frame and goes nowhere");
    if (i % 50 == 0) bench.run_for(1ms);
  }
  bench.run_for(2s);
  EXPECT_TRUE(bench.ground.send({1, 1}, CommandLong{}));
  bench.run_for(1s);
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 1u);
}

TEST(Connection, ShowsEveryFrameToTheRecorder) {
  Bench bench;
  int received = 0;
  int sent = 0;
  bench.ground.set_frame_hook([&](Connection::Direction direction, Frame const&, base::TimePoint) {
    ++(direction == Connection::Direction::received ? received : sent);
  });
  bench.run_for(5s);
  EXPECT_GE(received, 4);
  EXPECT_GE(sent, 4);
}

TEST(ConnectionLink, ShowsWhatArrivesAndPassesOnWhatOthersSend) {
  Bench bench;
  Raw raw(bench.hub.connect());
  auto const beside = as_link(bench.ground);
  std::vector<std::vector<std::uint8_t>> seen;
  link::Peer from;
  bool drained = false;
  beside->on_drained([&] { drained = true; });
  beside->start([&](link::Peer peer, link::Bytes bytes) {
    seen.emplace_back(bytes.begin(), bytes.end());
    from = peer;
  });
  bench.run_for(3s);
  seen.clear();
  auto const beat = encode(FakeVehicle::heartbeat(), {5, 1}, 0);
  raw.say(beat);
  raw.say(beat);  // a copy
  bench.run_for(10ms);
  auto const bytes = serialize(beat);
  ASSERT_EQ(seen.size(), 1u) << "copies were dropped before";
  EXPECT_EQ(seen[0], std::vector(bytes.bytes().begin(), bytes.bytes().end()));
  EXPECT_TRUE(drained);
  EXPECT_NE(beside->peer_name(from), "");

  int recorded = 0;
  bench.ground.set_frame_hook([&](Connection::Direction direction, Frame const& frame, base::TimePoint) {
    if (direction == Connection::Direction::sent && frame.source == Address{254, 190}) ++recorded;
  });
  raw.heard.clear();
  auto const other = serialize(encode(CommandLong{}, {254, 190}, 77));
  EXPECT_TRUE(beside->send(from, other.bytes()));
  bench.run_for(10ms);
  ASSERT_EQ(raw.heard.size(), 1u);
  EXPECT_EQ(raw.heard[0].seq, 77) << "as it came";
  EXPECT_EQ(recorded, 1);
  EXPECT_FALSE(beside->send({std::uint64_t{9} << 48U}, other.bytes())) << "a link that there is not";
  EXPECT_EQ(beside->counters().send_failures, 1u);
}

TEST(ConnectionLink, PassesNothingOnThatTheSendGuardHoldsBack) {
  Bench bench;
  auto const beside = as_link(bench.ground);
  link::Peer vehicle;
  beside->start([&](link::Peer peer, link::Bytes) { vehicle = peer; });
  bench.run_for(3s);
  bench.ground.set_send_guard([](Address target, Message const& message) -> base::Result<> {
    bool const moves = std::holds_alternative<CommandLong>(message);
    if (moves && target.system == 1) return base::fail(base::ErrorKind::refused, "stopped");
    return {};
  });
  Address const other_station{254, 190};
  auto const command =
      serialize(encode(CommandLong{.target = {1, 1}, .command = MavCmd::mission_start}, other_station, 1));
  auto const question = serialize(encode(ParamRequestList{.target = {1, 1}}, other_station, 2));
  EXPECT_FALSE(beside->send(vehicle, command.bytes()));
  EXPECT_TRUE(beside->send(vehicle, question.bytes()));
  bench.run_for(1s);
  EXPECT_EQ(count(bench.vehicle->all<CommandLong>(), MavCmd::mission_start), 0);
  EXPECT_EQ(bench.vehicle->all<ParamRequestList>().size(), 1u);
}

std::vector<std::uint8_t> pack_of(std::vector<Frame> const& frames) {
  std::vector<std::uint8_t> pack;
  for (auto const& frame : frames) {
    auto const out = serialize(frame);
    pack.insert(pack.end(), out.bytes().begin(), out.bytes().end());
  }
  return pack;
}

TEST(ConnectionLink, HoldsBackOneFrameOfAPackAndPassesTheOthersOn) {
  Bench bench;
  auto const beside = as_link(bench.ground);
  link::Peer vehicle;
  beside->start([&](link::Peer peer, link::Bytes) { vehicle = peer; });
  bench.run_for(3s);
  bench.ground.set_send_guard([](Address, Message const& message) -> base::Result<> {
    if (std::holds_alternative<SetPositionTargetGlobalInt>(message))
      return base::fail(base::ErrorKind::refused, "stopped");
    return {};
  });
  std::vector<std::uint8_t> recorded;
  bench.ground.set_frame_hook([&](Connection::Direction direction, Frame const& frame, base::TimePoint) {
    if (direction == Connection::Direction::sent && frame.source == Address{254, 190}) recorded.push_back(frame.seq);
  });
  Address const other{254, 190};
  auto const pack = pack_of({
      encode(ParamRequestList{.target = {1, 1}}, other, 1),
      encode(SetPositionTargetGlobalInt{.target = {1, 1}}, other, 2),
      encode(CommandLong{.target = {1, 1}, .command = MavCmd::nav_land}, other, 3),
  });
  EXPECT_FALSE(beside->send(vehicle, pack)) << "not all of it went";
  bench.run_for(1s);
  EXPECT_EQ(count(bench.vehicle->all<CommandLong>(), MavCmd::nav_land), 1) << "a stop is not lost with its neighbour";
  EXPECT_EQ(bench.vehicle->all<ParamRequestList>().size(), 1u);
  EXPECT_EQ(bench.vehicle->all<SetPositionTargetGlobalInt>().size(), 0u);
  EXPECT_EQ(recorded, (std::vector<std::uint8_t>{1, 3})) << "each one that went, and no other";
}

TEST(ConnectionLink, LetsCommandsOvertakeWhatIsPerishableAndStopsEverything) {
  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  auto const sent = std::make_shared<std::vector<link::testing::Noted>>();
  Connection ground(loop, {.heartbeat = {}}, {});
  ground.add_link(std::make_unique<link::testing::NotingLink>(sent));
  Address const other{254, 190};
  auto const command = [&](MavCmd what, float param1 = 0.0F) {
    return encode(CommandLong{.target = {1, 1}, .command = what, .params = {param1}}, other, 0);
  };
  Frame corrections = encode(Heartbeat{}, other, 0);
  corrections.message_id = 233;
  std::vector<Frame> const frames{corrections,
                                  command(MavCmd::component_arm_disarm, 1.0F),
                                  encode(ParamRequestList{.target = {1, 1}}, other, 0),
                                  command(MavCmd::component_arm_disarm, 0.0F),
                                  command(MavCmd::nav_land),
                                  encode(SetMode{1, 1, 9}, other, 0)};
  EXPECT_TRUE(ground.pass_on({0, {}}, pack_of(frames)));
  std::vector<link::Urgency> how;
  for (auto const& one : *sent) how.push_back(one.urgency);
  using enum link::Urgency;
  EXPECT_EQ(how, (std::vector{perishable, prompt, prompt, urgent, urgent, urgent}));
}

TEST(Connection, TellsALineThatIsFullFromOneThatIsNotConnected) {
  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  auto link = std::make_unique<link::testing::NotingLink>(std::make_shared<std::vector<link::testing::Noted>>());
  auto& line = *link;
  Connection ground(loop, {.heartbeat = {}}, {});
  ground.add_link(std::move(link));
  line.hear(serialize(encode(FakeVehicle::heartbeat(), {1, 1}, 0)).bytes());
  EXPECT_TRUE(ground.send({1, 1}, CommandLong{}));
  line.fill();
  auto const sent = ground.send({1, 1}, CommandLong{});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().message, "vehicle 1 cannot be reached over noting: more waits for it than it carries");
}

TEST(Connection, ForgetsSourcesThatAFloodMadeUp) {
  Bench bench;
  Raw raw(bench.hub.connect());
  for (int i = 0; i < 6000; ++i) {
    Address const made_up{static_cast<std::uint8_t>(2 + i % 200), static_cast<std::uint8_t>(2 + i / 200)};
    raw.say(encode(FakeVehicle::heartbeat(), made_up, 0));
    if (i % 50 == 0) bench.run_for(10ms);
  }
  bench.run_for(1s);
  auto const report = bench.ground.report();
  EXPECT_LE(report[0].sources.size(), 2048u);
  EXPECT_GE(report[0].counters.received, 6000u) << "what they sent stays counted";
  EXPECT_TRUE(bench.ground.send({1, 1}, CommandLong{.command = MavCmd::mission_start}));
  bench.run_for(1s);
  EXPECT_EQ(count(bench.vehicle->all<CommandLong>(), MavCmd::mission_start), 1) << "who speaks on is not forgotten";
}

TEST(Subscription, EndsWhenDestroyedEvenFromWithinItsCall) {
  Bench bench;
  int calls = 0;
  Subscription subscription;
  subscription = bench.ground.subscribe([&](Received const&) {
    ++calls;
    subscription = {};
  });
  bench.run_for(5s);
  EXPECT_EQ(calls, 1);
}

TEST(Subscription, HearsInTheOrderInWhichItBeganWhetherOfOneSystemOrOfAll) {
  Bench bench;
  std::string order;
  auto const first = bench.ground.subscribe(1, [&](Received const&) { order += 'a'; });
  auto const second = bench.ground.subscribe([&](Received const&) { order += 'b'; });
  auto const third = bench.ground.subscribe(1, [&](Received const&) { order += 'c'; });
  auto const another = bench.ground.subscribe(2, [&](Received const&) { order += 'x'; });
  bench.run_for(5s);
  ASSERT_GE(order.size(), 3u);
  EXPECT_EQ(order.substr(0, 3), "abc");
  EXPECT_EQ(order.find('x'), std::string::npos);
}

TEST(Subscription, HearsTheMessageDuringWhichItBegan) {
  Bench bench;
  std::optional<Subscription> late;
  int by_first = 0;
  int by_late = 0;
  auto const first = bench.ground.subscribe(1, [&](Received const&) {
    ++by_first;
    if (!late) late = bench.ground.subscribe([&](Received const& received) { by_late += received.source.system == 1; });
  });
  bench.run_for(5s);
  EXPECT_GT(by_first, 0);
  EXPECT_EQ(by_late, by_first);
}

TEST(AwaitMessage, ReturnsTheFirstThatFitsOrTimesOut) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (std::holds_alternative<Heartbeat>(message)) bench.vehicle->answer(MissionCurrent{.seq = 3});
  };
  std::function<bool(MissionCurrent const&)> const third = [](MissionCurrent const& m) { return m.seq == 3; };
  auto const got = bench.loop.run_until_done(await_message<MissionCurrent>(bench.ground, {1, 0}, third, 5s));
  ASSERT_TRUE(got);
  std::function<bool(MissionCurrent const&)> const fourth = [](MissionCurrent const& m) { return m.seq == 4; };
  auto const none = bench.loop.run_until_done(await_message<MissionCurrent>(bench.ground, {1, 0}, fourth, 5s));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, base::ErrorKind::timed_out);
}

}  // namespace
}  // namespace lapwing::mavlink
