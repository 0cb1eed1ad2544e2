#include "vehicle/energy/drain_meter.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::vehicle {
namespace {

using namespace std::chrono_literals;

/// A battery that tells whole percents twice a second.
struct Battery {
  DrainMeter drain;
  double charge = 0.8;
  base::TimePoint now{};
  std::optional<Drain> known;

  void fly(double seconds, double per_s) { pass(seconds, per_s, true); }
  void stand(double seconds, double per_s) { pass(seconds, per_s, false); }
  void pass(double seconds, double per_s, bool is_under_way) {
    for (auto const end = now + base::from_seconds(seconds); now < end; now += 500ms) {
      charge -= 0.5 * per_s;
      known = drain.add(std::floor(100.0 * charge) / 100.0, is_under_way, now);
    }
  }
};

constexpr double in_twenty_minutes = 1.0 / 1200.0;

TEST(DrainMeter, IsKnownWhenThreeWholePercentsHaveBeenFlown) {
  Battery battery;
  battery.fly(30.0, in_twenty_minutes);
  EXPECT_FALSE(battery.known);
  battery.fly(25.0, in_twenty_minutes);
  ASSERT_TRUE(battery.known);
  EXPECT_NEAR(battery.known->per_s, in_twenty_minutes, 0.05 * in_twenty_minutes);
  EXPECT_LT(battery.known->error, 0.1);
}

TEST(DrainMeter, OnTheGroundIsNoneOfFlying) {
  Battery battery;
  battery.stand(200.0, 0.001);
  EXPECT_FALSE(battery.known);
}

TEST(DrainMeter, FollowsAChangeWithinMinutes) {
  Battery battery;
  battery.fly(200.0, in_twenty_minutes);
  battery.fly(200.0, 1.5 * in_twenty_minutes);
  EXPECT_NEAR(battery.known->per_s, 1.5 * in_twenty_minutes, 0.1 * in_twenty_minutes);
}

TEST(DrainMeter, IsTheLessSureTheMoreItsPartsDiffer) {
  Battery even;
  even.fly(150.0, in_twenty_minutes);
  Battery uneven;
  for (int i = 0; i < 5; ++i) {
    uneven.fly(15.0, 1.6 * in_twenty_minutes);
    uneven.fly(15.0, 0.4 * in_twenty_minutes);
  }
  ASSERT_TRUE(even.known && uneven.known);
  EXPECT_GT(uneven.known->error, 2.0 * even.known->error);
  EXPECT_LE(uneven.known->error, 1.0);
  EXPECT_NEAR(uneven.known->per_s, in_twenty_minutes, 0.25 * in_twenty_minutes);
}

TEST(DrainMeter, OfTheLastFlightIsWhatTheNextBeginsWith) {
  Battery battery;
  battery.fly(100.0, in_twenty_minutes);
  battery.stand(60.0, 0.0);
  battery.charge = 1.0;
  battery.fly(5.0, in_twenty_minutes);
  ASSERT_TRUE(battery.known);
  EXPECT_GE(battery.known->error, 0.25);
  EXPECT_NEAR(battery.known->per_s, in_twenty_minutes, 0.05 * in_twenty_minutes);
  battery.fly(60.0, 2.0 * in_twenty_minutes);
  EXPECT_NEAR(battery.known->per_s, 2.0 * in_twenty_minutes, 0.1 * in_twenty_minutes);
}

TEST(DrainMeter, OfABatteryThatIsSilentStaysAsItWas) {
  Battery battery;
  battery.fly(100.0, in_twenty_minutes);
  auto const before = battery.known->per_s;
  EXPECT_EQ(battery.drain.add(std::nullopt, true, battery.now + 30s)->per_s, before);
}

TEST(DrainMeter, LearnsNothingFromACellThatGivesInForAMoment) {
  Battery battery;
  battery.fly(100.0, in_twenty_minutes);
  auto const before = battery.known->per_s;
  battery.charge -= 0.4;
  battery.fly(3.0, in_twenty_minutes);
  battery.charge += 0.4;
  battery.fly(100.0, in_twenty_minutes);
  EXPECT_NEAR(battery.known->per_s, before, 0.1 * before);
  EXPECT_LT(battery.known->error, 0.3);
}

TEST(DrainMeter, FallsWhenTheNextPercentDoesNotCome) {
  Battery battery;
  battery.fly(100.0, in_twenty_minutes);
  battery.fly(60.0, 0.0);
  EXPECT_LT(battery.known->per_s, 0.8 * in_twenty_minutes);
}

}  // namespace
}  // namespace lapwing::vehicle
