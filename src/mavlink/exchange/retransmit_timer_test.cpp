#include "mavlink/exchange/internal/retransmit_timer.hpp"

#include <gtest/gtest.h>

namespace lapwing::mavlink::internal {
namespace {

using namespace std::chrono_literals;

TEST(RetransmitTimer, BeginsWithWhatTheLinkIsKnownToTake) {
  EXPECT_EQ(RetransmitTimer(500ms, std::nullopt).value(), 500ms);
  EXPECT_EQ(RetransmitTimer(500ms, 100ms).value(), 400ms);  // two round trips and an autopilot's turn
  EXPECT_EQ(RetransmitTimer(500ms, 2s).value(), 500ms);
}

TEST(RetransmitTimer, FollowsWhatIsMeasured) {
  RetransmitTimer timer(500ms, std::nullopt);
  timer.measured(100ms);
  EXPECT_EQ(timer.value(), 300ms);  // RFC 6298, section 2.2: R + 4 * R / 2
  for (int i = 0; i < 100; ++i) timer.measured(100ms);
  EXPECT_NEAR(base::to_seconds(timer.value()), 0.1, 1e-3);
  for (int i = 0; i < 100; ++i) timer.measured(1ms);
  EXPECT_EQ(timer.value(), 50ms) << "an autopilot looks into its link only so often";
}

TEST(RetransmitTimer, WaitsLongerForEachRepetitionUpToALimit) {
  RetransmitTimer unknown(500ms, std::nullopt);
  unknown.repeated();
  EXPECT_EQ(unknown.value(), 1s);
  for (int i = 0; i < 9; ++i) unknown.repeated();
  EXPECT_EQ(unknown.value(), 1500ms);

  RetransmitTimer known(500ms, std::nullopt);
  known.measured(100ms);
  for (int i = 0; i < 9; ++i) known.repeated();
  EXPECT_EQ(known.value(), 1200ms) << "one small message at a time congests nothing";
  known.moved_on();
  EXPECT_EQ(known.value(), 600ms);
  known.measured(100ms);
  EXPECT_LT(known.value(), 300ms);
}

TEST(Smoothed, TellsWhatHardlyAnySampleExceeds) {
  Smoothed time;
  EXPECT_FALSE(time.is_measured());
  for (int i = 0; i < 200; ++i) time.add(i % 2 == 0 ? 90ms : 110ms);
  EXPECT_NEAR(time.mean_s(), 0.1, 0.005);
  EXPECT_GT(time.bound(), 120ms);
  EXPECT_LT(time.bound(), 160ms);
}

}  // namespace
}  // namespace lapwing::mavlink::internal
