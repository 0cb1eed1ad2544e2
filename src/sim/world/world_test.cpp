#include "sim/world/world.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "mavlink/exchange/mission_transfer.hpp"
#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

base::Task<void> pass(base::Loop& loop, base::Duration duration) {
  co_await loop.sleep(duration);
}

std::uint32_t port_of(link::ByteLink const& link) {
  auto const name = link.name();
  return static_cast<std::uint32_t>(std::stoul(name.substr(name.rfind(':') + 1)));
}

/// Real time, faster: sockets need the wall's time, not simulated jumps.
base::Loop::Pace constexpr quick_pace{.speedup = 20.0};

TEST(World, VehiclesSpeakUdpFromPortsOfTheirOwn) {
  base::Loop loop(quick_pace);
  auto listening = link::open(loop, link::Url{link::Transport::udp_in, "127.0.0.1", 0});
  ASSERT_TRUE(listening);
  WorldOptions options;
  options.vehicles = parse_vehicles("copter:2,rover:1").value();
  options.out.port_or_baud = port_of(**listening);
  Connection station(loop, {}, base::Logger());
  station.add_link(std::move(*listening));
  std::map<int, std::set<link::Peer>> peers;
  std::map<int, MavResult> answers;
  auto const subscription = station.subscribe([&](Received const& received) {
    peers[received.source.system].insert(received.from.peer);
    if (auto const* ack = std::get_if<CommandAck>(&received.message)) answers[received.source.system] = ack->result;
  });
  World world(loop, options, base::Logger());
  ASSERT_TRUE(world.start());
  loop.run_until_done(pass(loop, 4s));
  for (std::uint8_t id = 1; id <= 3; ++id) {
    (void)station.send({id, 1}, CommandLong{.target = {}, .command = MavCmd::component_arm_disarm, .params = {1}});
  }
  loop.run_until_done(pass(loop, 2s));
  ASSERT_EQ(peers.size(), 3u);
  std::set<link::Peer> ports;
  for (auto const& [id, of_one] : peers) {
    EXPECT_EQ(of_one.size(), 1u);
    ports.insert(of_one.begin(), of_one.end());
    EXPECT_EQ(answers[id], MavResult::accepted);
  }
  EXPECT_EQ(ports.size(), 3u);
}

TEST(World, VehiclesNeedNobodyThatListens) {
  base::Loop loop(quick_pace);
  WorldOptions options;
  {
    auto const free_port = link::open(loop, link::Url{link::Transport::udp_in, "127.0.0.1", 0});
    ASSERT_TRUE(free_port);
    options.out.port_or_baud = port_of(**free_port);
  }
  World world(loop, options, base::Logger());
  ASSERT_TRUE(world.start());
  loop.run_until_done(pass(loop, 4s));
  auto listening = link::open(loop, link::Url{link::Transport::udp_in, "127.0.0.1", options.out.port_or_baud});
  ASSERT_TRUE(listening);
  Connection station(loop, {}, base::Logger());
  station.add_link(std::move(*listening));
  int heartbeats = 0;
  auto const subscription = station.subscribe(1, [&](Received const&) { ++heartbeats; });
  loop.run_until_done(pass(loop, 3s));
  EXPECT_GE(heartbeats, 2);
}

TEST(World, AnUploadSurvivesThirtyPercentLossAndDelay) {
  WorldOptions options;
  options.impairment = {.loss = 0.3, .duplication = 0.1, .delay = 200ms, .jitter = 50ms};
  TestGround ground("copter", options);
  ground.run_for(6s);
  auto const make = ground.maker();
  std::vector<MissionItem> items;
  for (int i = 0; i < 20; ++i) items.push_back(make.waypoint(10.0 * i, 0, 20));
  Address const vehicle{1, 1};
  TransferOptions const patience{.tries = 12, .restarts = 10};
  auto const uploaded =
      ground.loop.run_until_done(upload_mission(ground.gcs, vehicle, items, MissionType::mission, patience));
  EXPECT_TRUE(uploaded.has_value()) << (uploaded ? "" : uploaded.error().message);
  EXPECT_EQ(ground.vehicle().mission().size(), 20u);
}

