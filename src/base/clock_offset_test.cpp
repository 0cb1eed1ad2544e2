#include "base/clock_offset.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

TimePoint at(Duration since) {
  return TimePoint(since);
}

TEST(ClockOffset, LaysWhatWasHeldUpWhereItWasMeasured) {
  ClockOffset clock;
  EXPECT_EQ(clock.here(100ms, at(5s)), at(5s)) << "the first is as late as any that is known";
  EXPECT_EQ(clock.here(200ms, at(5s + 130ms)), at(5s + 100ms)) << "thirty milliseconds late";
  EXPECT_EQ(clock.here(300ms, at(5s + 190ms)), at(5s + 190ms)) << "sooner than ever: the others were late";
  EXPECT_EQ(clock.here(400ms, at(5s + 300ms)), at(5s + 290ms));
}

TEST(ClockOffset, FollowsClocksThatGoApart) {
  ClockOffset clock;
  TimePoint last;
  for (int i = 0; i < 1000; ++i) last = clock.here(i * 100ms, at(i * 100ms + i * 10us));
  EXPECT_GE(last, at(999 * 100ms + 9ms - 3ms)) << "not by what was so a minute ago";
}

TEST(ClockOffset, BeginsAnewWhenTheOtherClockDoes) {
  ClockOffset clock;
  (void)clock.here(100s, at(5s));
  EXPECT_EQ(clock.here(1s, at(6s)), at(6s)) << "the far end was switched off and on";
  (void)clock.here(500s, at(7s));
  EXPECT_EQ(clock.here(501s, at(8s)), at(8s)) << "the far end's clock was set ahead";
}

}  // namespace
}  // namespace lapwing::base
