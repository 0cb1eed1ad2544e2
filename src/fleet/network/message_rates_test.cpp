#include "fleet/network/message_rates.hpp"

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
  EXPECT_TRUE(rates.due(at(900ms)).empty());
}

TEST(MessageRates, AsksSoonForWhatShouldComeOften) {
  std::array<WantedMessage, 2> const some{WantedMessage{position, 200ms}, WantedMessage{attitude, 1s}};
  MessageRates rates(some, at(0s));
  EXPECT_EQ(ids(rates.due(at(1s))), std::vector{position});
  EXPECT_EQ(ids(rates.due(at(2s))), std::vector{attitude});
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
  EXPECT_EQ(asked_at, (std::vector{1, 3, 7, 15, 31, 63, 123, 183}));
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

TEST(MessageRates, RemembersWhatWasBeforeTheFirstChangeOnly) {
  MessageRates rates(wanted, at(0s));
  EXPECT_TRUE(rates.changes().empty());
  rates.changed(wanted[0], std::optional<base::Duration>(1s));
  rates.changed({position, 500ms}, std::optional<base::Duration>(250ms));
  rates.changed(wanted[1], std::nullopt);  // it did not tell
  ASSERT_EQ(rates.changes().size(), 1u);
  EXPECT_EQ(rates.changes()[0].before, 1s);
  EXPECT_EQ(rates.changes()[0].set, 500ms);
  EXPECT_TRUE(rates.is_ours(attitude));
  rates.restart(at(10s));
  EXPECT_TRUE(rates.changes().empty());
  EXPECT_FALSE(rates.is_ours(attitude));
}

TEST(MessageRates, WantsLessOnASlowLinkOfWhatMayWait) {
  std::array<WantedMessage, 2> const some{WantedMessage{position, 250ms, true}, WantedMessage{attitude, 500ms}};
  MessageRates rates(some, at(0s));
  rates.changed(some[0], std::optional<base::Duration>());
  rates.changed(some[1], std::optional<base::Duration>());
  hear(rates, position, 8);
  hear(rates, attitude, 4);
  EXPECT_TRUE(rates.due(at(2s)).empty());
  hear(rates, position, 2);
  rates.set_telemetry_rate(4, at(2500ms));
  auto const asks = rates.due(at(2500ms));
  ASSERT_EQ(ids(asks), std::vector{position});
  EXPECT_EQ(asks[0].interval, 1s);
  rates.changed(asks[0], std::nullopt);
  hear(rates, position, 3);
  hear(rates, attitude, 8);
  EXPECT_TRUE(rates.due(at(6s)).empty());
  rates.set_telemetry_rate(1, at(7s));
  EXPECT_EQ(rates.due(at(7s))[0].interval, 250ms);
}

TEST(MessageRates, GivesUpOnWhatIsOnlyShownWhenItNeverComes) {
  std::array<WantedMessage, 1> const shown{WantedMessage{position, 250ms, true}};
  MessageRates rates(shown, at(0s));
  std::vector<int> asked_at;
  for (int second = 0; second <= 200; ++second)
    if (!rates.due(at(second * 1s)).empty()) asked_at.push_back(second);
  EXPECT_EQ(asked_at, (std::vector{1, 3, 7, 15}));
}

}  // namespace
}  // namespace lapwing::fleet
