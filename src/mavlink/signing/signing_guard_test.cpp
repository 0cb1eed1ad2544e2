#include "mavlink/signing/signing_guard.hpp"

#include <gtest/gtest.h>

#include "mavlink/exchange/signing_setup.hpp"
#include "mavlink/testing/fake_vehicle.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

base::UtcTime const now = std::chrono::sys_days{std::chrono::year{2026} / 11 / 21};

SigningKey key_of(std::uint8_t byte) {
  SigningKey key{};
  key.fill(byte);
  return key;
}

/// Keys "a" and "b", nobody using them.
KeyRing two_keys() {
  KeyRing ring;
  ring.keys = {{"a", key_of(1)}, {"b", key_of(2)}};
  return ring;
}

Frame heartbeat(std::uint8_t system, std::uint8_t seq = 0) {
  return encode(Heartbeat{.type = MavType::quadrotor}, {system, 1}, seq);
}

Frame heartbeat_by(SigningKey const& key, std::uint8_t system, base::UtcTime at = now, std::uint8_t link = 0) {
  auto frame = heartbeat(system);
  sign(frame, key, link, signing_time(at));
  return frame;
}

SigningGuard guard_of(KeyRing ring) {
  SigningGuard guard(std::move(ring));
  guard.name_link(0, "udpin://0.0.0.0:14550");
  guard.name_link(1, "serial:///dev/ttyUSB0:57600");
  return guard;
}

constexpr SigningGuard::Peer radio{0, 7};
constexpr SigningGuard::Peer cable{1, 0};

TEST(SigningGuard, HearsWhatAnotherWithTheKeySends) {
  SigningGuard vehicle(ring_of(key_of(1)));
  SigningGuard station(ring_of(key_of(1)));
  for (std::uint8_t i = 0; i < 10; ++i) {
    auto frame = heartbeat(1, i);
    vehicle.sign(frame, radio, 0, now);  // ten within one tick of the clock
    EXPECT_TRUE(station.accepts(frame, radio, now)) << int{i};
  }
  EXPECT_EQ(station.counters().accepted, 10U);
}

TEST(SigningGuard, RefusesWhatItHeardBefore) {
  SigningGuard station(ring_of(key_of(1)));
  auto const first = heartbeat_by(key_of(1), 1, now);
  auto const second = heartbeat_by(key_of(1), 1, now + 1s);
  EXPECT_TRUE(station.accepts(first, radio, now));
  EXPECT_FALSE(station.accepts(first, radio, now));
  EXPECT_TRUE(station.accepts(second, radio, now + 1s));
  EXPECT_FALSE(station.accepts(first, radio, now + 2s));
  EXPECT_EQ(station.counters().replayed, 2U);
}

TEST(SigningGuard, LetsEachLinkOfASenderHaveItsOwnTime) {
  SigningGuard station(ring_of(key_of(1)));
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(1), 1, now + 1s, 0), radio, now));
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(1), 1, now, 1), cable, now)) << "late, but over another link";
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(1), 1, now, 1), cable, now));
}

TEST(SigningGuard, RefusesARecordingOfASenderThatItDoesNotKnowYet) {
  SigningGuard station(ring_of(key_of(1)));
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(1), 1, now - 2min), radio, now));
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(1), 1, now - 30s), radio, now));
}

TEST(SigningGuard, GoesOnAfterTheTimeOfItsLastLife) {
  auto const clock_set_back = now - 24h;
  SigningGuard station(ring_of(key_of(1)), signing_time(now));
  auto sent = heartbeat(255);
  station.sign(sent, radio, 0, clock_set_back);
  EXPECT_GT(time_of_signature(sent), signing_time(now));
  EXPECT_EQ(station.signed_until(), time_of_signature(sent));
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(1), 1, clock_set_back), radio, clock_set_back))
      << "recorded before that";
}

TEST(SigningGuard, SpeaksAheadOfAClockThatIsBehindWhatItHears) {
  SigningGuard station(ring_of(key_of(1)));
  ASSERT_TRUE(station.accepts(heartbeat_by(key_of(1), 1, now + 1h), radio, now));
  auto sent = heartbeat(255);
  station.sign(sent, radio, 0, now);
  SigningGuard vehicle(ring_of(key_of(1)));
  EXPECT_TRUE(vehicle.accepts(sent, radio, now + 1h));
}

