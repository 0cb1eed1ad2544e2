#include "mavlink/wire/frame.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "mavlink/testing/frame_bytes.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

// Packed by pymavlink: a ground station's HEARTBEAT (sequence 7), the same signed (sequence 200), and vehicle 1's
// GLOBAL_POSITION_INT and MISSION_COUNT in MAVLink 1 (sequence 9).
Data const heartbeat = {0xFD, 0x09, 0x00, 0x00, 0x07, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00,
                        0x00, 0x00, 0x00, 0x06, 0x08, 0x00, 0x04, 0x03, 0x7E, 0xFA};
Data const signed_heartbeat = {0xFD, 0x09, 0x01, 0x00, 0xC8, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00, 0x00,
                               0x00, 0x00, 0x06, 0x08, 0x00, 0x04, 0x03, 0x09, 0x52, 0x03, 0x87, 0xD6,
                               0x12, 0x00, 0x00, 0x00, 0xB2, 0x35, 0xC3, 0x13, 0x06, 0xAC};
Data const position_v1 = {0xFE, 0x1C, 0x09, 0x01, 0x01, 0x21, 0x40, 0xE2, 0x01, 0x00, 0xDE, 0x6F,
                          0x1B, 0x18, 0x02, 0xFD, 0x9A, 0xFB, 0x20, 0x83, 0x0C, 0x00, 0x74, 0x4F,
                          0x00, 0x00, 0x6A, 0xFF, 0x4B, 0x00, 0x0C, 0x00, 0x9F, 0x8C, 0x2A, 0x60};
Data const count_v1 = {0xFE, 0x04, 0x09, 0x01, 0x01, 0x2C, 0x07, 0x00, 0x01, 0x01, 0x62, 0xCA};

Data joined(std::initializer_list<Data> parts) {
  Data all;
  for (auto const& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Data text(std::string_view words) {
  return {words.begin(), words.end()};
}

std::vector<Frame> frames_of(FrameParser& parser, Data const& data) {
  std::vector<Frame> frames;
  parser.feed(data, [&](Frame const& frame) { frames.push_back(frame); });
  return frames;
}

TEST(Crc, MatchesThePublishedCheckValue) {
  // CRC-16/MCRF4XX of "123456789" in the catalogue of parametrised CRC algorithms.
  EXPECT_EQ(crc_accumulate(text("123456789")), 0x6F91);
  EXPECT_EQ(crc_accumulate({}), 0xFFFF);
}

TEST(Crc, IsTheSameInOneCallAndInPieces) {
  std::mt19937 random(1);
  Data data(100);
  for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
  auto const whole = crc_accumulate(data);
  for (std::size_t cut = 0; cut <= data.size(); ++cut) {
    auto const view = std::span<std::uint8_t const>(data);
    EXPECT_EQ(crc_accumulate(view.subspan(cut), crc_accumulate(view.first(cut))), whole) << cut;
  }
}

TEST(MessageTraits, KnowsIdsOfTheDialectAndNoOthers) {
  ASSERT_NE(find_traits(0), nullptr);
  EXPECT_EQ(find_traits(0)->crc_extra, 50);
  ASSERT_NE(find_traits(42000), nullptr) << "ICAROUS_HEARTBEAT, beyond the directly indexed ids";
  EXPECT_EQ(find_traits(42000)->crc_extra, 227);
  EXPECT_EQ(find_traits(3), nullptr);
  EXPECT_EQ(find_traits(0xFFFFFF), nullptr);
}

TEST(FrameParser, ReadsBothVersionsAndWritesTheSameBytes) {
  FrameParser parser;
  auto const frames = frames_of(parser, joined({heartbeat, position_v1, count_v1}));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].version, 2);
  EXPECT_EQ(frames[0].seq, 7);
  EXPECT_EQ(frames[0].source, (Address{255, 190}));
  EXPECT_EQ(frames[1].version, 1);
  EXPECT_EQ(frames[1].seq, 9);
  EXPECT_EQ(frames[1].source, (Address{1, 1}));
  EXPECT_EQ(frames[1].message_id, 33u);
  EXPECT_EQ(bytes_of(frames[0]), heartbeat);
  EXPECT_EQ(bytes_of(frames[1]), position_v1);
  EXPECT_EQ(bytes_of(frames[2]), count_v1);
  EXPECT_EQ(parser.counters().frames, 3u);
  EXPECT_EQ(parser.counters().junk_bytes, 0u);
}

