#include "route/shaper.hpp"

#include <string>

#include <gtest/gtest.h>

#include "route/test_packets.hpp"

namespace lapwing::route {
namespace {

using namespace std::chrono_literals;
using Verdict = Shaper::Verdict;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

Limits messages_per_s(double rate) {
  return {.all = {.messages_per_s = rate}};
}

Packet attitude(std::int64_t boot_ms, Address source = {1, 1}) {
  return packet("ATTITUDE", {.source = source, .fields = {{"time_boot_ms", boot_ms}}});
}

Packet command(std::int64_t number) {
  return packet("COMMAND_LONG", {.source = {255, 190}, .target = {1, 1}, .fields = {{"command", number}}});
}

/// Takes what the shaper lets out now.
Bytes released(Shaper& shaper, base::TimePoint now) {
  auto const out = shaper.release(now);
  return out ? Bytes(out->bytes.begin(), out->bytes.end()) : Bytes();
}

/// Uses up the burst, so that what follows waits.
void exhaust(Shaper& shaper, base::TimePoint now) {
  while (shaper.offer(command(0).view(), now) == Verdict::go) {
  }
  EXPECT_EQ(shaper.waiting(), 1u);
}

// ---- the token bucket

TEST(TokenBucket, GivesABurstAndThenItsRate) {
  TokenBucket bucket(10.0, 3.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(bucket.ready(1.0, at(0s)), at(0s));
    bucket.take(1.0, at(0s));
  }
  EXPECT_EQ(bucket.ready(1.0, at(0s)), at(100ms));
  EXPECT_EQ(bucket.ready(1.0, at(60ms)), at(100ms));
  bucket.take(1.0, at(100ms));
  EXPECT_EQ(bucket.ready(1.0, at(100ms)), at(200ms));
  EXPECT_EQ(bucket.ready(3.0, at(100s)), at(100s)) << "a pause fills it";
  EXPECT_EQ(bucket.ready(50.0, at(100s)), at(100s)) << "more than a burst is as good as a burst";
}

TEST(TokenBucket, KeepsItsRateOverALongTime) {
  TokenBucket bucket(3.0, 1.0);
  auto now = at(0s);
  int taken = 0;
  while (now < at(1000s)) {
    bucket.take(1.0, now);
    ++taken;
    now = bucket.ready(1.0, now);
  }
  EXPECT_NEAR(taken, 3000, 1);
}

TEST(TokenBucket, WithoutALimitIsAlwaysReady) {
  TokenBucket bucket(std::numeric_limits<double>::infinity(), 1.0);
  for (int i = 0; i < 10; ++i) bucket.take(1e9, at(0s));
  EXPECT_EQ(bucket.ready(1e9, at(0s)), at(0s));
}

// ---- the shaper

TEST(Shaper, LetsPassWhatTheRateAllows) {
  Shaper shaper(messages_per_s(100.0));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(shaper.offer(attitude(i).view(), at(0s)), Verdict::go) << "a burst of 0.1 s";
  EXPECT_EQ(shaper.offer(attitude(10).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.next_release(at(0s)), at(10ms));
  EXPECT_EQ(released(shaper, at(9ms)), Bytes());
  EXPECT_EQ(released(shaper, at(10ms)), attitude(10).bytes);
  EXPECT_EQ(shaper.next_release(at(10ms)), base::TimePoint::max());
}

TEST(Shaper, CountsBytesToo) {
  Shaper shaper({.all = {.bytes_per_s = 400.0}});
  auto const size = static_cast<int>(attitude(1).bytes.size());
  int passed = 0;
  while (shaper.offer(attitude(1).view(), at(0s)) == Verdict::go) ++passed;
  EXPECT_EQ(passed, 280 / size) << "a burst of the largest packet there is";
  auto const next = shaper.next_release(at(0s));
  auto const missing = (passed + 1) * size - 280;
  EXPECT_NEAR(base::to_seconds(next.time_since_epoch()), missing / 400.0, 1e-6);
}

TEST(Shaper, KeepsTheNewestOfEachKindOfTelemetry) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  EXPECT_EQ(shaper.offer(attitude(1).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(attitude(1, {2, 1}).view(), at(0s)), Verdict::waits) << "of another vehicle";
  EXPECT_EQ(shaper.offer(packet("VFR_HUD").view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(attitude(2).view(), at(0s)), Verdict::replaced);
  EXPECT_EQ(shaper.offer(attitude(3).view(), at(0s)), Verdict::replaced);
  EXPECT_EQ(shaper.waiting(), 4u);
  EXPECT_EQ(released(shaper, at(1s)), command(0).bytes);
  EXPECT_EQ(released(shaper, at(2s)), attitude(3).bytes) << "new value, old place in the line";
  EXPECT_EQ(released(shaper, at(3s)), attitude(1, {2, 1}).bytes);
  EXPECT_EQ(released(shaper, at(4s)), packet("VFR_HUD").bytes);
  EXPECT_EQ(shaper.waiting(), 0u);
}

TEST(Shaper, TellsBatteriesAndNamedValuesApart) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  auto const battery = [](std::int64_t id) { return packet("BATTERY_STATUS", {.fields = {{"id", id}}}); };
  auto const named = [](std::string name) { return packet("NAMED_VALUE_FLOAT", {.fields = {{"name", name}}}); };
  EXPECT_EQ(shaper.offer(battery(0).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(battery(1).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(battery(1).view(), at(0s)), Verdict::replaced);
  EXPECT_EQ(shaper.offer(named("speed").view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(named("height").view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(named("speed").view(), at(0s)), Verdict::replaced);
}

Packet parameter(std::int64_t index) {
  return packet("PARAM_VALUE", {.fields = {{"param_index", index}}});
}

TEST(Shaper, SendsOrdersFirstThenOtherCommandsThenTelemetry) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  EXPECT_EQ(shaper.offer(attitude(1).view(), at(0s)), Verdict::waits);
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(shaper.offer(parameter(i).view(), at(0s)), Verdict::waits);
  auto const mode = packet("SET_MODE", {.source = {255, 190}, .target = {1, 0}});
  auto const answer = packet("COMMAND_ACK");
  for (auto const& order : {command(1), mode, answer}) EXPECT_EQ(shaper.offer(order.view(), at(0s)), Verdict::waits);
  auto now = at(0s);
  for (auto const& next : {command(0), command(1), mode, answer, parameter(1), parameter(2), parameter(3), attitude(1)})
    EXPECT_EQ(released(shaper, now += 100ms), next.bytes);
}

TEST(Shaper, DropsOrdersThatHaveWaitedForTooLong) {
  Shaper shaper(messages_per_s(1.0));
  exhaust(shaper, at(0s));
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(shaper.offer(command(i).view(), at(500ms)), Verdict::waits);
  auto const answer = packet("COMMAND_ACK");
  EXPECT_EQ(shaper.offer(answer.view(), at(500ms)), Verdict::waits);
  EXPECT_EQ(shaper.take_expired(), 0u);
  EXPECT_EQ(released(shaper, at(1s)), command(0).bytes);
  EXPECT_EQ(released(shaper, at(2s)), command(1).bytes);
  EXPECT_EQ(released(shaper, at(3s)), answer.bytes) << "tells what was done, however late";
  EXPECT_EQ(shaper.take_expired(), 2u);
  EXPECT_EQ(shaper.take_expired(), 0u) << "counted once";
  EXPECT_EQ(shaper.waiting(), 0u);
}

TEST(Shaper, KeepsCorrectionsOutOfTheWayOfCommandsAndDropsOldOnes) {
  Shaper shaper(messages_per_s(1.0));
  exhaust(shaper, at(0s));
  auto const corrections = [](std::int64_t flags) { return packet("GPS_RTCM_DATA", {.fields = {{"flags", flags}}}); };
  for (int i = 0; i < 20; ++i) EXPECT_EQ(shaper.offer(corrections(i).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(parameter(1).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(released(shaper, at(1s)), command(0).bytes);
  EXPECT_EQ(released(shaper, at(2s)), parameter(1).bytes);
  EXPECT_EQ(released(shaper, at(3s)), corrections(0).bytes);
  EXPECT_EQ(released(shaper, at(10s)), Bytes());
  EXPECT_EQ(shaper.take_expired(), 19u);
}

TEST(Shaper, KeepsTextsAndAnswersThatAreForAllInOrder) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  auto const text = [](std::string words) { return packet("STATUSTEXT", {.fields = {{"text", words}}}); };
  EXPECT_EQ(shaper.offer(text("one").view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(text("two").view(), at(0s)), Verdict::waits);
  (void)released(shaper, at(1s));
  EXPECT_EQ(released(shaper, at(2s)), text("one").bytes);
  EXPECT_EQ(released(shaper, at(3s)), text("two").bytes);
}

TEST(Shaper, NeverSendsAnOldPositionOfTheSticks) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  auto const sticks = [](std::int64_t pwm) {
    return packet("RC_CHANNELS_OVERRIDE", {.target = {1, 1}, .fields = {{"chan1_raw", pwm}}});
  };
  EXPECT_EQ(shaper.offer(sticks(1100).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(sticks(1900).view(), at(0s)), Verdict::replaced);
}

TEST(Shaper, LetsTelemetryAndBulkTakeTurns) {
  Shaper shaper(messages_per_s(10.0));
  exhaust(shaper, at(0s));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(shaper.offer(packet("LOG_DATA", {.fields = {{"ofs", std::int64_t{i}}}}).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(unknown_packet(70'000).view(), at(0s)), Verdict::waits);
  for (std::uint8_t system = 1; system <= 4; ++system) (void)shaper.offer(attitude(1, {system, 1}).view(), at(0s));
  (void)released(shaper, at(1s));
  std::string order;
  for (int i = 0; i < 8; ++i) order += released(shaper, at(2s + i * 1s))[7] == 30 ? 't' : 'b';
  EXPECT_EQ(order, "tbtbtbtb");
}

TEST(Shaper, RefusesMoreParametersThanItHasRoomFor) {
  Shaper shaper(messages_per_s(1.0));
  exhaust(shaper, at(0s));
  std::int64_t constexpr room = Shaper::max_single;
  for (std::int64_t i = 0; i < room; ++i) EXPECT_EQ(shaper.offer(parameter(i).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(parameter(9999).view(), at(0s)), Verdict::refused);
  EXPECT_EQ(released(shaper, at(1s)), command(0).bytes);
  EXPECT_EQ(released(shaper, at(2s)), parameter(0).bytes);
  EXPECT_EQ(shaper.offer(parameter(9999).view(), at(2s)), Verdict::waits);
  for (std::int64_t i = 1; i < room; ++i) EXPECT_EQ(released(shaper, at(1s * (i + 2))), parameter(i).bytes) << i;
}

TEST(Shaper, TakesTheNewestOrderInThePlaceOfTheOldest) {
  Shaper shaper(messages_per_s(1000.0));
  exhaust(shaper, at(0s));
  for (std::size_t i = 1; i < Shaper::max_single; ++i)
    EXPECT_EQ(shaper.offer(command(static_cast<std::int64_t>(i)).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(command(9999).view(), at(0s)), Verdict::displaced) << "it may be a stop";
  EXPECT_EQ(shaper.waiting(), Shaper::max_single);
  auto now = at(0s);
  for (std::size_t i = 1; i < Shaper::max_single; ++i)
    EXPECT_EQ(released(shaper, now += 1ms), command(static_cast<std::int64_t>(i)).bytes) << i;
  EXPECT_EQ(released(shaper, now += 1ms), command(9999).bytes);
}

TEST(Shaper, ForgetsKindsOfTelemetryThatNoLongerCome) {
  Shaper shaper(messages_per_s(1000.0));
  auto const traffic = [](std::size_t aircraft) {
    return packet("ADSB_VEHICLE", {.fields = {{"ICAO_address", static_cast<std::int64_t>(aircraft)}}});
  };
  exhaust(shaper, at(0s));
  for (std::size_t i = 0; i < Shaper::max_streams; ++i)
    ASSERT_EQ(shaper.offer(traffic(i).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(traffic(1'000'000).view(), at(0s)), Verdict::refused) << "every place is taken and waits";
  auto now = at(0s);
  for (int i = 0; i < 1001; ++i) {
    now += 1ms;
    ASSERT_FALSE(released(shaper, now).empty());
  }
  EXPECT_EQ(shaper.offer(traffic(1'000'000).view(), now), Verdict::waits);
  EXPECT_EQ(released(shaper, now + 1ms), traffic(1000).bytes) << "in the order in which they came";
  EXPECT_EQ(shaper.offer(traffic(2000).view(), now), Verdict::replaced) << "those that wait are still known";
}

TEST(Shaper, LimitsAClassWithinTheWhole) {
  Limits limits = messages_per_s(100.0);
  limits.by_class[static_cast<std::size_t>(MessageClass::telemetry)].messages_per_s = 1.0;
  Shaper shaper(limits);
  EXPECT_EQ(shaper.offer(attitude(1).view(), at(0s)), Verdict::go);
  EXPECT_EQ(shaper.offer(attitude(2).view(), at(0s)), Verdict::waits);
  EXPECT_EQ(shaper.offer(command(1).view(), at(0s)), Verdict::go) << "commands have room";
  EXPECT_EQ(released(shaper, at(500ms)), Bytes());
  EXPECT_EQ(released(shaper, at(1s)), attitude(2).bytes);
}

}  // namespace
}  // namespace lapwing::route
