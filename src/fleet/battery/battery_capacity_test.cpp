#include "fleet/battery/battery_capacity.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

/// Draws 5 Ah batteries by `step_ah` a report, from what has been drawn at first to what has been at last.
void draw(BatteryCapacity& capacity, double from_ah, double to_ah, double step_ah, bool counts_from_full,
          double drawn_before_ah = 0.0) {
  auto const reports = static_cast<int>(std::floor((to_ah - from_ah) / step_ah + 1e-6));
  for (int report = 0; report <= reports; ++report) {
    double const drawn = from_ah + report * step_ah;
    double const left = 1.0 - (drawn + drawn_before_ah) / 5.0;
    capacity.add(std::floor(left * 100.0 + 1e-6) / 100.0, drawn, counts_from_full);
  }
}

TEST(BatteryCapacity, SaysNothingBeforeThePercentsFell) {
  BatteryCapacity capacity;
  capacity.add(1.0, 0.0, true);
  capacity.add(1.0, 0.01, true);
  EXPECT_FALSE(capacity.value());
}

TEST(BatteryCapacity, IsNearAfterThreePercentAndSaysHowNear) {
  BatteryCapacity capacity;
  draw(capacity, 0.0, 0.16, 0.009, true);
  auto const value = capacity.value();
  ASSERT_TRUE(value);
  EXPECT_NEAR(value->ah, 5.0, value->error * 5.0);
  EXPECT_LT(value->error, 0.15);
}

TEST(BatteryCapacity, IsKnownToAHundredthInTheEnd) {
  BatteryCapacity capacity;
  draw(capacity, 0.0, 3.0, 0.009, true);
  ASSERT_TRUE(capacity.value());
  EXPECT_NEAR(capacity.value()->ah, 5.0, 0.05);
  EXPECT_LT(capacity.value()->error, 0.02);
}

TEST(BatteryCapacity, DoesNotTakeAHalfEmptyBatteryForASmallOne) {
  for (bool const counts_from_full : {false, true}) {
    BatteryCapacity capacity;
    draw(capacity, 0.0, 0.5, 0.009, counts_from_full, 2.0);  // it counts from 60 % on
    ASSERT_TRUE(capacity.value());
    EXPECT_NEAR(capacity.value()->ah, 5.0, 0.3);
  }
}

TEST(BatteryCapacity, BeginsAnewWithAnotherBattery) {
  BatteryCapacity capacity;
  draw(capacity, 0.0, 1.0, 0.009, true);
  capacity.add(1.0, 0.0, true);
  EXPECT_FALSE(capacity.value());
}

}  // namespace
}  // namespace lapwing::fleet
