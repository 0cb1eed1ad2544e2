#include "mavlink/wire/tlog.hpp"

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "mavlink/codec/codec.hpp"

namespace lapwing::mavlink {
namespace {

using std::chrono::microseconds;

// Written by pymavlink: eight bytes of time (2026-11-21 10:00:00 UTC), then vehicle 1's MAVLink 1 MISSION_COUNT.
std::vector<std::uint8_t> const one_entry = {0x00, 0x06, 0x60, 0xC6, 0x6C, 0x7A, 0x28, 0x00, 0xFE, 0x04,
                                             0x09, 0x01, 0x01, 0x2C, 0x07, 0x00, 0x01, 0x01, 0x62, 0xCA};

std::string text_of(std::vector<std::uint8_t> const& bytes) {
  return {bytes.begin(), bytes.end()};
}

base::UtcTime at(std::int64_t seconds) {
  return base::UtcTime(std::chrono::seconds(seconds));
}

Frame heartbeat(std::uint8_t system) {
  return encode(Heartbeat{.type = MavType::quadrotor}, {system, 1}, 5);
}

std::vector<TlogEntry> read_all(TlogReader& reader, std::vector<std::vector<std::uint8_t>>& packets) {
  std::vector<TlogEntry> entries;
  while (auto const entry = reader.next()) {
    packets.emplace_back(entry->packet.begin(), entry->packet.end());
    entries.push_back(*entry);
  }
  return entries;
}

struct Read {
  std::vector<TlogEntry> entries;  ///< without their packets, which lived for a moment
  std::vector<std::vector<std::uint8_t>> packets;
  std::uint64_t skipped = 0;
};

Read read(std::string const& bytes) {
  std::istringstream in(bytes);
  TlogReader reader(in);
  Read result;
  result.entries = read_all(reader, result.packets);
  result.skipped = reader.skipped_bytes();
  return result;
}

TEST(Tlog, ReadsWhatOtherProgramsWrite) {
  auto const log = read(text_of(one_entry));
  ASSERT_EQ(log.packets.size(), 1U);
  EXPECT_EQ(log.packets[0], std::vector<std::uint8_t>(one_entry.begin() + 8, one_entry.end()));
  EXPECT_EQ(log.entries[0].at.time_since_epoch(), microseconds(0x0006'60C6'6C7A'2800));
  EXPECT_EQ(log.skipped, 0U);
}

TEST(Tlog, ReadsBackWhatItWrote) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 10'000; ++i) {
    append_tlog(bytes, at(1'700'000'000) + microseconds(i), heartbeat(static_cast<std::uint8_t>(i % 250)));
  }
  auto const log = read(text_of(bytes));
  ASSERT_EQ(log.packets.size(), 10'000U);
  EXPECT_EQ(log.skipped, 0U);
  for (int i = 0; i < 10'000; ++i) {
    auto const expected = serialize(heartbeat(static_cast<std::uint8_t>(i % 250)));
    auto const& packet = log.packets[static_cast<std::size_t>(i)];
    EXPECT_TRUE(std::equal(packet.begin(), packet.end(), expected.bytes().begin(), expected.bytes().end())) << i;
    EXPECT_EQ(log.entries[static_cast<std::size_t>(i)].at, at(1'700'000'000) + microseconds(i));
  }
}

TEST(Tlog, SkipsDamageAndGoesOnBehindIt) {
  std::vector<std::uint8_t> bytes;
  append_tlog(bytes, at(1'700'000'000), heartbeat(1));
  auto const first = bytes.size();
  append_tlog(bytes, at(1'700'000'001), heartbeat(2));
  bytes[first + 12] ^= 0xFFU;
  append_tlog(bytes, at(1'700'000'002), heartbeat(3));
  auto const log = read("junk" + text_of(bytes));
  ASSERT_EQ(log.packets.size(), 2U);
  EXPECT_EQ(log.entries[0].at, at(1'700'000'000));
  EXPECT_EQ(log.entries[1].at, at(1'700'000'002));
  EXPECT_EQ(log.skipped, 4U + first);
}

TEST(Tlog, LeavesOutAHalfWrittenLastEntry) {
  std::vector<std::uint8_t> bytes;
  append_tlog(bytes, at(1'700'000'000), heartbeat(1));
  auto const whole = bytes.size();
  append_tlog(bytes, at(1'700'000'001), heartbeat(2));
  for (auto cut = whole; cut < bytes.size(); ++cut) {
    auto const log = read(text_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(cut)}));
    EXPECT_EQ(log.packets.size(), 1U) << cut;
    EXPECT_EQ(log.skipped, cut - whole);
  }
}

TEST(Tlog, IsEmptyWhereThereIsNothing) {
  EXPECT_TRUE(read("").packets.empty());
  EXPECT_EQ(read(std::string(100'000, '\xFD')).skipped, 100'000U);
}

}  // namespace
}  // namespace lapwing::mavlink
