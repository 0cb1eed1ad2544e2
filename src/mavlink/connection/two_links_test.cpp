// One vehicle heard on several links, and two vehicles that use one system id.
#include <algorithm>

#include <gtest/gtest.h>

#include "mavlink/connection/connection.hpp"
#include "mavlink/path/same_vehicle.hpp"
#include "mavlink/testing/fake_vehicle.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

/// An autopilot as it speaks on one of its links: a sequence of the link's own, its clock and what it is asked for.
/// Copies of one `Body` on several links are one vehicle.
struct Body {
  Duration boot{};  ///< its clock minus the loop's
  std::uint64_t hardware = 0;
  geo::Wgs84 place = geo::Wgs84::from_degrees(41.178, -8.598, 100.0);
  bool answers = true;
};

class Voice {
 public:
  Voice(base::Loop& loop, std::unique_ptr<link::ByteLink> link, Body body, std::uint8_t first_seq)
      : loop_(loop), body_(body), link_(std::move(link)), seq_(first_seq), scope_(loop) {
    link_->start(
        [this](link::Peer, link::Bytes bytes) { parser_.feed(bytes, [this](Frame const& frame) { take(frame); }); });
    scope_.spawn(beat());
  }

  void say(Message const& message) { pass_on(encode(message, {1, autopilot_component}, seq_++)); }
  /// A packet that another voice made, as a router copies it.
  void pass_on(Frame const& frame) {
    if (is_silent) return;
    auto const out = serialize(frame);
    link_->send(link_->standing_peers().front(), out.bytes());
  }
  [[nodiscard]] Frame frame_of(Message const& message) { return encode(message, {1, autopilot_component}, seq_++); }
  [[nodiscard]] Duration clock() const { return loop_.now().time_since_epoch() + body_.boot; }
  [[nodiscard]] int heard(MavCmd command) const { return static_cast<int>(std::ranges::count(commands, command)); }

  bool is_silent = false;
  std::vector<MavCmd> commands;
  std::vector<Timesync> clocks_told;
  int parameters_asked = 0;

 private:
  base::Task<void> beat() {
    for (;;) {
      say(FakeVehicle::heartbeat());
      co_await loop_.sleep(1s);
    }
  }
  void take(Frame const& frame) {
    auto const message = decode(frame);
    if (!message || is_silent) return;
    if (std::get_if<ParamRequestList>(&*message)) ++parameters_asked;
    if (auto const* sync = std::get_if<Timesync>(&*message)) {
      if (sync->tc1 != Duration{})
        clocks_told.push_back(*sync);
      else if (body_.answers)
        say(Timesync{.tc1 = clock(), .ts1 = sync->ts1});
    }
    auto const* command = std::get_if<CommandLong>(&*message);
    if (!command) return;
    commands.push_back(command->command);
    if (command->command != MavCmd::request_message || !body_.answers) return;
    auto const wanted = static_cast<MessageId>(command->params[0]);
    if (wanted == MessageId::autopilot_version) say(AutopilotVersion{.uid = body_.hardware});
    if (wanted == MessageId::global_position_int) say(GlobalPosition{.since_boot = clock(), .position = body_.place});
  }

  base::Loop& loop_;
  Body body_;
  std::unique_ptr<link::ByteLink> link_;
  FrameParser parser_;
  std::uint8_t seq_;
  base::Scope scope_;
};

/// A ground station with two links.
struct TwoLinks {
  TwoLinks() {
    ground.add_link(wifi.take_server());
    ground.add_link(radio.take_server());
  }
  Voice& on_wifi(Body body = {}, link::Impairment impairment = {}) { return add(wifi, body, impairment, 0); }
  Voice& on_radio(Body body = {}, link::Impairment impairment = {.delay = 150ms}) {
    return add(radio, body, impairment, 200);
  }
  Voice& add(link::PipeHub& hub, Body body, link::Impairment impairment, std::uint8_t first_seq) {
    voices.push_back(std::make_unique<Voice>(loop, link::impair(loop, hub.connect(), impairment), body, first_seq));
    return *voices.back();
  }
  void run_for(base::Duration time) { loop.run_until_done(pass(loop, time)); }
  bool command() { return ground.send({1, 1}, CommandLong{.command = MavCmd::mission_start}).has_value(); }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  link::PipeHub wifi{loop};
  link::PipeHub radio{loop};
  Connection ground{loop, {}, {}};
  std::vector<std::unique_ptr<Voice>> voices;
};

