#include "mavlink/signing/signing.hpp"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "mavlink/codec/codec.hpp"
#include "mavlink/testing/frame_bytes.hpp"

namespace lapwing::mavlink {
namespace {

using namespace std::chrono_literals;
using namespace testing;

SigningKey counting_key() {
  SigningKey key{};
  std::iota(key.begin(), key.end(), std::uint8_t{0});
  return key;
}

// Signed by pymavlink: a ground station's HEARTBEAT, sequence 200, key 00 01 ... 1F, link 3, time 0x0102030405.
Data const from_pymavlink = {0xFD, 0x09, 0x01, 0x00, 0xC8, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00, 0x00,
                             0x00, 0x00, 0x06, 0x08, 0x00, 0x04, 0x03, 0x09, 0x52, 0x03, 0x05, 0x04,
                             0x03, 0x02, 0x01, 0x00, 0xF5, 0xCA, 0x9B, 0xEA, 0x92, 0x20};

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

TEST(Signing, KnowsTheMessageThatTellsAKey) {
  EXPECT_TRUE(tells_a_key(encode(SetupSigning{}, {255, 190}, 0)));
  EXPECT_FALSE(tells_a_key(heartbeat(1)));
}

}  // namespace
}  // namespace lapwing::mavlink