TEST(SigningGuard, KnowsTheVehiclesOfItsNetworkOnly) {
  auto ring = ring_of(key_of(1));
  ring.keys["b"] = key_of(2);
  ring.vehicles[7] = {"b"};
  vehicles_of(ring, "north")[8] = {"b"};
  SigningGuard here(ring_of_network(ring, ""));
  EXPECT_TRUE(here.accepts(heartbeat_by(key_of(2), 7, now), radio, now));
  EXPECT_FALSE(here.accepts(heartbeat_by(key_of(2), 8, now), radio, now));
  SigningGuard there(ring_of_network(ring, "north"));
  EXPECT_FALSE(there.accepts(heartbeat_by(key_of(2), 7, now), radio, now));
  EXPECT_TRUE(there.accepts(heartbeat_by(key_of(2), 8, now), radio, now));
  EXPECT_TRUE(there.accepts(heartbeat_by(key_of(1), 9, now), radio, now)) << "everybody's key holds everywhere";
}

TEST(SigningGuard, HearsNobodyWithoutASignatureButRadios) {
  auto station = guard_of(ring_of(key_of(1)));
  EXPECT_FALSE(station.accepts(heartbeat(1), radio, now));
  EXPECT_FALSE(station.accepts(heartbeat(1), cable, now));
  EXPECT_EQ(station.counters().unsigned_frames, 2U);
  auto status = heartbeat(51);
  status.message_id = 109;
  EXPECT_TRUE(station.accepts(status, radio, now));
  EXPECT_FALSE(station.key_of({51, 1})) << "that says nothing about its other messages";
}

TEST(SigningGuard, HearsWithoutASignatureWhomItIsToldTo) {
  auto ring = ring_of(key_of(1));
  ring.unsigned_frames = {.local_links = true, .systems = {9}, .messages = {246}};
  auto station = guard_of(ring);
  EXPECT_TRUE(station.accepts(heartbeat(1), cable, now));
  EXPECT_FALSE(station.accepts(heartbeat(1), radio, now));
  EXPECT_TRUE(station.accepts(heartbeat(9), radio, now));
  auto traffic = heartbeat(1);
  traffic.message_id = 246;
  EXPECT_TRUE(station.accepts(traffic, radio, now));
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(3), 9), radio, now)) << "a wrong signature is none";
}

TEST(SigningGuard, GivesEachVehicleAndLinkItsKey) {
  auto ring = two_keys();
  ring.everybody = {"a"};
  ring.vehicles[7] = {"b"};
  ring.links["serial:///dev/ttyUSB0:57600"] = {"b"};
  auto station = guard_of(ring);
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(1), 1), radio, now));
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(2), 2), radio, now));
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(2), 7), radio, now));
  EXPECT_FALSE(station.accepts(heartbeat_by(key_of(1), 7, now + 1s), radio, now)) << "of another vehicle";
  EXPECT_TRUE(station.accepts(heartbeat_by(key_of(2), 3), cable, now));

  auto const signed_for = [&](SigningGuard::Peer to, std::uint8_t system) {
    auto frame = heartbeat(255);
    station.sign(frame, to, system, now);
    return is_signed_with(frame, key_of(1)) ? "a" : is_signed_with(frame, key_of(2)) ? "b" : "";
  };
  EXPECT_STREQ(signed_for(radio, 1), "a");
  EXPECT_STREQ(signed_for(radio, 7), "b");
  EXPECT_STREQ(signed_for(cable, 3), "b");
  EXPECT_STREQ(signed_for(radio, 0), "a") << "several are there: the link's key";
  EXPECT_STREQ(signed_for(cable, 0), "b");
}

TEST(SigningGuard, SpeaksToWhoeverIsAloneAtAPeerWithItsKey) {
  auto ring = two_keys();
  ring.everybody = {"a"};
  ring.vehicles[7] = {"b"};
  auto station = guard_of(ring);
  ASSERT_TRUE(station.accepts(heartbeat_by(key_of(2), 7), radio, now));
  auto frame = heartbeat(255);
  station.sign(frame, radio, 0, now);
  EXPECT_TRUE(is_signed_with(frame, key_of(2)));
}

