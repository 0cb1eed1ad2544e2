#include "autonomy/energy/reserve.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lapwing::autonomy {
namespace {

double constexpr nan = std::numeric_limits<double>::quiet_NaN();
/// A full charge in twenty minutes.
vehicle::Drain constexpr twenty_minutes{.per_s = 1.0 / 1200.0};

TEST(Reserve, IsTheFixedFigureAsLongAsConsumptionIsNotKnown) {
  EXPECT_EQ(reserve(WayHome{500, 10, 10}, std::nullopt, {}), 0.20);
  EXPECT_EQ(reserve(WayHome{500, 10, 10}, vehicle::Drain{.per_s = 0.0}, {}), 0.20);
  EXPECT_EQ(reserve(WayHome{500, 10, 10}, vehicle::Drain{.per_s = nan}, {}), 0.20);
  EXPECT_EQ(reserve(WayHome{500, 10, 10}, vehicle::Drain{.per_s = 0.001, .error = nan}, {}), 0.20);
}

TEST(Reserve, IsTheFixedFigureAsLongAsTheWayIsNotKnown) {
  EXPECT_EQ(reserve(std::nullopt, twenty_minutes, {}), 0.20);
  EXPECT_EQ(reserve(WayHome{nan, 10, 10}, twenty_minutes, {}), 0.20);
  EXPECT_EQ(reserve(WayHome{500, std::numeric_limits<double>::infinity(), 10}, twenty_minutes, {}), 0.20);
}

TEST(Reserve, IsNeverBelowFifteenPercent) {
  EXPECT_EQ(reserve(WayHome{0, 10, 10}, twenty_minutes, {}), 0.15);
}

TEST(Reserve, GrowsWithTheWayHome) {
  // 600 m against a breeze of 4 m/s at 10 m/s: 100 s; 10 m at 0.5 m/s: 20 s; 5 s over home. 125 of 1200 s, and 5 %.
  EXPECT_NEAR(reserve(WayHome{600, 10, 10}, twenty_minutes, {}), 125.0 / 1200.0 + 0.05, 1e-9);
  EXPECT_NEAR(reserve(WayHome{1200, 10, 10}, twenty_minutes, {}), 225.0 / 1200.0 + 0.05, 1e-9);
}

TEST(Reserve, CountsTheErrorOfWhatIsKnownAgainstIt) {
  auto doubtful = twenty_minutes;
  doubtful.error = 0.2;
  EXPECT_NEAR(reserve(WayHome{1200, 10, 10}, doubtful, {}), 1.2 * 225.0 / 1200.0 + 0.05, 1e-9);
}

TEST(Reserve, IsAllThereIsWhenThereIsNoWayHomeAgainstTheWind) {
  EXPECT_EQ(reserve(WayHome{100, 10, 10}, twenty_minutes, {.headwind_m_s = 9.5}), 1.0);
  EXPECT_EQ(reserve(WayHome{1e6, 10, 10}, twenty_minutes, {}), 1.0);
}

TEST(Reserve, ClimbsBeforeItReturnsAndPaysForIt) {
  // At 2.5 m/s with 5 m/s through the rotors: 0.25 + sqrt(0.0625 + 1) times hovering.
  auto const flat = *hover_time_home({0, 20, 20}, {});
  auto const climbing = *hover_time_home({0, 10, 20}, {});
  EXPECT_NEAR(base::to_seconds(climbing - flat), 4.0 * 1.280776, 1e-5);
}

TEST(Reserve, ComesDownFromAboveTheHeightOfTheReturn) {
  // 20 m at 1.5 m/s, then 10 m at 0.5 m/s, and 5 s over home.
  EXPECT_NEAR(base::to_seconds(*hover_time_home({0, 30, 10}, {})), 20 / 1.5 + 20 + 5, 1e-9);
}

TEST(Reserve, OfWhatStandsBelowHomeClimbsFromThere) {
  EXPECT_GT(*hover_time_home({0, 0, 10}, {}), *hover_time_home({0, 10, 10}, {}));
  EXPECT_EQ(*hover_time_home({0, -3, 10}, {}), *hover_time_home({0, 0, 10}, {}));
}

TEST(FlyingTimeLeft, IsWhatIsAboveTheReserveOverHome) {
  // Landing from 10 m is not worth the least reserve: 15 of 75 percent stay, and 60 last 12 of the twenty minutes.
  EXPECT_NEAR(base::to_seconds(*flying_time_left(0.75, 10, 10, twenty_minutes, {})), 720.0, 1e-6);
  auto doubtful = twenty_minutes;
  doubtful.error = 0.2;
  EXPECT_NEAR(base::to_seconds(*flying_time_left(0.75, 10, 10, doubtful, {})), 600.0, 1e-6);
}

TEST(FlyingTimeLeft, EndsBeforeTheReserveOfAnyPlaceOnTheWayHomeIsTouched) {
  // Against the wind that is reckoned with, home is 6 m/s away: who leaves when the time says so never meets the
  // reserve.
  for (double const drain : {1.0 / 1200.0, 1.0 / 300.0}) {
    vehicle::Drain const draws{.per_s = drain, .error = 0.1};
    for (double distance_m : {10.0, 100.0, 500.0}) {
      double const way_s = distance_m / 6.0;
      // The charge with which exactly the way home is left.
      double const charge = reserve(WayHome{0, 10, 10}, draws, {}) + way_s * drain * 1.1;
      EXPECT_NEAR(base::to_seconds(*flying_time_left(charge, 10, 10, draws, {})), way_s, 1e-6);
      EXPECT_GE(charge + 1e-9, reserve(WayHome{distance_m, 10, 10}, draws, {}));
    }
  }
}

TEST(FlyingTimeLeft, IsNoneWhereTheReserveIsReached) {
  EXPECT_EQ(*flying_time_left(0.1, 10, 10, twenty_minutes, {}), base::Duration::zero());
}

TEST(FlyingTimeLeft, IsNotKnownBeforeItIsKnownWhatFlyingDraws) {
  EXPECT_FALSE(flying_time_left(0.9, 10, 10, std::nullopt, {}));
  EXPECT_FALSE(flying_time_left(0.9, nan, 10, twenty_minutes, {}));
  EXPECT_FALSE(flying_time_left(0.9, 10, 10, vehicle::Drain{.per_s = 0.0}, {}));
}

}  // namespace
}  // namespace lapwing::autonomy