// A vehicle that gave the upload up refuses every late item; taken for signs of life, its refusals once kept an upload
// going for 15 hours.
TEST(World, AnUploadOverALinkThatLosesHalfComesToAnEnd) {
  WorldOptions options;
  options.seed = 4;
  options.impairment = {.loss = 0.5};
  TestGround ground("copter", options);
  ground.run_for(6s);
  auto const make = ground.maker();
  std::vector<MissionItem> items;
  for (int i = 0; i < 500; ++i) items.push_back(make.waypoint(10.0 * (i % 50), 0, 20));
  auto const began = ground.loop.now();
  auto const uploaded =
      ground.loop.run_until_done(upload_mission(ground.gcs, {1, 1}, items, MissionType::mission, {.restarts = 3}));
  EXPECT_TRUE(uploaded.has_value()) << (uploaded ? "" : uploaded.error().message);
  EXPECT_LT(ground.loop.now() - began, 20min);
}

TEST(World, ParksVehiclesApartAndNumbersThem) {
  TestGround ground("copter:11,rover:2");
  ground.boot();
  std::set<std::pair<double, double>> places;
  for (auto const& vehicle : ground.world.vehicles()) {
    auto const& start = vehicle->options().start;
    places.insert({start.north, start.east});
  }
  EXPECT_EQ(places.size(), 13u);
  EXPECT_EQ(ground.last<Heartbeat>(13)->type, MavType::ground_rover);
  EXPECT_EQ(ground.world.find(14), nullptr);
}

TEST(World, Holds250VehiclesThatAllReportTenTimesASecond) {
  WorldOptions options;
  for (auto const* stream : {"SR0_EXT_STAT", "SR0_POSITION", "SR0_EXTRA1", "SR0_EXTRA2", "SR0_EXTRA3"})
    options.parameters.push_back({stream, 10.0F});
  TestGround ground("copter:200,px4:25,rover:25", std::move(options));
  ground.run_for(1s);
  auto const from = ground.heard.size();
  ground.run_for(2s);
  std::vector<int> attitudes(256);
  for (auto i = from; i < ground.heard.size(); ++i) {
    if (std::holds_alternative<Attitude>(ground.heard[i].message)) ++attitudes[ground.heard[i].system];
  }
  for (int system = 1; system <= 250; ++system) {
    bool const is_px4 = system > 200 && system <= 225;  // which sends 15 unasked
    EXPECT_NEAR(attitudes[static_cast<std::size_t>(system)], is_px4 ? 30 : 20, 2) << system;
  }
}

TEST(World, RefusesSystemIdsThatDoNotExist) {
  base::Loop loop(quick_pace);
  WorldOptions options;
  options.vehicles = parse_vehicles("copter:10").value();
  options.first_system_id = 250;
  World world(loop, options, base::Logger());
  auto const started = world.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().kind, base::ErrorKind::invalid_input);
}

TEST(World, RefusesAParameterThatNoVehicleHas) {
  base::Loop loop(quick_pace);
  WorldOptions options;
  options.parameters = {{"SR0_POSITON", 10}};
  World world(loop, options, base::Logger());
  auto const started = world.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().message, "no simulated vehicle has a parameter SR0_POSITON");
  EXPECT_NE(started.error().hint.find("SR0_POSITION"), std::string::npos);
}

TEST(ParameterSetting, IsANameAndANumber) {
  auto const parameter = parse_parameter("WPNAV_SPEED=750.5");
  ASSERT_TRUE(parameter);
  EXPECT_EQ(parameter->name, "WPNAV_SPEED");
  EXPECT_FLOAT_EQ(parameter->value, 750.5F);
  for (auto const* wrong : {"", "WPNAV_SPEED", "=1", "WPNAV_SPEED=", "WPNAV_SPEED=fast", "WPNAV_SPEED=1x", "A=nan"}) {
    EXPECT_FALSE(parse_parameter(wrong)) << wrong;
  }
}

TEST(World, TellsWhyALinkCannotBeOpened) {
  base::Loop loop(quick_pace);
  World world(
      loop, {},
      [] { return base::Result<std::unique_ptr<link::ByteLink>>(base::fail(base::ErrorKind::io, "no such network")); },
      base::Logger());
  auto const started = world.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().message, "no such network");
}

}  // namespace
}  // namespace lapwing::sim