TEST(SigningGuard, SignsWithTheKeyThatTheVehicleSignsWithWhileItIsChanged) {
  auto ring = two_keys();
  ring.vehicles[7] = {"a", "b"};
  auto station = guard_of(ring);
  auto const speaks_with = [&](SigningKey const& key) {
    auto frame = heartbeat(255);
    station.sign(frame, radio, 7, now);
    return is_signed_with(frame, key);
  };
  EXPECT_TRUE(speaks_with(key_of(1)));
  ASSERT_TRUE(station.accepts(heartbeat_by(key_of(2), 7), radio, now));
  EXPECT_EQ(station.key_of({7, 1}), "b");
  EXPECT_TRUE(speaks_with(key_of(2)));
  ASSERT_TRUE(station.accepts(heartbeat_by(key_of(1), 7, now + 1s), radio, now)) << "it was restarted";
  EXPECT_TRUE(speaks_with(key_of(1)));
}

TEST(SigningGuard, LeavesFramesAloneForWhichNoKeyHolds) {
  SigningGuard station(two_keys());
  auto frame = heartbeat(255);
  station.sign(frame, radio, 7, now);
  EXPECT_FALSE(frame.is_signed());
  SigningGuard with_key(ring_of(key_of(1)));
  frame.version = 1;
  with_key.sign(frame, radio, 7, now);
  EXPECT_FALSE(frame.is_signed()) << "MAVLink 1 has no signatures";
}

TEST(SignedConnection, LeavesNoSignatureForOneInWhatItSendsToAnother) {
  Bench bench;
  bench.vehicle->connection.set_keys(ring_of(key_of(1)));
  auto ring = two_keys();
  ring.vehicles[1] = {"a"};
  ring.unsigned_frames.systems = {2};
  bench.ground.set_keys(ring);
  FakeVehicle other(bench.loop, bench.hub.connect(), {2, 1});
  int heard = 0;
  int with_signature = 0;
  other.connection.set_frame_hook([&](Connection::Direction direction, Frame const& frame, base::TimePoint) {
    if (direction != Connection::Direction::received) return;
    ++heard;
    with_signature += frame.is_signed();
  });
  bench.vehicle->heard.clear();
  bench.run_for(5s);
  EXPECT_GT(bench.vehicle->all<Heartbeat>().size(), 2u) << "they are signed for it";
  EXPECT_GT(heard, 2);
  EXPECT_EQ(with_signature, 0);
}

TEST(LocalLinks, AreThoseOnWhichNobodyListens) {
  for (auto const* url : {"serial:///dev/ttyUSB0:57600", "udpin://127.0.0.1:14550", "tcpout://localhost:5760"})
    EXPECT_TRUE(is_local(url)) << url;
  for (auto const* url : {"udpin://0.0.0.0:14550", "udpout://10.1.2.3:14550", "nonsense"})
    EXPECT_FALSE(is_local(url)) << url;
}

// ---- setting keys up

/// A vehicle that takes keys as ArduPilot does.
void takes_keys(FakeVehicle& vehicle) {
  vehicle.on = [&vehicle](Message const& message) {
    auto const* setup = std::get_if<SetupSigning>(&message);
    if (!setup) return;
    bool const is_off = setup->key == SigningKey{};
    vehicle.connection.set_keys(is_off ? std::nullopt : std::optional(ring_of(setup->key)));
  };
}

TEST(SigningSetup, GivesChangesAndTakesAKey) {
  Bench bench({.loss = 0.3, .seed = 4});
  takes_keys(*bench.vehicle);
  auto ring = two_keys();
  ring.vehicles[1] = {"a"};
  ring.unsigned_frames.systems = {1};
  bench.ground.set_keys(ring);
  ASSERT_TRUE(bench.loop.run_until_done(give_key(bench.ground, Bench::target, "a")));
  ASSERT_TRUE(bench.vehicle->connection.signing());
  EXPECT_EQ(bench.vehicle->connection.signing()->ring(), ring_of(key_of(1)));

  ring.unsigned_frames.systems = {};
  ring.vehicles[1] = {"a", "b"};
  bench.ground.set_keys(ring);
  ASSERT_TRUE(bench.loop.run_until_done(give_key(bench.ground, Bench::target, "b")));
  EXPECT_EQ(bench.ground.signing()->key_of({1, 1}), "b");
  ring.vehicles[1] = {"b"};
  bench.ground.set_keys(ring);
  bench.vehicle->heard.clear();
  bench.run_for(10s);
  EXPECT_FALSE(bench.vehicle->all<Heartbeat>().empty()) << "they still hear each other";
  EXPECT_EQ(bench.ground.signing()->key_of({1, 1}), "b");

  ring.unsigned_frames.systems = {1};
  bench.ground.set_keys(ring);
  ASSERT_TRUE(bench.loop.run_until_done(take_key_away(bench.ground, Bench::target)));
  EXPECT_FALSE(bench.vehicle->connection.signing());
}

