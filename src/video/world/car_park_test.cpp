#include "video/world/car_park.hpp"

#include <gtest/gtest.h>

#include "video/testing/small_car_park.hpp"

namespace lapwing::video {
namespace {

base::UtcTime at_minute(double minutes) {
  return base::UtcTime(std::chrono::days(20'000)) +
         std::chrono::duration_cast<base::UtcTime::duration>(base::from_seconds(60.0 * minutes));
}

TEST(CarPark, WhatStandsThereDependsOnSeedAndTimeAlone) {
  auto park = testing::small_car_park(3);
  park.stay_s = 600.0;
  auto const once = occupation_at(park, at_minute(5.0));
  static_cast<void>(occupation_at(park, at_minute(500.0)));
  auto const again = occupation_at(park, at_minute(5.0));
  EXPECT_EQ(once.taken, again.taken);
  ASSERT_EQ(once.vehicles.size(), again.vehicles.size());
  for (std::size_t i = 0; i < once.vehicles.size(); ++i) EXPECT_EQ(once.vehicles[i].at, again.vehicles[i].at);
  park.seed = 4;
  EXPECT_NE(occupation_at(park, at_minute(5.0)).taken, once.taken);
}

TEST(CarPark, SlotsAreTakenForTheirShareAndChangeAsOftenAsTheProcessSays) {
  auto park = testing::small_car_park(1, 0.6);
  constexpr double stay_min = 30.0;
  park.stay_s = 60.0 * stay_min;
  constexpr int minutes = 20'000;
  int taken = 0;
  int left = 0;
  auto before = occupation_at(park, at_minute(-1.0)).taken;
  for (int minute = 0; minute < minutes; ++minute) {
    auto const now = occupation_at(park, at_minute(minute)).taken;
    for (std::size_t i = 0; i < now.size(); ++i) {
      taken += now[i] ? 1 : 0;
      left += before[i] && !now[i] ? 1 : 0;
    }
    before = now;
  }
  double const all = 16.0 * minutes;
  EXPECT_NEAR(taken / all, 0.6, 0.02);
  // Taken slots are left once in stay / (1 - share) on average; within a minute a few leave and come again unseen.
  EXPECT_NEAR(left / all, 0.6 * 0.4 / stay_min, 0.0006);
}

TEST(CarPark, CarsThatStayForEverDoNotChange) {
  auto const park = testing::small_car_park(2);
  EXPECT_EQ(occupation_at(park, at_minute(0.0)).taken, occupation_at(park, at_minute(1e6)).taken);
}

TEST(CarPark, SlotsThatAreFixedKeepTheirState) {
  auto park = testing::small_car_park(1);
  park.stay_s = 60.0;
  park.slots[0].habit = Slot::Habit::taken;
  park.slots[1].habit = Slot::Habit::free;
  for (int minute = 0; minute < 50; ++minute) {
    auto const now = occupation_at(park, at_minute(minute)).taken;
    EXPECT_TRUE(now[0]);
    EXPECT_FALSE(now[1]);
  }
}

TEST(CarPark, AListedCarTakesItsSlot) {
  auto park = testing::small_car_park(1, 0.0);
  park.cars.push_back({.at = park.slots[3].middle(), .slot = 3});
  park.slots[3].habit = Slot::Habit::left_to_listed;
  auto const now = occupation_at(park, at_minute(0.0));
  EXPECT_TRUE(now.taken[3]);
  EXPECT_EQ(std::ranges::count(now.taken, true), 1);
}

TEST(CarPark, CarsStandInTheirSlots) {
  auto const park = testing::small_car_park(5, 1.0);
  for (auto const& vehicle : occupation_at(park, at_minute(0.0)).vehicles) {
    ASSERT_TRUE(vehicle.slot);
    auto const& slot = park.slots[*vehicle.slot];
    EXPECT_TRUE(slot.contains(vehicle.at));
    EXPECT_LT(geo::distance_m(slot.middle(), vehicle.at), 0.6);
    EXPECT_LT(std::abs(std::sin(vehicle.heading_rad - slot.heading_rad())), 0.1);
  }
}

TEST(CarPark, CarsDriveAlongTheirLaneAtItsSpeed) {
  auto park = testing::small_car_park(1, 0.0);
  park.lanes.push_back({.points = {Spot(-15, -10), Spot(15, -10), Spot(15, 10)}, .speed_m_s = 2.0, .every_s = 20.0});
  int seen = 0;
  for (int second = 0; second < 200; ++second) {
    auto const now = occupation_at(park, at_minute(second / 60.0));
    auto const soon = occupation_at(park, at_minute((second + 0.5) / 60.0));
    for (auto const& vehicle : now.vehicles) {
      EXPECT_TRUE(vehicle.is_driving);
      ++seen;
      if (std::abs(vehicle.heading_rad) > 1e-9 || vehicle.at.x() > 12.0) continue;  // on the straight part
      EXPECT_NEAR(vehicle.at.y(), -10.0, 1e-9);
      EXPECT_TRUE(std::ranges::any_of(
          soon.vehicles, [&](Vehicle const& later) { return std::abs(later.at.x() - vehicle.at.x() - 1.0) < 1e-6; }));
    }
  }
  EXPECT_GT(seen, 100);
  EXPECT_EQ(std::ranges::count(occupation_at(park, at_minute(0.0)).taken, true), 0);
}

TEST(RowOfSlots, SlantedSlotsKeepTheirWidthAndLength) {
  CarPark park;
  constexpr double slant_rad = 0.6;
  add_row(park, {.name = "A", .at = Spot(0, 0), .count = 3, .width_m = 2.4, .length_m = 5.2, .slant_rad = slant_rad});
  auto const& c = park.slots[1].outline;
  auto const side = c[3] - c[0];
  EXPECT_NEAR(side.length(), 5.2, 1e-9);
  EXPECT_NEAR(std::abs(side.cross(c[1] - c[0])) / side.length(), 2.4, 1e-9);
  EXPECT_GT(side.x(), 0.0);  // towards where the row goes
  EXPECT_EQ(park.slots[0].outline[1], park.slots[1].outline[0]);
  EXPECT_EQ(park.stripes.size(), 4U);  // neighbours share a line
}

TEST(RowOfSlots, WhatIsLeftOutLeavesItsNeighboursBothLines) {
  CarPark park;
  add_row(park, {.name = "A", .at = Spot(0, 0), .count = 3, .left_out = {2}});
  ASSERT_EQ(park.slots.size(), 2U);
  EXPECT_EQ(park.slots[1].id, "A3");
  EXPECT_EQ(park.stripes.size(), 4U);
}

}  // namespace
}  // namespace lapwing::video
