#include "route/duplicates.hpp"

#include <gtest/gtest.h>

#include "route/test_packets.hpp"

namespace lapwing::route {
namespace {

using namespace std::chrono_literals;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

TEST(Duplicates, FindsACopyThatCameOverAnotherLink) {
  Duplicates duplicates;
  auto const first = packet("ATTITUDE", {.seq = 7});
  EXPECT_FALSE(duplicates.is_copy(first.view(), 0, at(1s)));
  EXPECT_TRUE(duplicates.is_copy(first.view(), 1, at(1900ms))) << "a slow radio";
  EXPECT_FALSE(duplicates.is_copy(packet("ATTITUDE", {.seq = 8}).view(), 1, at(2s)));
  EXPECT_FALSE(duplicates.is_copy(packet("ATTITUDE", {.source = {2, 1}, .seq = 7}).view(), 1, at(2s)));
}

TEST(Duplicates, TakesTheSameAfterAWhileForNew) {
  Duplicates duplicates;
  auto const beat = packet("HEARTBEAT");
  EXPECT_FALSE(duplicates.is_copy(beat.view(), 0, at(0s)));
  EXPECT_FALSE(duplicates.is_copy(beat.view(), 1, at(2s)));
}

TEST(Duplicates, LetsASenderRepeatItselfWhoseSequenceStandsStill) {
  Duplicates duplicates;
  auto const sticks = packet("RC_CHANNELS_OVERRIDE", {.source = {255, 190}, .target = {1, 1}});
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(duplicates.is_copy(sticks.view(), 3, at(i * 100ms))) << i;
  EXPECT_TRUE(duplicates.is_copy(sticks.view(), 3, at(1910ms))) << "but not that fast: the network doubled it";
}

TEST(Duplicates, LetsTheSameComeInTheNextRoundOfNumbers) {
  Duplicates duplicates;
  // 256 messages in a millisecond, every one with the same content: of the second round none is a copy.
  for (int round = 0; round < 2; ++round) {
    for (int seq = 0; seq < 256; ++seq) {
      auto const beat = packet("HEARTBEAT", {.seq = static_cast<std::uint8_t>(seq)});
      EXPECT_FALSE(duplicates.is_copy(beat.view(), static_cast<std::uint16_t>(round), at(1ms))) << round << " " << seq;
    }
  }
}

TEST(Duplicates, TakesWhatSourcesBeyondItsMemorySendForNew) {
  Duplicates duplicates;
  for (std::size_t i = 0; i < Duplicates::max_sources; ++i) {
    Address const source{static_cast<std::uint8_t>(1 + i / 200), static_cast<std::uint8_t>(i % 200)};
    EXPECT_FALSE(duplicates.is_copy(packet("HEARTBEAT", {.source = source}).view(), 0, at(0s)));
  }
  auto const late = packet("HEARTBEAT", {.source = {200, 1}});
  EXPECT_FALSE(duplicates.is_copy(late.view(), 0, at(0s)));
  EXPECT_FALSE(duplicates.is_copy(late.view(), 1, at(0s)));
  EXPECT_TRUE(duplicates.is_copy(packet("HEARTBEAT", {.source = {1, 0}}).view(), 1, at(0s)));
}

}  // namespace
}  // namespace lapwing::route
