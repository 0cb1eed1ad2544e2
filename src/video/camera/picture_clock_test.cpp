#include "video/camera/picture_clock.hpp"

#include <gtest/gtest.h>

namespace lapwing::video {
namespace {

using namespace std::chrono_literals;

base::UtcTime const noon = base::UtcTime(std::chrono::days(20'000));

TEST(PictureClock, APictureThatWaitedOnItsWayIsNotTakenForYounger) {
  PictureClock clock;
  EXPECT_EQ(clock.taken(5s, noon), noon);
  auto const late = clock.taken(6s, noon + 1s + 300ms);
  EXPECT_NEAR(base::to_seconds(late - noon), 1.0, 0.001);
  auto const next = clock.taken(6100ms, noon + 1s + 310ms);
  EXPECT_NEAR(base::to_seconds(next - noon), 1.1, 0.001);
}

TEST(PictureClock, TheOneThatCameTheSoonestTellsWhereTheStreamBegins) {
  PictureClock clock;
  EXPECT_EQ(clock.taken(0s, noon + 400ms), noon + 400ms);  // the first had waited
  EXPECT_EQ(clock.taken(1s, noon + 1s), noon + 1s);
  EXPECT_NEAR(base::to_seconds(clock.taken(2s, noon + 2s + 400ms) - noon), 2.0, 0.001);
}

TEST(PictureClock, FollowsASourceWhoseClockIsSlow) {
  PictureClock clock;
  base::UtcTime taken;
  for (auto position = 0s; position <= 3600s; position += 1s)
    taken = clock.taken(position, noon + position + 50us * position.count());
  EXPECT_NEAR(base::to_seconds(taken - noon), 3600.0 + 0.18, 0.01);
}

TEST(PictureClock, ASourceThatDoesNotTellHasTheTimeOfArrival) {
  PictureClock clock;
  EXPECT_EQ(clock.taken(0s, noon), noon);
  EXPECT_EQ(clock.taken(0s, noon + 70ms), noon + 70ms);
  EXPECT_EQ(clock.taken(0s, noon + 90ms), noon + 90ms);
}

TEST(PictureClock, ASourceThatStoodStillOrBeganAnewIsFollowed) {
  PictureClock clock;
  EXPECT_EQ(clock.taken(10s, noon), noon);
  EXPECT_EQ(clock.taken(10s + 100ms, noon + 60s), noon + 60s);
  EXPECT_EQ(clock.taken(0s, noon + 61s), noon + 61s);
}

}  // namespace
}  // namespace lapwing::video