TEST(SigningSetup, LosesNothingWhenTheVehicleTakesNoKey) {
  Bench bench;
  bench.vehicle->connection.set_keys(ring_of(key_of(1)));
  auto ring = two_keys();
  ring.vehicles[1] = {"a", "b"};
  bench.ground.set_keys(ring);
  auto const given = bench.loop.run_until_done(give_key(bench.ground, Bench::target, "b", {.tries = 3}));
  ASSERT_FALSE(given);
  EXPECT_EQ(given.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(bench.ground.signing()->key_of({1, 1}), "a");
  bench.vehicle->heard.clear();
  bench.run_for(3s);
  EXPECT_FALSE(bench.vehicle->heard.empty());
}

TEST(SigningSetup, IsNotDeceivedByACameraThatSignsNothing) {
  Bench bench;
  bench.vehicle->connection.set_keys(ring_of(key_of(1)));
  auto ring = two_keys();
  ring.vehicles[1] = {"a"};
  ring.unsigned_frames.systems = {1};
  bench.ground.set_keys(ring);
  FakeVehicle const camera(bench.loop, bench.hub.connect(), {1, 100});
  bench.run_for(3s);
  auto const taken = bench.loop.run_until_done(take_key_away(bench.ground, Bench::target, {.tries = 3}));
  ASSERT_FALSE(taken) << "the autopilot signs still";
  EXPECT_EQ(taken.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(bench.ground.signing()->key_of({1, 1}), "a");
  EXPECT_EQ(bench.ground.signing()->key_of({1, 100}), "");
  EXPECT_FALSE(bench.ground.signing()->key_of({1, 154}));
}

TEST(SigningGuard, SpeaksToASystemWithItsAutopilotsKey) {
  auto ring = two_keys();
  ring.vehicles[7] = {"a", "b"};
  auto station = guard_of(ring);
  auto const by = [](std::uint8_t component, SigningKey const& key) {
    auto frame = encode(Heartbeat{.type = MavType::quadrotor}, {7, component}, 0);
    sign(frame, key, 0, signing_time(now));
    return frame;
  };
  auto const speaks_with_b = [&] {
    auto frame = heartbeat(255);
    station.sign(frame, radio, 7, now);
    return is_signed_with(frame, key_of(2));
  };
  ASSERT_TRUE(station.accepts(by(100, key_of(2)), radio, now));
  EXPECT_TRUE(speaks_with_b()) << "nothing else of it was heard";
  ASSERT_TRUE(station.accepts(by(1, key_of(1)), radio, now));
  EXPECT_FALSE(speaks_with_b()) << "whatever its camera signs with";
}

TEST(SigningGuard, ForgetsWhoWasAtAFarEndThatIsGone) {
  auto ring = two_keys();
  ring.everybody = {"a"};
  ring.vehicles[7] = {"b"};
  auto station = guard_of(ring);
  ASSERT_TRUE(station.accepts(heartbeat_by(key_of(2), 7), radio, now));
  station.forget(radio);
  auto frame = heartbeat(255);
  station.sign(frame, radio, 0, now);
  EXPECT_TRUE(is_signed_with(frame, key_of(1)));
}

TEST(SigningSetup, KnowsOnlyKeysOfTheRing) {
  Bench bench;
  auto const without = bench.loop.run_until_done(give_key(bench.ground, Bench::target, "a"));
  ASSERT_FALSE(without);
  bench.ground.set_keys(two_keys());
  auto const other = bench.loop.run_until_done(give_key(bench.ground, Bench::target, "c"));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, base::ErrorKind::invalid_input);
}

TEST(SigningSetup, IsNeverRecorded) {
  Bench bench;
  takes_keys(*bench.vehicle);
  int recorded = 0;
  auto const count = [&](Connection::Direction, Frame const& frame, base::TimePoint) {
    recorded += tells_a_key(frame);
  };
  bench.ground.set_frame_hook(count);
  bench.vehicle->connection.set_frame_hook(count);
  auto ring = two_keys();
  ring.everybody = {"a"};
  ring.unsigned_frames.systems = {1};
  bench.ground.set_keys(ring);
  ASSERT_TRUE(bench.loop.run_until_done(give_key(bench.ground, Bench::target, "a")));
  EXPECT_EQ(recorded, 0);
}

}  // namespace
}  // namespace lapwing::mavlink