Body const known{.boot = 100s, .hardware = 77};

TEST(TwoLinks, LeadToOneVehicleWhoseClockAndHardwareAreTheSame) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known);
  auto& radio = world.on_radio(known);
  world.run_for(4s);
  EXPECT_FALSE(world.ground.is_contested(1));
  world.run_for(10s);
  EXPECT_FALSE(world.ground.conflict(1));
  ASSERT_TRUE(world.command());
  world.run_for(1s);
  EXPECT_EQ(wifi.heard(MavCmd::mission_start), 1) << "the quick link";
  EXPECT_EQ(radio.heard(MavCmd::mission_start), 0);
}

TEST(TwoLinks, LeadToOneVehicleAtOnePlaceThoughItTellsNoNumber) {
  TwoLinks world;
  world.on_wifi({.boot = 100s});
  world.on_radio({.boot = 100s});
  world.run_for(15s);
  EXPECT_FALSE(world.ground.conflict(1));
  EXPECT_FALSE(world.ground.is_contested(1));
}

TEST(TwoLinks, LeadToTwoVehiclesIfTheHardwareDiffers) {
  TwoLinks world;
  world.on_wifi({.boot = 100s, .hardware = 77});
  world.on_radio({.boot = 100s, .hardware = 78});
  world.run_for(6s);
  EXPECT_TRUE(world.ground.conflict(1));
  EXPECT_FALSE(world.command());
}

TEST(TwoLinks, LeadToTwoVehiclesIfTheClocksDiffer) {
  TwoLinks world;
  world.on_wifi({.boot = 100s, .hardware = 77});
  world.on_radio({.boot = 101s, .hardware = 77});
  world.run_for(6s);
  EXPECT_TRUE(world.ground.conflict(1)) << "vehicles of one machine share its number";
}

TEST(TwoLinks, LeadToTwoVehiclesIfTheyStandApart) {
  TwoLinks world;
  world.on_wifi({.boot = 100s, .hardware = 77});
  world.on_radio({.boot = 100s, .hardware = 77, .place = geo::Wgs84::from_degrees(41.1781, -8.598, 100.0)});
  world.run_for(6s);
  EXPECT_TRUE(world.ground.conflict(1)) << "switched on together, 11 m apart";
}

TEST(TwoLinks, AreRefusedWhenNothingProvesThatTheyLeadToOne) {
  TwoLinks world;
  world.on_wifi({.answers = false});
  world.on_radio({.answers = false});
  world.run_for(5s);
  EXPECT_FALSE(world.ground.conflict(1)) << "they have 6 s to prove it";
  EXPECT_TRUE(world.ground.is_contested(1));
  world.run_for(4s);
  EXPECT_TRUE(world.ground.conflict(1));
  EXPECT_FALSE(world.command());
}

TEST(TwoLinks, AreNeverInConflictWhileABadRadioProvesItself) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TwoLinks world;
    world.on_wifi(known);
    world.run_for(5s);
    world.on_radio(known, {.loss = 0.3, .delay = 300ms, .seed = seed});
    bool conflict = false;
    for (int i = 0; i < 300; ++i) {
      world.run_for(200ms);
      conflict = conflict || world.ground.conflict(1).has_value();
    }
    EXPECT_FALSE(conflict) << "with seed " << seed;
  }
}