TEST(FrameParser, KeepsTheSignature) {
  FrameParser parser;
  auto const frames = frames_of(parser, joined({signed_heartbeat, heartbeat}));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_TRUE(frames[0].is_signed());
  EXPECT_FALSE(frames[1].is_signed());
  EXPECT_EQ(bytes_of(frames[0]), signed_heartbeat);
}

TEST(FrameParser, GivesTheSameFramesHoweverTheStreamIsCut) {
  auto const stream =
      joined({text("boot"), heartbeat, position_v1, text("**\n"), signed_heartbeat, count_v1, heartbeat});
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    FrameParser parser;
    std::size_t frames = 0;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      auto const view = std::span<std::uint8_t const>(stream).subspan(at, std::min(piece, stream.size() - at));
      parser.feed(view, [&](Frame const&) { ++frames; });
    }
    EXPECT_EQ(frames, 5u) << piece;
    EXPECT_EQ(parser.counters().junk_bytes, 7u) << piece;
    EXPECT_EQ(parser.counters().crc_errors, 0u) << piece;
  }
}

TEST(FrameParser, LosesOnlyTheDamagedFrame) {
  auto damaged = position_v1;
  damaged[10] ^= 0x10;
  FrameParser parser;
  auto const frames = frames_of(parser, joined({heartbeat, damaged, count_v1}));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].message_id, 44u);
  EXPECT_GE(parser.counters().crc_errors, 1u);
}

TEST(FrameParser, FindsTheFrameThatADamagedLengthSwallowed) {
  auto damaged = heartbeat;
  damaged[1] = 60;  // claims the frames behind it as payload
  FrameParser parser;
  auto const frames = frames_of(parser, joined({damaged, count_v1, position_v1, heartbeat}));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].message_id, 44u);
  EXPECT_EQ(frames[2].message_id, 0u);
}

TEST(FrameParser, IsNotHeldUpByJunkThatLooksLikeAStart) {
  FrameParser parser;
  EXPECT_TRUE(frames_of(parser, {0xFD, 0xFF, 0x00, 0x00}).empty());
  EXPECT_EQ(frames_of(parser, heartbeat).size(), 1u)
      << "a datagram that holds a whole frame shows that the rest was junk";
  EXPECT_EQ(parser.counters().junk_bytes, 4u);
}

TEST(FrameParser, SkipsIncompatibleFrames) {
  auto unknown_flag = heartbeat;
  unknown_flag[2] = 0x02;
  FrameParser parser;
  EXPECT_EQ(frames_of(parser, joined({unknown_flag, heartbeat})).size(), 1u);
}

TEST(FrameParser, PassesOnFramesOfUnknownMessagesButNoJunk) {
  Frame frame;
  frame.message_id = 60000;  // in no dialect
  frame.payload_size = 4;
  frame.payload[3] = 9;
  auto bytes = bytes_of(frame);
  auto const header_and_payload = std::span<std::uint8_t const>(bytes).subspan(1, 13);
  std::uint8_t const seed = 77;  // known to its sender alone
  auto const checksum = crc_accumulate({&seed, 1}, crc_accumulate(header_and_payload));
  bytes[14] = static_cast<std::uint8_t>(checksum & 0xFF);
  bytes[15] = static_cast<std::uint8_t>(checksum >> 8);

  FrameParser parser;
  auto const frames = frames_of(parser, joined({bytes, heartbeat}));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].message_id, 60000u);
  EXPECT_EQ(bytes_of(frames[0]), bytes) << "it can be forwarded as it came";
  EXPECT_EQ(parser.counters().unknown_ids, 1u);
}

TEST(FrameParser, SurvivesNoiseAndStillFindsEveryFrame) {
  std::mt19937 random(7);
  FrameParser parser;
  std::size_t found = 0;
  int constexpr rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    Data noise(random() % 40);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xFD : random());
    auto const datagram = joined({noise, heartbeat});
    parser.feed(datagram, [&](Frame const& frame) { found += frame.message_id == 0 && frame.source.system == 255; });
  }
  // What noise announces as a frame is waited for, so some come late; at the end everything is flushed through.
  parser.feed(Data(600, 0), [&](Frame const& frame) { found += frame.message_id == 0 && frame.source.system == 255; });
  EXPECT_EQ(found, static_cast<std::size_t>(rounds));
}

