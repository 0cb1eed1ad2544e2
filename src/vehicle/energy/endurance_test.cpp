#include "vehicle/energy/endurance.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "vehicle/vehicle_state.hpp"

namespace lapwing::vehicle {
namespace {

using namespace std::chrono_literals;

TEST(Endurance, IsWhatIsLeftOverTheDrain) {
  auto const left = endurance(0.5, {.per_s = 0.001, .error = 0.1});
  ASSERT_TRUE(left);
  EXPECT_EQ(left->time, 500s);
  EXPECT_NEAR(base::to_seconds(left->error), 50.0 + 5.0, 1e-6) << "the drain's tenth, and half a percent of charge";
  EXPECT_NEAR(base::to_seconds(left->shortest()), 445.0, 1e-6);
  EXPECT_NEAR(base::to_seconds(left->longest()), 555.0, 1e-6);
}

TEST(Endurance, IsZeroForAnEmptyBatteryAndNeverLess) {
  auto const left = endurance(0.0, {.per_s = 0.001, .error = 0.1});
  ASSERT_TRUE(left);
  EXPECT_EQ(left->time, 0s);
  EXPECT_EQ(left->shortest(), 0s);
}

TEST(Endurance, IsNotToldWhereItCouldAsWellBeHalfOrTwice) {
  EXPECT_FALSE(endurance(0.5, {.per_s = 0.001, .error = 0.6}));
  EXPECT_FALSE(endurance(0.5, {.per_s = 0.001, .error = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(endurance(0.5, {.per_s = 0.0, .error = 0.1}));
  EXPECT_FALSE(endurance(0.5, {.per_s = 1e-9, .error = 0.1})) << "sixteen years";
}

TEST(EnduranceInFlight, IsOfThisFlightOrOfTheLastOne) {
  VehicleState state;
  EXPECT_FALSE(endurance_in_flight(state));
  Battery battery{.remaining = 0.8, .voltage_v = {}, .current_a = {}};
  state.power.battery.set(battery, base::TimePoint(1s));
  EXPECT_FALSE(endurance_in_flight(state)) << "it has not flown yet";
  battery.in_flight = Endurance{700s, 60s};
  state.power.battery.set(battery, base::TimePoint(2s));
  EXPECT_EQ(endurance_in_flight(state), (Endurance{700s, 60s}));
}

TEST(EnduranceInFlight, BelievesTheVehicleWhileItFliesOnly) {
  VehicleState state;
  Battery battery{.remaining = 0.8, .voltage_v = {}, .current_a = {}};
  battery.time_left = 36'000s;  // standing
  battery.in_flight = Endurance{700s, 60s};
  state.power.battery.set(battery, base::TimePoint(1s));
  state.motion.landed.set(true, base::TimePoint(1s));
  EXPECT_EQ(endurance_in_flight(state)->time, 700s);
  state.motion.landed.set(false, base::TimePoint(2s));
  EXPECT_EQ(endurance_in_flight(state), (Endurance{36'000s, {}}));
}

}  // namespace
}  // namespace lapwing::vehicle
