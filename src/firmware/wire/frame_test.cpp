#include "firmware/wire/frame.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/wire/crc16.hpp"

namespace lapwing::firmware {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes cobs(Bytes const& plain) {
  Bytes out(longest_cobs(plain.size()));
  out.resize(write_cobs(plain, out));
  return out;
}

std::optional<Bytes> plain(Bytes coded) {
  auto const size = read_cobs(coded);
  if (!size) return std::nullopt;
  coded.resize(*size);
  return coded;
}

Bytes counting(std::size_t size, int from) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(from));
  return bytes;
}

Bytes bytes_of(FrameBytes const& frame) {
  return {frame.view().begin(), frame.view().end()};
}

/// The payloads that a reader found in a stream.
std::vector<Bytes> payloads(FrameReader& reader, Bytes const& stream) {
  std::vector<Bytes> found;
  for (auto const byte : stream)
    if (reader.push(byte)) found.emplace_back(reader.packet().payload.begin(), reader.packet().payload.end());
  return found;
}

TEST(Crc16, IsThePublishedOne) {
  Bytes const digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(digits), 0x29B1);
  EXPECT_EQ(crc16({}), 0xFFFF);
}

TEST(Cobs, WritesWhatThePaperSays) {
  EXPECT_EQ(cobs({}), (Bytes{1}));
  EXPECT_EQ(cobs({0}), (Bytes{1, 1}));
  EXPECT_EQ(cobs({0x11, 0x22, 0, 0x33}), (Bytes{3, 0x11, 0x22, 2, 0x33}));
  EXPECT_EQ(cobs({0x11, 0, 0, 0}), (Bytes{2, 0x11, 1, 1, 1}));
  EXPECT_EQ(cobs(counting(254, 1)).size(), 255U);
  EXPECT_EQ(cobs(counting(254, 1)).front(), 0xFF);
}

TEST(Cobs, ReadsBackWhateverItWroteAroundTheLongestRun) {
  for (std::size_t size = 0; size < 520; ++size)
    for (int const from : {0, 1, 2, 255}) {
      auto const bytes = counting(size, from);
      auto const coded = cobs(bytes);
      EXPECT_EQ(std::ranges::count(coded, 0), 0);
      EXPECT_EQ(plain(coded), bytes) << size << " from " << from;
    }
}

TEST(Cobs, RefusesWhatNobodyWrote) {
  EXPECT_FALSE(plain({5, 1, 2}));
  EXPECT_FALSE(plain({0}));
  EXPECT_FALSE(plain({3, 1, 0}));
}

TEST(Frame, IsAsTheReferenceShowsIt) {
  EXPECT_EQ(bytes_of(write_frame({.type = 0x16, .sequence = 5, .payload = {}})),
            (Bytes{0x06, 0x01, 0x16, 0x05, 0xDC, 0x02, 0x00}));
}

TEST(Frame, TheLongestIsReadBack) {
  auto const payload = counting(longest_payload, 7);
  auto const frame = write_frame({.type = 2, .sequence = 0, .payload = payload});
  EXPECT_LE(frame.size, longest_frame);
  FrameReader reader;
  EXPECT_EQ(payloads(reader, bytes_of(frame)), std::vector<Bytes>{payload});
}

TEST(FrameReader, FindsItsPlaceInTheMiddleOfAStream) {
  auto const first = bytes_of(write_frame({.type = 1, .sequence = 0, .payload = counting(20, 1)}));
  auto const second = bytes_of(write_frame({.type = 1, .sequence = 1, .payload = counting(3, 9)}));
  Bytes stream(first.begin() + 5, first.end());
  stream.insert(stream.end(), second.begin(), second.end());
  FrameReader reader;
  EXPECT_EQ(payloads(reader, stream), std::vector<Bytes>{counting(3, 9)});
  EXPECT_EQ(reader.counters().damaged, 1U);
}

TEST(FrameReader, LosesNoMoreThanTheFrameInWhichAnyBitWasTurned) {
  auto const before = bytes_of(write_frame({.type = 1, .sequence = 0, .payload = counting(8, 0)}));
  auto const after = bytes_of(write_frame({.type = 1, .sequence = 2, .payload = counting(4, 50)}));
  auto const middle = bytes_of(write_frame({.type = 1, .sequence = 1, .payload = counting(12, 0)}));
  // The delimiter is left whole: without it two frames are one run of bytes, and both are lost.
  for (std::size_t bit = 0; bit < (middle.size() - 1) * 8; ++bit) {
    auto damaged = middle;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    Bytes stream = before;
    stream.insert(stream.end(), damaged.begin(), damaged.end());
    stream.insert(stream.end(), after.begin(), after.end());
    FrameReader reader;
    EXPECT_EQ(payloads(reader, stream), (std::vector<Bytes>{counting(8, 0), counting(4, 50)})) << "bit " << bit;
    EXPECT_EQ(reader.counters().missed, 1U);
  }
}

TEST(FrameReader, ForgetsALongRunOfNoise) {
  Bytes stream(10'000, 0x55);
  stream.push_back(0);
  auto const frame = bytes_of(write_frame({.type = 1, .sequence = 0, .payload = counting(3, 1)}));
  stream.insert(stream.end(), frame.begin(), frame.end());
  FrameReader reader;
  EXPECT_EQ(payloads(reader, stream), std::vector<Bytes>{counting(3, 1)});
  EXPECT_EQ(reader.counters().damaged, 1U);
}

TEST(FrameReader, TellsAnotherVersionFromDamage) {
  Bytes packet{9, 1, 0};
  auto const crc = crc16(packet);
  packet.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  packet.push_back(static_cast<std::uint8_t>(crc >> 8U));
  auto stream = cobs(packet);
  stream.push_back(0);
  FrameReader reader;
  EXPECT_TRUE(payloads(reader, stream).empty());
  EXPECT_EQ(reader.counters().other_version, 1U);
  EXPECT_EQ(reader.other_version(), 9);
  EXPECT_EQ(reader.counters().damaged, 0U);
}

TEST(FrameReader, CountsWhatTheSequenceMissesAcrossItsEnd) {
  FrameReader reader;
  for (int const sequence : {254, 255, 0, 3}) {
    auto const frame = write_frame({.type = 1, .sequence = static_cast<std::uint8_t>(sequence), .payload = {}});
    for (auto const byte : frame.view()) (void)reader.push(byte);
  }
  EXPECT_EQ(reader.counters().frames, 4U);
  EXPECT_EQ(reader.counters().missed, 2U);
}

}  // namespace
}  // namespace lapwing::firmware
