#include "fleet/battery_time.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

/// One percent every `step`, reported every second.
std::optional<base::Duration> discharged(BatteryTime& battery, double from, double to, base::Duration step,
                                         base::Duration start = 0s) {
  std::optional<base::Duration> left;
  int const steps = static_cast<int>((from - to) * 100.0 + 0.5);
  for (base::Duration time = 0s; time <= steps * step; time += 1s)
    left = battery.add(from - 0.01 * static_cast<double>(time / step), at(start + time));
  return left;
}

TEST(BatteryTime, SaysNothingBeforeTheChargeHasFallen) {
  BatteryTime battery;
  EXPECT_FALSE(battery.add(0.9, at(0s)));
  EXPECT_FALSE(battery.add(0.9, at(600s)));
  EXPECT_FALSE(battery.add(0.89, at(610s)));
  EXPECT_FALSE(battery.add(0.88, at(620s)));
}

TEST(BatteryTime, DividesWhatIsLeftByTheSpeedOfTheFall) {
  BatteryTime battery;
  auto const left = discharged(battery, 1.0, 0.9, 12s);  // 20 minutes for the whole pack
  ASSERT_TRUE(left);
  EXPECT_NEAR(base::to_seconds(*left), 0.9 * 1200.0, 20.0);
}

TEST(BatteryTime, FollowsAChangeOfPaceWithinFivePercent) {
  BatteryTime battery;
  (void)discharged(battery, 1.0, 0.9, 60s);
  auto const left = discharged(battery, 0.9, 0.84, 6s, 600s);
  ASSERT_TRUE(left);
  EXPECT_NEAR(base::to_seconds(*left), 0.84 * 600.0, 40.0);
}

TEST(BatteryTime, GrowsWhileNothingIsDrawn) {
  BatteryTime battery;
  auto const flying = discharged(battery, 1.0, 0.9, 6s);
  auto const landed = battery.add(0.9, at(60s + 10min));
  ASSERT_TRUE(flying && landed);
  EXPECT_GT(*landed, 5 * *flying);
}

TEST(BatteryTime, BeginsAnewWithAFullerBattery) {
  BatteryTime battery;
  ASSERT_TRUE(discharged(battery, 0.5, 0.4, 6s));
  EXPECT_FALSE(battery.add(1.0, at(100s)));
}

TEST(BatteryTime, IsZeroForAnEmptyBattery) {
  BatteryTime battery;
  EXPECT_EQ(discharged(battery, 0.05, 0.0, 6s).value_or(1h), 0s);
}

}  // namespace
}  // namespace lapwing::fleet