TEST(TwoLinks, BringingTheSamePacketsLeadToOneVehicle) {
  TwoLinks world;
  auto& direct = world.on_wifi({.answers = false});
  auto& routed = world.on_radio({.answers = false});
  world.run_for(2s);
  int attitudes = 0;
  auto const subscription = world.ground.subscribe(
      1, [&](Received const& received) { attitudes += std::holds_alternative<Attitude>(received.message); });
  for (int i = 0; i < 100; ++i) {
    auto const frame = direct.frame_of(Attitude{.since_boot = std::chrono::milliseconds(100 * i)});
    direct.pass_on(frame);
    routed.pass_on(frame);
    world.run_for(100ms);
  }
  EXPECT_FALSE(world.ground.conflict(1));
  EXPECT_EQ(attitudes, 100) << "each once";
  EXPECT_NEAR(static_cast<double>(world.ground.counters({1, 1}).redundant), 100.0, 15.0);
}

TEST(TwoLinks, TellEachTextOnceAndAReportFromOneOfThem) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known);
  auto& radio = world.on_radio(known);
  world.run_for(10s);
  std::vector<std::string> texts;
  std::vector<std::size_t> links;
  auto const subscription = world.ground.subscribe(1, [&](Received const& received) {
    if (auto const* text = std::get_if<StatusText>(&received.message)) texts.push_back(text->text);
    if (std::holds_alternative<Attitude>(received.message)) links.push_back(received.from.link);
  });
  for (int i = 0; i < 10; ++i) {
    for (auto* voice : {&wifi, &radio}) {
      voice->say(StatusText{.text = "again"});
      voice->say(StatusText{.text = "text " + std::to_string(i)});
      voice->say(Attitude{.since_boot = voice->clock()});
    }
    world.run_for(500ms);
  }
  EXPECT_EQ(std::ranges::count(texts, "again"), 10);
  EXPECT_EQ(texts.size(), 20u);
  EXPECT_EQ(links, std::vector<std::size_t>(10, 0))
      << "the best link speaks, the late one's old attitudes do not mix in";
}

TEST(TwoLinks, CarryOnAtOnceWhenOneFallsSilentAndDoNotFlap) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known);
  auto& radio = world.on_radio(known);
  world.run_for(10s);
  wifi.is_silent = true;
  world.run_for(3s);
  ASSERT_TRUE(world.command());
  world.run_for(1s);
  EXPECT_EQ(radio.heard(MavCmd::mission_start), 1);
  EXPECT_FALSE(world.ground.conflict(1));

  wifi.is_silent = false;
  world.run_for(1500ms);
  EXPECT_EQ(world.ground.whereabouts(1)->rfind("pipe from client 1", 0), 0u);
  ASSERT_TRUE(world.command());
  world.run_for(500ms);
  EXPECT_EQ(wifi.heard(MavCmd::mission_start), 0) << "back for a moment only";
  world.run_for(8s);
  ASSERT_TRUE(world.command());
  world.run_for(500ms);
  EXPECT_EQ(wifi.heard(MavCmd::mission_start), 1) << "back for good";
  EXPECT_FALSE(world.ground.conflict(1));
}

TEST(TwoLinks, MakeWayForTheOneThatLosesLess) {
  TwoLinks world;
  world.on_wifi(known, {.loss = 0.6, .seed = 4});
  auto& radio = world.on_radio(known, {.delay = 20ms});
  auto& wifi = *world.voices.front();
  for (int i = 0; i < 300; ++i) {
    for (auto const& voice : world.voices) voice->say(Attitude{.since_boot = voice->clock()});
    world.run_for(100ms);
  }
  auto const before = wifi.heard(MavCmd::mission_start);
  ASSERT_TRUE(world.command());
  world.run_for(1s);
  EXPECT_EQ(radio.heard(MavCmd::mission_start), 1);
  EXPECT_EQ(wifi.heard(MavCmd::mission_start), before);
}

