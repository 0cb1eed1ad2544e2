#include "fleet/battery/battery_time.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

/// A copter with 5 Ah whose battery is reported every second, in whole percents.
struct Copter {
  enum class Tells { everything, current, percents };
  explicit Copter(Tells told = Tells::everything, bool cuts_off = true) : tells(told), cuts_percents_off(cuts_off) {}

  static constexpr double standing_a = 0.5;
  static constexpr double climbing_a = 22.75;  // at 2.5 m/s
  static constexpr double hovering_a = 16.5;
  static constexpr double sinking_a = 11.5;

  BatteryEstimate spend(base::Duration time, double current_a, bool flies, bool is_level = true) {
    BatteryEstimate estimate;
    for (auto const end = now + time; now < end; now += 1s) {
      drawn_ah += current_a / 3600.0;
      double const left = 100.0 * (1.0 - drawn_ah / 5.0);
      BatteryReport report{.remaining = (cuts_percents_off ? std::floor(left) : std::round(left)) / 100.0,
                           .is_working = flies,
                           .is_level = is_level,
                           .counts_from_full = true};
      if (tells != Tells::percents) report.current_a = current_a;
      if (tells == Tells::everything) report.drawn_ah = std::floor(drawn_ah * 1000.0) / 1000.0;
      estimate = battery.add(report, now);
    }
    return estimate;
  }
  BatteryEstimate stand(base::Duration time) { return spend(time, standing_a, false); }
  BatteryEstimate climb(base::Duration time) { return spend(time, climbing_a, true, false); }
  BatteryEstimate hover(base::Duration time) { return spend(time, hovering_a, true); }
  BatteryEstimate sink(base::Duration time) { return spend(time, sinking_a, true, false); }

  /// How long it could hover on.
  [[nodiscard]] double truth_s() const { return (5.0 - drawn_ah) * 3600.0 / hovering_a; }
  [[nodiscard]] double share_of_truth(std::optional<vehicle::Endurance> const& told) const {
    return told ? base::to_seconds(told->time) / truth_s() : 0.0;
  }
  [[nodiscard]] bool holds_truth(vehicle::Endurance const& told) const {
    return base::to_seconds(told.shortest()) <= truth_s() && truth_s() <= base::to_seconds(told.longest());
  }

  Tells tells;
  bool cuts_percents_off;
  BatteryTime battery;
  base::TimePoint now{};
  double drawn_ah = 0.0;
};

TEST(BatteryTime, SaysNothingOfACopterThatStands) {
  Copter copter;
  auto const estimate = copter.stand(30min);
  EXPECT_FALSE(estimate.now);
  EXPECT_FALSE(estimate.in_flight) << "what it stands on is not what it will fly on";
}

TEST(BatteryTime, IsWithinFifteenPercentFromTwentySecondsAfterTakeOff) {
  for (bool const cuts_off : {true, false}) {
    for (auto const stood : {10s, 300s, 3000s}) {
      Copter copter(Copter::Tells::everything, cuts_off);
      (void)copter.stand(stood);
      (void)copter.climb(16s);
      auto estimate = copter.hover(4s);
      for (int second = 20; second < 600; ++second, estimate = copter.hover(1s)) {
        ASSERT_TRUE(estimate.now) << second;
        EXPECT_NEAR(copter.share_of_truth(estimate.now), 1.0, 0.15) << second << " s after " << stood.count();
        EXPECT_TRUE(copter.holds_truth(*estimate.now)) << second << " s after " << stood.count();
      }
    }
  }
}

TEST(BatteryTime, KnowsItsUncertaintyAndGetsSurer) {
  Copter copter;
  (void)copter.stand(60s);
  (void)copter.climb(16s);
  auto const early = copter.hover(6s);
  auto const late = copter.hover(5min);
  ASSERT_TRUE(early.now && late.now);
  EXPECT_GT(early.now->error, early.now->time / 20);
  EXPECT_LT(late.now->error, late.now->time / 10);
}

TEST(BatteryTime, TellsNothingOrARangeThatHoldsTheTruthDuringTheFirstClimb) {
  Copter copter;
  (void)copter.stand(60s);
  for (int second = 0; second < 40; ++second) {
    auto const estimate = copter.climb(1s);
    if (estimate.now) {
      EXPECT_TRUE(copter.holds_truth(*estimate.now)) << second;
    }
  }
}

TEST(BatteryTime, IsNotMisledByStandingBetweenFlights) {
  Copter copter;
  (void)copter.stand(60s);
  (void)copter.climb(8s);
  (void)copter.hover(60s);
  (void)copter.sink(15s);
  auto const standing = copter.stand(40min);
  EXPECT_FALSE(standing.now);
  EXPECT_NEAR(copter.share_of_truth(standing.in_flight), 1.0, 0.15) << "by the flight before";
  (void)copter.climb(3s);
  for (int second = 3; second < 120; ++second) {
    auto const estimate = second < 16 ? copter.climb(1s) : copter.hover(1s);
    EXPECT_NEAR(copter.share_of_truth(estimate.now), 1.0, 0.15) << second;
  }
}

TEST(BatteryTime, FollowsAChangeOfPaceWithinAMinute) {
  Copter copter;
  (void)copter.stand(10s);
  (void)copter.hover(3min);
  auto const fast = copter.spend(60s, 33.0, true);
  ASSERT_TRUE(fast.now);
  EXPECT_NEAR(base::to_seconds(fast.now->time), (5.0 - copter.drawn_ah) * 3600.0 / 33.0, 60.0);
}

TEST(BatteryTime, CountsTheCurrentItselfWhereTheVehicleDoesNot) {
  Copter copter(Copter::Tells::current);
  (void)copter.stand(60s);
  (void)copter.climb(16s);
  auto const estimate = copter.hover(30s);
  EXPECT_NEAR(copter.share_of_truth(estimate.now), 1.0, 0.15);
}

TEST(BatteryTime, GoesByThePercentsOfThisFlightWithoutACurrent) {
  Copter copter(Copter::Tells::percents);
  (void)copter.stand(50min);
  EXPECT_FALSE(copter.climb(16s).now);
  auto estimate = copter.hover(40s);
  ASSERT_TRUE(estimate.now);
  EXPECT_TRUE(copter.holds_truth(*estimate.now));
  estimate = copter.hover(60s);
  EXPECT_NEAR(copter.share_of_truth(estimate.now), 1.0, 0.15);
  (void)copter.sink(10s);
  EXPECT_NEAR(copter.share_of_truth(copter.stand(20min).in_flight), 1.0, 0.2);
}

TEST(BatteryTime, BeginsAnewWithAFullerBattery) {
  Copter copter;
  (void)copter.hover(5min);
  (void)copter.stand(60s);
  copter.drawn_ah = 0.0;
  EXPECT_FALSE(copter.stand(20s).in_flight) << "perhaps one that holds less";
  (void)copter.climb(16s);
  EXPECT_NEAR(copter.share_of_truth(copter.hover(20s).now), 1.0, 0.15);
}

TEST(BatteryTime, IsZeroForAnEmptyBattery) {
  Copter copter;
  (void)copter.hover(10min);
  copter.drawn_ah = 5.0;
  auto const estimate = copter.hover(2s);
  ASSERT_TRUE(estimate.now);
  EXPECT_EQ(estimate.now->time, 0s);
}

}  // namespace
}  // namespace lapwing::fleet
