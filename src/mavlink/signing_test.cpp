#include "mavlink/signing.hpp"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "mavlink/codec.hpp"

namespace lapwing::mavlink {
namespace {

using namespace std::chrono_literals;
using Data = std::vector<std::uint8_t>;

SigningKey counting_key() {
  SigningKey key{};
  std::iota(key.begin(), key.end(), std::uint8_t{0});
  return key;
}

// Signed by pymavlink: a ground station's HEARTBEAT, sequence 200, key 00 01 ... 1F, link 3, time 0x0102030405.
Data const from_pymavlink = {0xFD, 0x09, 0x01, 0x00, 0xC8, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00, 0x00,
                             0x00, 0x00, 0x06, 0x08, 0x00, 0x04, 0x03, 0x09, 0x52, 0x03, 0x05, 0x04,
                             0x03, 0x02, 0x01, 0x00, 0xF5, 0xCA, 0x9B, 0xEA, 0x92, 0x20};

Frame parsed(Data const& data) {
  Frame result;
  FrameParser parser;
  parser.feed(data, [&](Frame const& frame) { result = frame; });
  EXPECT_EQ(parser.counters().frames, 1U);
  return result;
}

Data bytes_of(Frame const& frame) {
  auto const out = serialize(frame);
  return {out.bytes().begin(), out.bytes().end()};
}

base::UtcTime const now = std::chrono::sys_days{std::chrono::year{2026} / 11 / 21};

Frame heartbeat(std::uint8_t system, std::uint8_t seq = 0) {
  return encode(Heartbeat{.type = MavType::quadrotor}, {system, 1}, seq);
}

TEST(Signing, MakesTheBytesThatPymavlinkMakes) {
  auto frame = parsed(from_pymavlink);
  frame.incompat_flags = 0;
  frame.signature = {};
  sign(frame, counting_key(), 3, 0x0102030405);
  EXPECT_EQ(bytes_of(frame), from_pymavlink);
}

TEST(Signing, KnowsThePacketsThatPymavlinkSigned) {
  EXPECT_TRUE(is_signed_with(parsed(from_pymavlink), counting_key()));
}

TEST(Signing, RefusesEveryOtherKeyAndEveryChangedBit) {
  auto const frame = parsed(from_pymavlink);
  auto key = counting_key();
  key[31] ^= 1U;
  EXPECT_FALSE(is_signed_with(frame, key));
  for (std::size_t byte = 0; byte < frame.payload_size; ++byte) {
    auto changed = frame;
    changed.payload[byte] ^= 0x10U;
    EXPECT_FALSE(is_signed_with(changed, counting_key())) << byte;
  }
  for (std::size_t byte = 0; byte < frame.signature.size(); ++byte) {
    auto changed = frame;
    changed.signature[byte] ^= 1U;
    EXPECT_FALSE(is_signed_with(changed, counting_key())) << byte;
  }
}

TEST(Signing, KnowsPacketsWhosePayloadWasNotTrimmed) {
  auto frame = heartbeat(1);
  frame.payload_size = 9;
  frame.payload[8] = 0;  // ends with zero: a sender may trim it or not
  sign(frame, counting_key(), 0, 7);
  EXPECT_TRUE(is_signed_with(parsed(bytes_of(frame)), counting_key()));
}

TEST(Signing, MakesKeysOfPassPhrasesByTheirHash) {
  // printf 'open sesame' | sha256sum
  auto const key = key_from_passphrase("open sesame");
  EXPECT_EQ(key[0], 0x41);
  EXPECT_EQ(key[1], 0xEF);
  EXPECT_EQ(key[31], 0xEB);
}

TEST(Signing, CountsTimeInTensOfMicrosecondsSince2015) {
  EXPECT_EQ(signing_time(std::chrono::sys_days{std::chrono::year{2015} / 1 / 1} + 1s), 100'000U);
  EXPECT_EQ(signing_time(base::UtcTime{}), 0U);  // a clock that was never set
}

TEST(SigningGuard, HearsWhatAnotherWithTheKeySends) {
  SigningGuard vehicle(counting_key());
  SigningGuard station(counting_key());
  for (std::uint8_t i = 0; i < 10; ++i) {
    auto frame = heartbeat(1, i);
    vehicle.sign(frame, 0, now);  // ten within one tick of the clock
    EXPECT_TRUE(station.accepts(parsed(bytes_of(frame)), now)) << int{i};
  }
  EXPECT_EQ(station.counters().accepted, 10U);
}

TEST(SigningGuard, RefusesWhatItHeardBefore) {
  SigningGuard vehicle(counting_key());
  SigningGuard station(counting_key());
  auto first = heartbeat(1, 0);
  auto second = heartbeat(1, 1);
  vehicle.sign(first, 0, now);
  vehicle.sign(second, 0, now + 1s);
  EXPECT_TRUE(station.accepts(first, now));
  EXPECT_FALSE(station.accepts(first, now));
  EXPECT_TRUE(station.accepts(second, now + 1s));
  EXPECT_FALSE(station.accepts(first, now + 2s));
  EXPECT_EQ(station.counters().replayed, 2U);
}

TEST(SigningGuard, RefusesARecordingOfASenderThatItDoesNotKnowYet) {
  SigningGuard vehicle(counting_key());
  auto recorded = heartbeat(1);
  vehicle.sign(recorded, 0, now - 2min);
  SigningGuard station(counting_key());
  EXPECT_FALSE(station.accepts(recorded, now));
  auto recent = heartbeat(1, 1);
  vehicle.sign(recent, 0, now - 30s);
  EXPECT_TRUE(station.accepts(recent, now));
}

TEST(SigningGuard, RefusesTheUnsignedButForRadios) {
  SigningGuard station(counting_key());
  EXPECT_FALSE(station.accepts(heartbeat(1), now));
  EXPECT_EQ(station.counters().unsigned_frames, 1U);
  auto radio = heartbeat(51);
  radio.message_id = 109;
  EXPECT_TRUE(station.accepts(radio, now));
}

TEST(SigningGuard, SpeaksAheadOfAClockThatIsBehindWhatItHears) {
  SigningGuard station(counting_key());
  SigningGuard vehicle(counting_key());
  auto heard = heartbeat(1);
  vehicle.sign(heard, 0, now + 1h);
  ASSERT_TRUE(station.accepts(heard, now));
  auto sent = heartbeat(255);
  station.sign(sent, 0, now);
  EXPECT_TRUE(vehicle.accepts(sent, now + 1h));
}

}  // namespace
}  // namespace lapwing::mavlink