TEST(FrameParser, ClearsWhatALongerPayloadLeft) {
  FrameParser parser;
  auto const frames = frames_of(parser, joined({position_v1, heartbeat}));
  ASSERT_EQ(frames.size(), 2u);
  for (std::size_t i = frames[1].payload_size; i < frames[1].payload.size(); ++i) EXPECT_EQ(frames[1].payload[i], 0);
}

TEST(Serialize, TrimsZerosButNeverTheFirstByte) {
  Frame frame;
  frame.message_id = 0;
  frame.payload_size = 9;
  auto const bytes = bytes_of(frame);
  EXPECT_EQ(bytes.size(), 13u);
  EXPECT_EQ(bytes[1], 1);
}

TEST(FrameParser, ShowsPacketsWhereTheyLie) {
  auto const data = joined({text("boot"), heartbeat, position_v1, signed_heartbeat});
  std::vector<Data> packets;
  FrameParser parser;
  parser.feed_views(data, [&](FrameView const& view) {
    packets.emplace_back(view.bytes.begin(), view.bytes.end());
    EXPECT_GE(view.bytes.data(), data.data()) << "nothing is copied when a packet came in one piece";
    EXPECT_LE(view.bytes.data() + view.bytes.size(), data.data() + data.size());
  });
  EXPECT_EQ(packets, (std::vector{heartbeat, position_v1, signed_heartbeat}));
}

TEST(FrameParser, ShowsPacketsThatCameInPieces) {
  auto const data = joined({heartbeat, signed_heartbeat});
  std::vector<Data> packets;
  FrameParser parser;
  for (auto const byte : data) {
    parser.feed_views(std::span(&byte, 1),
                      [&](FrameView const& view) { packets.emplace_back(view.bytes.begin(), view.bytes.end()); });
  }
  EXPECT_EQ(packets, (std::vector{heartbeat, signed_heartbeat}));
}

TEST(FrameView, TellsWhomAMessageIsFor) {
  FrameParser parser;
  std::vector<Address> targets;
  // MISSION_COUNT names its addressee, the others are for all.
  parser.feed_views(joined({heartbeat, position_v1, count_v1}),
                    [&](FrameView const& view) { targets.push_back(view.target()); });
  EXPECT_EQ(targets, (std::vector<Address>{{0, 0}, {0, 0}, {1, 1}}));
}

TEST(FrameView, TakesAnUnknownMessageAndATrimmedTargetForOneToAll) {
  FrameView const unknown{.payload = count_v1};
  EXPECT_EQ(unknown.target(), (Address{0, 0}));
  MessageTraits const* request = find_traits(43);  // MISSION_REQUEST_LIST
  ASSERT_NE(request, nullptr);
  std::uint8_t const system_only[] = {7};
  FrameView const trimmed{.payload = system_only, .traits = request};
  EXPECT_EQ(trimmed.target(), (Address{7, 0}));
}

TEST(MessageTraits, KnowsWhichFieldTellsInstancesApart) {
  MessageTraits const* battery = find_traits(147);  // BATTERY_STATUS: id, behind its longer fields
  ASSERT_NE(battery, nullptr);
  EXPECT_EQ(battery->instance_at, 32);
  EXPECT_EQ(battery->instance_size, 1);
  MessageTraits const* value = find_traits(251);  // NAMED_VALUE_FLOAT: its name
  ASSERT_NE(value, nullptr);
  EXPECT_EQ(value->instance_at, 8);
  EXPECT_EQ(value->instance_size, 10);
  MessageTraits const* traffic = find_traits(246);  // ADSB_VEHICLE: the aircraft's address
  ASSERT_NE(traffic, nullptr);
  EXPECT_EQ(traffic->instance_size, 4);
  EXPECT_EQ(find_traits(0)->instance_at, no_field);
}

}  // namespace
}  // namespace lapwing::mavlink
