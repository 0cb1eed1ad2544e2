#include "fleet/message_rates.hpp"

#include <array>

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

constexpr auto position = mavlink::MessageId::global_position_int;
constexpr auto attitude = mavlink::MessageId::attitude;
std::array<WantedMessage, 2> const wanted{WantedMessage{position, 250ms}, WantedMessage{attitude, 500ms}};

std::span<WantedMessage const> const position_only(wanted.data(), 1);

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

std::vector<mavlink::MessageId> ids(std::vector<WantedMessage> const& messages) {
  std::vector<mavlink::MessageId> result;
  for (auto const& message : messages) result.push_back(message.id);
  return result;
}

void hear(MessageRates& rates, mavlink::MessageId id, int times) {
  for (int i = 0; i < times; ++i) rates.arrived(id);
}

TEST(MessageRates, LooksBeforeItAsks) {
  MessageRates rates(wanted, at(0s));
  EXPECT_TRUE(rates.due(at(1s)).empty());
}

TEST(MessageRates, AsksOnlyForWhatIsMissing) {
  MessageRates rates(wanted, at(0s));
  hear(rates, position, 8);
  EXPECT_EQ(ids(rates.due(at(2s))), std::vector{attitude});
}

TEST(MessageRates, AsksForWhatComesTooSlowly) {
  MessageRates rates(wanted, at(0s));
  hear(rates, position, 3);
  hear(rates, attitude, 4);
  EXPECT_EQ(ids(rates.due(at(2s))), std::vector{position});
}

TEST(MessageRates, AsksAgainAfterGrowingPausesWhileNothingComes) {
  MessageRates rates(position_only, at(0s));
  std::vector<int> asked_at;
  for (int second = 0; second <= 200; ++second)
    if (!rates.due(at(second * 1s)).empty()) asked_at.push_back(second);
  EXPECT_EQ(asked_at, (std::vector{2, 4, 8, 16, 32, 64, 124, 184}));
}

TEST(MessageRates, NoticesThatAMessageStopped) {
  MessageRates rates(position_only, at(0s));
  hear(rates, position, 8);
  EXPECT_TRUE(rates.due(at(2s)).empty());
  EXPECT_EQ(ids(rates.due(at(4s))), std::vector{position});
}

TEST(MessageRates, LeavesAVehicleInPeaceThatSaidNo) {
  MessageRates rates(position_only, at(0s));
  EXPECT_FALSE(rates.due(at(2s)).empty());
  rates.denied(position, at(2s));
  EXPECT_TRUE(rates.due(at(4min)).empty());
  EXPECT_FALSE(rates.due(at(6min)).empty());
}

TEST(MessageRates, AsksARestartedVehicleAnew) {
  MessageRates rates(position_only, at(0s));
  rates.denied(position, at(1s));
  rates.restart(at(10s));
  EXPECT_EQ(ids(rates.due(at(12s))), std::vector{position});
}

}  // namespace
}  // namespace lapwing::fleet
