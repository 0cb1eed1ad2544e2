// Back-pressure: a far end that takes little, and the queue before it.
#include "link/internal/stream.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>

#include <gtest/gtest.h>

namespace lapwing::link::internal {
namespace {

using namespace std::chrono_literals;
using Packet = std::vector<std::uint8_t>;

/// Packets that tell where they begin and end: a length, and so many times the same letter.
Packet packet(char letter, std::size_t size = 100) {
  Packet bytes(size, static_cast<std::uint8_t>(letter));
  bytes[0] = static_cast<std::uint8_t>(size);
  return bytes;
}

/// The letters of the whole packets in `bytes`; '!' for one that was cut or mixed.
std::string letters_in(std::string const& bytes) {
  std::string letters;
  for (std::size_t at = 0; at < bytes.size();) {
    auto const size = static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
    if (size < 2 || at + size > bytes.size()) return letters + '!';
    char const letter = bytes[at + 1];
    for (std::size_t i = 1; i < size; ++i)
      if (bytes[at + i] != letter) return letters + '!';
    letters += letter;
    at += size;
  }
  return letters;
}

base::TimePoint constexpr start{};

std::string drained(SendQueue& queue, std::size_t step) {
  std::string bytes;
  for (auto front = queue.front(start); !front.empty(); front = queue.front(start)) {
    auto const size = std::min(step, front.size());
    bytes.append(front.begin(), front.begin() + static_cast<std::ptrdiff_t>(size));
    queue.pop(size);
  }
  return letters_in(bytes);
}

TEST(SendQueue, LetsCommandsGoBeforeTelemetry) {
  SendQueue queue({});
  for (char const letter : {'a', 'b'}) EXPECT_TRUE(queue.push(packet(letter), Urgency::perishable, start));
  for (char const letter : {'C', 'D'}) EXPECT_TRUE(queue.push(packet(letter), Urgency::prompt, start));
  EXPECT_EQ(queue.bytes(), 400u);
  EXPECT_EQ(drained(queue, 7), "CDab");
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(SendQueue, FinishesThePacketThatHasBegun) {
  SendQueue queue({});
  ASSERT_TRUE(queue.push(packet('a'), Urgency::perishable, start));
  auto const begun = queue.front(start);
  std::string bytes(begun.begin(), begun.begin() + 30);
  queue.pop(30);
  ASSERT_TRUE(queue.push(packet('C'), Urgency::prompt, start));
  for (auto front = queue.front(start); !front.empty(); front = queue.front(start)) {
    bytes.append(front.begin(), front.end());
    queue.pop(front.size());
  }
  EXPECT_EQ(letters_in(bytes), "aC");
}

TEST(SendQueue, DropsTheOldestTelemetryAndCountsIt) {
  SendQueue queue({.all_bytes = 1000, .perishable_bytes = 300});
  for (char const letter : {'a', 'b', 'c', 'd', 'e'})
    EXPECT_TRUE(queue.push(packet(letter), Urgency::perishable, start));
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(drained(queue, 100), "cde");
}

TEST(SendQueue, DropsTelemetryForCommandsAndRefusesThemAtLast) {
  SendQueue queue({.all_bytes = 500, .perishable_bytes = 300});
  for (char const letter : {'a', 'b', 'c'}) EXPECT_TRUE(queue.push(packet(letter), Urgency::perishable, start));
  for (char const letter : {'A', 'B', 'C', 'D', 'E'}) EXPECT_TRUE(queue.push(packet(letter), Urgency::prompt, start));
  EXPECT_EQ(queue.dropped(), 3u);
  EXPECT_FALSE(queue.push(packet('F'), Urgency::prompt, start));
  EXPECT_FALSE(queue.push(packet('f'), Urgency::perishable, start));
  EXPECT_EQ(drained(queue, 100), "ABCDE");
}

TEST(SendQueue, SendsNothingThatHasWaitedForSeconds) {
  SendQueue queue({.wait = 3s});
  EXPECT_TRUE(queue.push(packet('b'), Urgency::prompt, start));
  auto const begun = queue.front(start);
  std::string bytes(begun.begin(), begun.begin() + 30);
  queue.pop(30);
  for (auto const urgency : {Urgency::urgent, Urgency::prompt, Urgency::perishable})
    EXPECT_TRUE(queue.push(packet('o'), urgency, start));
  EXPECT_TRUE(queue.push(packet('n'), Urgency::prompt, start + 2s));
  auto const later = start + 4s;
  for (auto front = queue.front(later); !front.empty(); front = queue.front(later)) {
    bytes.append(front.begin(), front.end());
    queue.pop(front.size());
  }
  EXPECT_EQ(letters_in(bytes), "bn") << "what has begun is finished, what is old is gone";
  EXPECT_EQ(queue.dropped(), 3u);
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(SendQueue, LetsAStopGoBeforeEverythingAndMakesRoomForIt) {
  SendQueue queue({.all_bytes = 500, .perishable_bytes = 300});
  EXPECT_TRUE(queue.push(packet('a'), Urgency::perishable, start));
  for (char const letter : {'A', 'B', 'C', 'D', 'E'}) EXPECT_TRUE(queue.push(packet(letter), Urgency::prompt, start));
  EXPECT_TRUE(queue.push(packet('1'), Urgency::urgent, start));
  EXPECT_TRUE(queue.push(packet('2'), Urgency::urgent, start));
  EXPECT_EQ(queue.dropped(), 3u) << "telemetry, then the oldest of what is prompt";
  EXPECT_FALSE(queue.push(packet('F'), Urgency::prompt, start));
  EXPECT_EQ(drained(queue, 100), "12CDE");
}

base::Task<void> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

std::string read_all(int descriptor) {
  std::string bytes;
  std::array<char, 65536> buffer;
  for (auto got = ::read(descriptor, buffer.data(), buffer.size()); got > 0;
       got = ::read(descriptor, buffer.data(), buffer.size()))
    bytes.append(buffer.data(), static_cast<std::size_t>(got));
  return bytes;
}

TEST(Stream, KeepsCommandsMovingWhenNobodyReads) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  LinkCounters counters;
  Stream stream(
      loop, {.descriptor = ends[0], .bytes_per_s = 5760.0}, counters, [](Bytes) {}, [](std::string const&) {});
  std::uint64_t taken = 0;
  for (int i = 0; i < 5000; ++i) {
    taken += stream.send(packet(static_cast<char>('a' + i % 26)), Urgency::perishable);
    if (i % 100 == 0) loop.run_until_done(pass(loop, 1ms));
  }
  EXPECT_EQ(taken, 5000u) << "the newest always gets in";
  EXPECT_GT(counters.perishable_dropped, 3000u);
  EXPECT_LE(counters.bytes_queued, 5760u + 100u) << "a second of the line, and what is on its way";
  for (char const letter : {'A', 'B', 'C'}) EXPECT_TRUE(stream.send(packet(letter), Urgency::prompt));

  std::string heard;
  for (int i = 0; i < 5000 && counters.bytes_queued > 0; ++i) {
    heard += read_all(ends[1]);
    loop.run_until_done(pass(loop, 10ms));
  }
  heard += read_all(ends[1]);
  auto const letters = letters_in(heard);
  EXPECT_EQ(letters.find('!'), std::string::npos) << "no packet was cut";
  EXPECT_EQ(letters.size() + counters.perishable_dropped, 5003u) << "every drop is counted";
  auto const commands = letters.find("ABC");
  ASSERT_NE(commands, std::string::npos);
  EXPECT_GT(letters.size() - commands, 30u) << "they overtook the telemetry that waited";
  ::close(ends[1]);
}

/// 9600 baud is the slowest line that flies.
TEST(Stream, KeepsNoMoreThanTwoSecondsOfASlowLine) {
  for (double const bytes_per_s : {960.0, 5760.0, 92'160.0}) {
    base::Loop loop(base::Loop::Pace{.unpaced = true});
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
    LinkCounters counters;
    Stream stream(
        loop, {.descriptor = ends[0], .bytes_per_s = bytes_per_s}, counters, [](Bytes) {}, [](std::string const&) {});
    int taken = 0;
    while (stream.send(packet('p'), Urgency::prompt) && taken < 10'000) {
      ++taken;
      if (taken % 10 == 0) loop.run_until_done(pass(loop, 1ms));
    }
    EXPECT_LE(counters.bytes_queued, 2.0 * bytes_per_s) << bytes_per_s;
    EXPECT_GT(counters.bytes_queued, 1.5 * bytes_per_s) << bytes_per_s;
    EXPECT_TRUE(stream.send(packet('s'), Urgency::urgent)) << "a stop always gets in";
    ::close(ends[1]);
  }
}

TEST(Stream, LeavesLittleInTheKernelOfASlowPeer) {
  base::Loop loop(base::Loop::Pace{.unpaced = true});
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  LinkCounters counters;
  Stream stream(loop, {.descriptor = ends[0]}, counters, [](Bytes) {}, [](std::string const&) {});
  for (int i = 0; i < 5000; ++i) stream.send(packet('t'), Urgency::perishable);
  EXPECT_LE(counters.bytes_sent, 64u * 1024u) << "what the kernel took";
  EXPECT_LE(counters.bytes_queued, 65u * 1024u);
  EXPECT_EQ(counters.bytes_sent + counters.bytes_queued + 100 * counters.perishable_dropped, 500'000u);
  ::close(ends[1]);
}

TEST(Stream, TellsOnceThatTheFarEndIsGone) {
  base::Loop loop;
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  LinkCounters counters;
  std::vector<std::string> reasons;
  Stream stream(
      loop, {.descriptor = ends[0]}, counters, [](Bytes) {}, [&](std::string const& why) { reasons.push_back(why); });
  ::close(ends[1]);
  loop.run_until_done(pass(loop, 20ms));
  EXPECT_FALSE(stream.send(packet('a'), Urgency::prompt));
  EXPECT_EQ(reasons, std::vector<std::string>{"closed by the far end"});
  EXPECT_EQ(counters.send_failures, 1u);
}

}  // namespace
}  // namespace lapwing::link::internal
