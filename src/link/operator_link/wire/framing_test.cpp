#include "link/operator_link/wire/framing.hpp"

#include <gtest/gtest.h>

#include "link/operator_link/testing/samples.hpp"
#include "link/operator_link/wire/byte_order.hpp"

namespace lapwing::link::operator_link {
namespace {

using testing::bytes;

std::vector<std::uint8_t> three_frames() {
  std::vector<std::uint8_t> stream;
  write_frame(stream, FrameType::ping, bytes("one"));
  write_frame(stream, FrameType::bye, {});
  write_frame(stream, FrameType::data, bytes(std::string(300, 'x')));
  return stream;
}

/// Bodies of all frames, or the error's message.
std::vector<std::string> bodies(FrameReader& reader) {
  std::vector<std::string> found;
  for (;;) {
    auto const frame = reader.next();
    if (!frame) found.push_back("error: " + frame.error().message);
    if (!frame || !*frame) return found;
    found.emplace_back((*frame)->body.begin(), (*frame)->body.end());
  }
}

TEST(Framing, HasTheBytesOfTheReference) {
  std::vector<std::uint8_t> stream;
  write_frame(stream, FrameType::ping, bytes("abc"));
  // Written down in docs/reference/operator-link.md; the CRC is zlib.crc32(b"\x01\x07\x03\0\0\0abc") of Python.
  std::vector<std::uint8_t> const expected{'L', 'W', 1, 7, 3, 0, 0, 0, 0xb9, 0x8b, 0x3a, 0x00, 'a', 'b', 'c'};
  EXPECT_EQ(stream, expected);
}

TEST(Framing, IsReadWhereverTheStreamIsCut) {
  auto const stream = three_frames();
  std::vector<std::string> const expected{"one", "", std::string(300, 'x')};
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    FrameReader reader;
    reader.feed(Bytes(stream).first(cut));
    auto found = bodies(reader);
    reader.feed(Bytes(stream).subspan(cut));
    auto const rest = bodies(reader);
    found.insert(found.end(), rest.begin(), rest.end());
    ASSERT_EQ(found, expected) << "cut at " << cut;
  }
}

TEST(Framing, IsReadByteByByte) {
  FrameReader reader;
  std::vector<std::string> found;
  for (auto const byte : three_frames()) {
    reader.feed({&byte, 1});
    for (auto& body : bodies(reader)) found.push_back(std::move(body));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"one", "", std::string(300, 'x')}));
}

TEST(Framing, FindsEveryBitThatFlipped) {
  std::vector<std::uint8_t> stream;
  write_frame(stream, FrameType::data, bytes("hello"));
  for (std::size_t bit = 0; bit < stream.size() * 8; ++bit) {
    auto wrong = stream;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ (1U << (bit % 8)));
    FrameReader reader;
    reader.feed(wrong);
    auto const frame = reader.next();
    // A length that grew waits for bytes that do not come, which the silence of the far end finds.
    ASSERT_TRUE(!frame || !*frame) << "bit " << bit;
  }
}

TEST(Framing, SaysWhatIsWrong) {
  auto const message = [](std::vector<std::uint8_t> const& stream) {
    FrameReader reader;
    reader.feed(stream);
    return bodies(reader).back();
  };
  EXPECT_EQ(message(bytes("GET / HTTP/1.1")), "error: a frame begins with byte 0x47 where 0x4c belongs");
  EXPECT_EQ(message(bytes("LW\x09")), "error: frames of version 9; this program reads version 1");
  auto const too_long = std::vector<std::uint8_t>{'L', 'W', 1, 7, 0xff, 0xff, 0xff, 0x7f, 0, 0, 0, 0};
  EXPECT_EQ(message(too_long), "error: a frame of 2147483647 bytes where 1024 are allowed");
}

TEST(Framing, LetsStrangersSendLittle) {
  std::vector<std::uint8_t> stream;
  write_frame(stream, FrameType::data, std::vector<std::uint8_t>(longest_first_body + 1));
  FrameReader stranger;
  stranger.feed(stream);
  EXPECT_FALSE(stranger.next());
  FrameReader known(longest_body);
  known.feed(stream);
  EXPECT_TRUE(known.next());
}

TEST(Protocol, ReadsWhatItWrites) {
  for (auto const& speech : testing::one_of_each()) {
    std::vector<std::uint8_t> stream;
    write(stream, speech);
    FrameReader reader;
    reader.feed(stream);
    auto const frame = reader.next();
    ASSERT_TRUE(frame && *frame);
    auto const again = read(**frame);
    ASSERT_TRUE(again && *again) << again.error().message;
    EXPECT_EQ(**again, speech);
  }
}

TEST(Protocol, RefusesWhatIsCutShortOrGoesOn) {
  for (auto const& speech : testing::one_of_each()) {
    std::vector<std::uint8_t> stream;
    write(stream, speech);
    auto const type = static_cast<FrameType>(stream[3]);
    auto const body = Bytes(stream).subspan(frame_header_bytes);
    bool const ends_anywhere = type == FrameType::data;  // its text is the rest of it
    for (std::size_t size = 0; size < body.size(); ++size) {
      if (ends_anywhere && size >= 22 + std::get<Data>(speech).key.size()) break;
      EXPECT_FALSE(read({type, body.first(size)})) << "type " << static_cast<int>(type) << " of " << size << " bytes";
    }
    auto longer = std::vector<std::uint8_t>(body.begin(), body.end());
    longer.push_back(0);
    EXPECT_EQ(read({type, longer}).has_value(), ends_anywhere) << "type " << static_cast<int>(type);
  }
}

TEST(Protocol, PassesOverTypesOfLaterVersions) {
  auto const later = read({static_cast<FrameType>(200), {}});
  ASSERT_TRUE(later);
  EXPECT_FALSE(*later);
}

TEST(Protocol, ReadsTheVersionOfALaterHello) {
  Hello hello = testing::sample_hello();
  hello.version = 2;
  std::vector<std::uint8_t> stream;
  write(stream, hello);
  stream.push_back('?');
  auto const later = read({FrameType::hello, Bytes(stream).subspan(frame_header_bytes)});
  ASSERT_TRUE(later && *later);
  EXPECT_EQ(std::get<Hello>(**later).version, 2);
}

TEST(Protocol, RefusesWhatCannotBe) {
  auto const refuses = [](Speech const& speech) {
    std::vector<std::uint8_t> stream;
    write(stream, speech);
    return !read({static_cast<FrameType>(stream[3]), Bytes(stream).subspan(frame_header_bytes)});
  };
  EXPECT_TRUE(refuses(Data{static_cast<Kind>(3), 1, {}, {}, "", ""}));
  EXPECT_TRUE(refuses(Data{Kind::latest, 0, {}, {}, "", ""})) << "numbers begin with one";
  EXPECT_TRUE(refuses(Data{Kind::latest, number_limit, {}, {}, "", ""}));
  auto hello = testing::sample_hello();
  hello.lanes[0].heard = UINT64_MAX;
  EXPECT_TRUE(refuses(hello));
  EXPECT_TRUE(refuses(Ack{static_cast<Kind>(200), 1}));
  EXPECT_TRUE(refuses(Returned{Kind::command, 1, Outcome::taken}));
  EXPECT_TRUE(refuses(Ping{std::chrono::microseconds::max()}));
}

}  // namespace
}  // namespace lapwing::link::operator_link
