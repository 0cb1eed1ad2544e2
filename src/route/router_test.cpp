#include "route/router.hpp"

#include <array>

#include <gtest/gtest.h>

#include "link/pipe_link.hpp"
#include "link/testing/noting_link.hpp"
#include "route/metrics.hpp"
#include "route/test_packets.hpp"

namespace lapwing::route {
namespace {

using namespace std::chrono_literals;

/// A program or vehicle at the far end of a router's endpoint.
class Station {
 public:
  explicit Station(std::unique_ptr<link::ByteLink> link) : link_(std::move(link)) {
    link_->start([this](link::Peer, link::Bytes bytes) { heard_.emplace_back(bytes.begin(), bytes.end()); });
  }
  void say(Packet const& packet) { say(packet.bytes); }
  void say(Bytes const& bytes) { link_->send(link_->standing_peers().front(), bytes); }
  std::vector<Bytes> take() { return std::exchange(heard_, {}); }

 private:
  std::unique_ptr<link::ByteLink> link_;
  std::vector<Bytes> heard_;
};

base::Task<> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

struct RouterTest : ::testing::Test {
  /// An endpoint for many, as udp in.
  link::PipeHub& add_hub(EndpointOptions options = {}) {
    if (options.name.empty()) options.name = next_name();
    auto& hub = *hubs.emplace_back(std::make_unique<link::PipeHub>(loop));
    router.add(std::move(options), hub.take_server());
    return hub;
  }
  Station& join(link::PipeHub& hub) { return *stations.emplace_back(std::make_unique<Station>(hub.connect())); }
  std::string next_name() { return std::string(1, static_cast<char>('a' + router.status().size())); }
  void settle(base::Duration time = 1ms) { loop.run_until_done(pass(loop, time)); }
  EndpointCounters counters(std::size_t endpoint) { return router.status()[endpoint].counters; }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  std::vector<std::unique_ptr<link::PipeHub>> hubs;
  std::vector<std::unique_ptr<Station>> stations;
  Router router{loop, {}, {}};
};

using Packets = std::vector<Bytes>;

TEST_F(RouterTest, PassesWhatIsForAllToAllOthersAsItCame) {
  auto& hub = add_hub();
  auto& vehicle = join(hub);
  auto& left = add_hub();
  auto& ground = join(left);
  auto& other = join(add_hub());
  // Far ends of such links are known once they spoke.
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  other.say(packet("HEARTBEAT", {.source = {254, 190}}));
  settle();
  ground.take();
  for (auto const& sent : {packet("HEARTBEAT"), packet("ATTITUDE", {.seq = 1}), unknown_packet(70'000),
                           packet("HEARTBEAT", {.seq = 3, .version = 1})}) {
    vehicle.say(sent);
    settle();
    EXPECT_EQ(ground.take(), Packets{sent.bytes});
    EXPECT_EQ(other.take(), Packets{sent.bytes});
    EXPECT_EQ(vehicle.take(), Packets{}) << "never back where it came from";
  }
}

TEST_F(RouterTest, PassesSignedPacketsByteForByte) {
  auto& vehicle = join(add_hub());
  auto& ground = join(add_hub());
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  // Packed and signed by pymavlink: a ground station's HEARTBEAT.
  Bytes const signed_heartbeat = {0xFD, 0x09, 0x01, 0x00, 0xC8, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00, 0x00,
                                  0x00, 0x00, 0x06, 0x08, 0x00, 0x04, 0x03, 0x09, 0x52, 0x03, 0x87, 0xD6,
                                  0x12, 0x00, 0x00, 0x00, 0xB2, 0x35, 0xC3, 0x13, 0x06, 0xAC};
  vehicle.say(signed_heartbeat);
  settle();
  EXPECT_EQ(ground.take(), Packets{signed_heartbeat});
}

TEST_F(RouterTest, SendsWhatIsForOneOnlyThere) {
  auto& one = join(add_hub());
  auto& two = join(add_hub());
  auto& ground = join(add_hub());
  one.say(packet("HEARTBEAT", {.source = {1, 1}}));
  two.say(packet("HEARTBEAT", {.source = {2, 1}}));
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  for (auto& station : stations) station->take();

  auto const command = packet("COMMAND_LONG", {.source = {255, 190}, .target = {2, 1}});
  ground.say(command);
  settle();
  EXPECT_EQ(one.take(), Packets{});
  EXPECT_EQ(two.take(), Packets{command.bytes});
  auto const answer = packet("COMMAND_ACK", {.source = {2, 1}, .target = {255, 190}});
  two.say(answer);
  settle();
  EXPECT_EQ(ground.take(), Packets{answer.bytes});
  EXPECT_EQ(one.take(), Packets{});

  ground.say(packet("COMMAND_LONG", {.source = {255, 190}, .target = {2, 100}, .seq = 1}));
  ground.say(packet("COMMAND_LONG", {.source = {255, 190}, .target = {9, 1}, .seq = 2}));
  settle();
  EXPECT_EQ(two.take(), Packets{}) << "a component that was never heard";
  EXPECT_EQ(counters(2).in.unroutable, 2u);
}

TEST_F(RouterTest, KeepsMembersOfOneEndpointApartUnlessTheyAreToHearEachOther) {
  auto& apart = add_hub();
  auto& one = join(apart);
  auto& two = join(apart);
  auto& together = add_hub({.name = "together", .between_members = true});
  auto& three = join(together);
  auto& four = join(together);
  std::uint8_t system = 1;
  for (auto* station : {&one, &two, &three, &four}) {
    station->say(packet("HEARTBEAT", {.source = {system++, 1}}));
    settle();
  }
  for (auto& station : stations) station->take();
  auto const by_one = packet("ATTITUDE", {.source = {1, 1}, .seq = 1});
  one.say(by_one);
  auto const by_three = packet("ATTITUDE", {.source = {3, 1}, .seq = 1});
  three.say(by_three);
  settle();
  EXPECT_EQ(two.take(), Packets{by_three.bytes});
  EXPECT_EQ(four.take(), (Packets{by_one.bytes, by_three.bytes}));
  auto const to_two = packet("COMMAND_LONG", {.source = {1, 1}, .target = {2, 1}, .seq = 2});
  one.say(to_two);
  settle();
  EXPECT_EQ(two.take(), Packets{to_two.bytes}) << "what is for one of them reaches it";
}

TEST_F(RouterTest, DropsCopiesThatComeOverASecondLink) {
  auto& radio = join(add_hub());
  auto& wifi = join(add_hub());
  auto& ground = join(add_hub());
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  for (std::uint8_t seq = 0; seq < 10; ++seq) {
    wifi.say(packet("ATTITUDE", {.seq = seq}));
    settle(5ms);
    radio.say(packet("ATTITUDE", {.seq = seq}));
    settle();
  }
  EXPECT_EQ(ground.take().size(), 10u);
  EXPECT_EQ(counters(0).in.duplicates, 10u);
}

TEST_F(RouterTest, EndsALoopBetweenTwoRouters) {
  Router second(loop, {}, {});
  for (int i = 0; i < 2; ++i) {  // joined twice
    auto pipe = link::make_pipe(loop);
    router.add({.name = "to second " + std::to_string(i)}, std::move(pipe.b));
    second.add({.name = "to first " + std::to_string(i)}, std::move(pipe.a));
  }
  auto& vehicle = join(add_hub());
  link::PipeHub hub(loop);
  second.add({.name = "ground"}, hub.take_server());
  Station ground(hub.connect());
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  vehicle.say(packet("HEARTBEAT"));
  settle(1s);
  EXPECT_EQ(ground.take(), Packets{packet("HEARTBEAT").bytes});
  EXPECT_LE(counters(0).in.frames + counters(1).in.frames, 4u) << "the copies died out";
}

TEST_F(RouterTest, FiltersBothWays) {
  EndpointOptions options{.name = "filtered"};
  options.in.block_message(30);
  options.out.allow_message(0);
  auto& station = join(add_hub(std::move(options)));
  auto& other = join(add_hub());
  station.say(packet("HEARTBEAT"));
  other.say(packet("HEARTBEAT", {.source = {2, 1}}));
  settle();
  EXPECT_EQ(station.take().size(), 1u);
  EXPECT_EQ(other.take().size(), 0u) << "it was not known yet";
  station.say(packet("ATTITUDE", {.seq = 1}));
  other.say(packet("ATTITUDE", {.source = {2, 1}, .seq = 1}));
  settle();
  EXPECT_EQ(station.take(), Packets{});
  EXPECT_EQ(other.take(), Packets{});
  EXPECT_EQ(counters(0).in.filtered, 1u);
  EXPECT_EQ(counters(0).out.filtered, 1u);
}

TEST_F(RouterTest, ShowsASnifferEverythingAndHearsItNot) {
  auto& one = join(add_hub());
  auto& two = join(add_hub());
  auto& sniffer = join(add_hub({.name = "sniffer", .is_sniffer = true}));
  sniffer.say(packet("HEARTBEAT", {.source = {250, 1}}));
  one.say(packet("HEARTBEAT", {.source = {1, 1}}));
  settle();
  two.say(packet("HEARTBEAT", {.source = {2, 1}}));
  settle();
  EXPECT_EQ(sniffer.take().size(), 2u);
  one.take();
  two.take();
  one.say(packet("COMMAND_LONG", {.source = {1, 1}, .target = {2, 1}, .seq = 1}));
  one.say(packet("COMMAND_LONG", {.source = {1, 1}, .target = {9, 1}, .seq = 2}));
  sniffer.say(packet("COMMAND_LONG", {.source = {250, 1}, .target = {2, 1}, .seq = 1}));
  settle();
  EXPECT_EQ(sniffer.take().size(), 2u) << "even what nobody else can be given";
  EXPECT_EQ(two.take().size(), 1u);
  EXPECT_EQ(counters(2).in.read_only, 2u);
}

TEST_F(RouterTest, ShowsAKeyToNobodyButItsAddressee) {
  auto& vehicle = join(add_hub());
  auto& other = join(add_hub());
  auto& sniffer = join(add_hub({.name = "sniffer", .is_sniffer = true}));
  auto& ground = join(add_hub());
  vehicle.say(packet("HEARTBEAT", {.source = {1, 1}}));
  other.say(packet("HEARTBEAT", {.source = {2, 1}}));
  sniffer.say(packet("HEARTBEAT", {.source = {250, 1}}));
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  for (auto& station : stations) station->take();
  auto const setup = packet("SETUP_SIGNING", {.source = {255, 190}, .target = {1, 1}, .seq = 1});
  ground.say(setup);
  ground.say(packet("SETUP_SIGNING", {.source = {255, 190}, .target = {0, 0}, .seq = 2}));
  settle();
  EXPECT_EQ(vehicle.take(), Packets{setup.bytes});
  EXPECT_EQ(other.take(), Packets{});
  EXPECT_EQ(sniffer.take(), Packets{});
  EXPECT_EQ(counters(3).in.unroutable, 1u) << "a key for everybody";
}

TEST_F(RouterTest, HearsNothingFromAReadOnlyEndpoint) {
  auto& vehicle = join(add_hub());
  auto& viewer = join(add_hub({.name = "viewer", .is_read_only = true}));
  viewer.say(packet("HEARTBEAT", {.source = {255, 190}}));
  vehicle.say(packet("HEARTBEAT"));
  settle();
  viewer.say(packet("COMMAND_LONG", {.source = {255, 190}, .target = {1, 1}, .seq = 1}));
  settle();
  EXPECT_EQ(vehicle.take(), Packets{});
  EXPECT_EQ(viewer.take(), Packets{packet("HEARTBEAT").bytes});
  EXPECT_EQ(counters(1).in.read_only, 2u);
}

TEST_F(RouterTest, HoldsTheRateOfAnEndpointWithTheNewestValues) {
  auto& vehicle = join(add_hub());
  auto& radio = join(add_hub({.name = "radio", .limits = {.all = {.messages_per_s = 10.0}}}));
  radio.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  std::uint8_t seq = 0;
  for (int i = 0; i < 1000; ++i) {
    vehicle.say(packet("ATTITUDE", {.seq = seq++, .fields = {{"time_boot_ms", std::int64_t{i}}}}));
    settle(10ms);
  }
  auto const heard = radio.take();
  EXPECT_NEAR(static_cast<double>(heard.size()), 100.0, 2.0);
  mavlink::FrameParser parser;
  std::uint32_t newest = 0;
  for (auto const& bytes : heard)
    parser.feed(bytes, [&](mavlink::Frame const& f) { newest = f.payload[0] | f.payload[1] << 8U; });
  EXPECT_GE(newest, 980u) << "no old value waits";
  auto const out = counters(1).out;
  EXPECT_EQ(out.frames + out.superseded + router.status()[1].waiting, 1000u) << "every frame is accounted for";
}

TEST_F(RouterTest, ReleasesWhatWaitsThoughNothingElseHappens) {
  auto& vehicle = join(add_hub());
  auto& slow = join(add_hub({.name = "slow", .limits = {.all = {.messages_per_s = 0.1}}}));
  auto& fast = join(add_hub({.name = "fast", .limits = {.all = {.messages_per_s = 10.0}}}));
  slow.say(packet("HEARTBEAT", {.source = {255, 190}}));
  fast.say(packet("HEARTBEAT", {.source = {254, 190}}));
  settle();
  slow.take();
  for (std::uint8_t seq = 0; seq < 3; ++seq)
    vehicle.say(packet("STATUSTEXT", {.seq = seq, .fields = {{"text", std::string("abc")}}}));
  settle(250ms);
  EXPECT_EQ(fast.take().size(), 3u);
  EXPECT_LE(slow.take().size(), 1u);
  settle(30s);
  EXPECT_GE(slow.take().size(), 2u);
}

TEST_F(RouterTest, PacksFramesThatAreReadyTogetherIntoADatagramUnlessToldNotTo) {
  auto& vehicle = join(add_hub());
  auto& ground = join(add_hub({.name = "ground"}));
  auto& one_by_one = join(add_hub({.name = "one by one", .coalesces = false}));
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  one_by_one.say(packet("HEARTBEAT", {.source = {254, 190}}));
  settle();
  Bytes together;
  for (std::uint8_t seq = 0; seq < 5; ++seq) {
    auto const one = packet("ATTITUDE", {.seq = seq}).bytes;
    together.insert(together.end(), one.begin(), one.end());
  }
  settle();
  ground.take();
  one_by_one.take();
  vehicle.say(together);
  settle();
  EXPECT_EQ(ground.take(), Packets{together});
  EXPECT_EQ(one_by_one.take().size(), 5u);
  EXPECT_EQ(counters(2).out.frames, 5u);
}

TEST_F(RouterTest, TellsAStreamWhatMayBeDroppedWhereItIsSlow) {
  using link::Urgency;
  auto& vehicle = join(add_hub());
  auto const stream = std::make_shared<std::vector<link::testing::Noted>>();
  auto const datagrams = std::make_shared<std::vector<link::testing::Noted>>();
  router.add({.name = "tcp", .url = link::parse_url("tcpin://127.0.0.1:5760").value()},
             std::make_unique<link::testing::NotingLink>(stream));
  router.add({.name = "udp"}, std::make_unique<link::testing::NotingLink>(datagrams));
  Bytes all;
  std::uint8_t seq = 0;
  for (auto const* name : {"ATTITUDE", "VFR_HUD", "STATUSTEXT", "PARAM_VALUE", "LOG_DATA", "ATTITUDE"}) {
    auto const one = packet(name, {.seq = seq++}).bytes;
    all.insert(all.end(), one.begin(), one.end());
  }
  vehicle.say(all);
  settle();
  std::vector<Urgency> how;
  Bytes joined;
  for (auto const& chunk : *stream) {
    how.push_back(chunk.urgency);
    joined.insert(joined.end(), chunk.bytes.begin(), chunk.bytes.end());
  }
  EXPECT_EQ(how, (std::vector{Urgency::perishable, Urgency::batched, Urgency::perishable}));
  EXPECT_EQ(joined, all) << "in order";
  EXPECT_EQ(counters(1).out.frames, 6u);
  ASSERT_EQ(datagrams->size(), 1u);
  EXPECT_EQ(datagrams->front().bytes, all);
  EXPECT_EQ(datagrams->front().urgency, Urgency::batched);
}

TEST_F(RouterTest, DropsACommandThatWaitedTooLongForItsRate) {
  auto& ground = join(add_hub());
  auto& vehicle = join(add_hub({.name = "slow", .limits = {.all = {.messages_per_s = 0.1}}}));
  vehicle.say(packet("HEARTBEAT"));
  settle();
  for (std::uint8_t seq = 0; seq < 5; ++seq)
    ground.say(packet("COMMAND_LONG", {.source = {255, 190}, .target = {1, 1}, .seq = seq}));
  settle(60s);
  EXPECT_EQ(vehicle.take().size(), 1u) << "what went at once";
  EXPECT_EQ(counters(1).out.expired, 4u);
  EXPECT_EQ(router.status()[1].waiting, 0u);
}

TEST_F(RouterTest, CountsJunkAndMakesNoFarEndOfIt) {
  auto& stranger = join(add_hub());
  stranger.say(Bytes(100, 0x55));
  settle();
  EXPECT_EQ(router.status()[0].far_ends, 0u);
  EXPECT_EQ(router.status()[0].parser.junk_bytes, 100u);
  auto damaged = packet("ATTITUDE");
  stranger.say(packet("HEARTBEAT"));
  damaged.bytes.back() ^= 0xFFU;
  stranger.say(damaged);
  settle();
  EXPECT_EQ(router.status()[0].far_ends, 1u);
  EXPECT_EQ(router.status()[0].parser.crc_errors, 1u);
}

TEST_F(RouterTest, LetsFarEndsComeAndGo) {
  auto& hub = add_hub();
  auto& vehicle = join(hub);
  auto& ground = join(add_hub());
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  vehicle.say(packet("HEARTBEAT"));
  settle(50s);
  ground.say(packet("HEARTBEAT", {.source = {255, 190}, .seq = 1}));
  settle(20s);
  EXPECT_EQ(router.status()[0].far_ends, 0u) << "silent for a minute";
  EXPECT_EQ(router.status()[1].far_ends, 1u);
  ground.say(packet("COMMAND_LONG", {.source = {255, 190}, .target = {1, 1}, .seq = 2}));
  settle();
  EXPECT_EQ(counters(1).in.unroutable, 1u);
  auto& again = join(hub);
  again.say(packet("HEARTBEAT", {.seq = 5}));
  settle();
  auto const command = packet("COMMAND_LONG", {.source = {255, 190}, .target = {1, 1}, .seq = 3});
  ground.say(command);
  settle();
  EXPECT_EQ(again.take(), Packets{command.bytes});
}

TEST_F(RouterTest, BoundsTheFarEndsOfAnEndpoint) {
  Router small(loop, {.max_far_ends = 2}, {});
  link::PipeHub hub(loop);
  small.add({.name = "hub"}, hub.take_server());
  std::vector<std::unique_ptr<Station>> many;
  for (std::uint8_t system = 1; system <= 3; ++system) {
    many.push_back(std::make_unique<Station>(hub.connect()));
    many.back()->say(packet("HEARTBEAT", {.source = {system, 1}}));
    settle(1s);
  }
  EXPECT_EQ(small.status()[0].far_ends, 2u);
  EXPECT_EQ(small.systems(), 2u) << "the first, silent for longest, made room";
}

TEST_F(RouterTest, OpensAllEndpointsOrNone) {
  auto const url = link::parse_url("udpin://127.0.0.1:0").value();
  Router first(loop, {}, {});
  ASSERT_TRUE(first.open({{.name = "one", .url = url}}));
  auto const taken = link::parse_url(first.status()[0].url).value();
  Router second(loop, {}, {});
  auto const opened = second.open({{.name = "free", .url = url}, {.name = "taken", .url = taken}});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, base::ErrorKind::io);
  EXPECT_TRUE(second.status().empty());
}

TEST_F(RouterTest, WritesItsMetrics) {
  auto& vehicle = join(add_hub());
  auto& ground = join(add_hub({.name = "ground \"1\""}));
  ground.say(packet("HEARTBEAT", {.source = {255, 190}}));
  settle();
  vehicle.say(packet("HEARTBEAT"));
  vehicle.say(packet("COMMAND_LONG", {.source = {1, 1}, .target = {9, 1}, .seq = 1}));
  settle();
  base::OpenMetrics metrics;
  write_metrics(std::array<Router const*, 1>{&router}, metrics);
  auto const text = metrics.text();
  for (auto const* line :
       {"lapwing_router_frames_total{endpoint=\"a\",direction=\"in\"} 2\n",
        "lapwing_router_frames_total{endpoint=\"ground \\\"1\\\"\",direction=\"out\"} 1\n",
        "lapwing_router_dropped_frames_total{endpoint=\"a\",direction=\"in\",reason=\"unroutable\"} 1\n",
        "lapwing_router_receive_overruns_total{endpoint=\"a\"} 0\n", "lapwing_router_far_ends{endpoint=\"a\"} 1\n",
        "lapwing_router_systems 2\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

}  // namespace
}  // namespace lapwing::route