TEST(LinkReport, TellsRatesLossesAndRoundTripsOfEachSource) {
  TwoLinks world;
  world.on_wifi(known, {.delay = 10ms});
  world.on_radio(known, {.loss = 0.25, .delay = 200ms, .seed = 2});
  for (int i = 0; i < 300; ++i) {
    for (auto const& voice : world.voices) voice->say(Attitude{.since_boot = voice->clock()});
    world.run_for(100ms);
  }
  auto const report = world.ground.report();
  ASSERT_EQ(report.size(), 2u);
  ASSERT_EQ(report[0].sources.size(), 1u);
  ASSERT_EQ(report[1].sources.size(), 1u);
  auto const& wifi = report[0].sources[0];
  auto const& radio = report[1].sources[0];
  EXPECT_EQ(wifi.address, "client 1");
  EXPECT_NEAR(wifi.messages_per_s, 11.0, 1.5);
  EXPECT_GT(wifi.bytes_per_s, 10 * 15.0);
  EXPECT_EQ(wifi.loss, 0.0);
  EXPECT_EQ(wifi.counters.lost, 0u);
  EXPECT_NEAR(base::to_seconds(*wifi.round_trip), 0.020, 1e-6);
  EXPECT_TRUE(wifi.is_alive);
  EXPECT_TRUE(wifi.is_route);
  EXPECT_LE(wifi.age, 100ms);
  EXPECT_NEAR(radio.loss, 0.25, 0.12);
  EXPECT_NEAR(base::to_seconds(*radio.round_trip), 0.400, 1e-6);
  EXPECT_FALSE(radio.is_route);
  EXPECT_GT(radio.counters.redundant, 150u);
  EXPECT_EQ(report[1].counters.lost, radio.counters.lost);
  EXPECT_EQ(report[0].name, "pipe");
  EXPECT_EQ(report[0].state, link::LinkState::open);
  EXPECT_GT(report[0].bytes.bytes_received, 5000u);

  world.voices.clear();
  world.run_for(30s);
  auto const silent = world.ground.report()[0].sources[0];
  EXPECT_FALSE(silent.is_alive);
  EXPECT_EQ(silent.messages_per_s, 0.0);
  EXPECT_GE(silent.age, 29s);
}

TEST(LinkReport, CountsWhatIsNoMessageOfOurs) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known);
  world.run_for(100ms);
  Frame frame = wifi.frame_of(Attitude{});
  frame.message_id = 54'321;
  frame.payload_size = 4;
  // Whatever its sender's seed is, the checksum must fit.
  auto const draft = serialize(frame);
  auto const bytes = draft.bytes();
  frame.checksum = crc_accumulate(bytes.subspan(1, bytes.size() - 3));
  std::uint8_t const seed = 7;
  frame.checksum = crc_accumulate({&seed, 1}, frame.checksum);
  wifi.pass_on(frame);
  world.run_for(100ms);
  auto const report = world.ground.report();
  EXPECT_EQ(report[0].frames.unknown_ids, 1u);
  EXPECT_EQ(report[0].sources[0].counters.unknown_ids, 1u);
}

TEST(Timesync, IsAnsweredToVehiclesThatAsk) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known);
  world.run_for(2s);
  wifi.say(Timesync{.tc1 = {}, .ts1 = 12345ns});
  world.run_for(100ms);
  ASSERT_EQ(wifi.clocks_told.size(), 1u);
  EXPECT_EQ(wifi.clocks_told[0].ts1, 12345ns);
  EXPECT_GE(wifi.clocks_told[0].tc1, 2s);
}

TEST(Bulk, GoesOverTheLinkThatCarriesMost) {
  TwoLinks world;
  auto& wifi = world.on_wifi(known, {.delay = 200ms});
  auto& radio = world.on_radio(known, {.delay = 200ms});
  world.run_for(10s);
  ASSERT_TRUE(world.ground.send({1, 1}, ParamRequestList{}));
  world.run_for(1s);
  EXPECT_EQ(wifi.parameters_asked + radio.parameters_asked, 1);
}

TEST(FingerprintOfAVehicle, HasNoClockOfAnotherCentury) {
  internal::Fingerprint print;
  auto const now = base::TimePoint(10s);
  for (auto const clock : {Duration::min(), Duration(-1), Duration::max()}) {
    print.take(Timesync{.tc1 = clock, .ts1 = now.time_since_epoch()}, now);
    EXPECT_FALSE(print.clock);
  }
  print.take(Timesync{.tc1 = 1h, .ts1 = now.time_since_epoch()}, now);
  ASSERT_TRUE(print.clock);
  EXPECT_EQ(print.clock->boot, now - 1h);
}

}  // namespace
}  // namespace lapwing::mavlink
