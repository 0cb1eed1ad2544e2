#include "fleet/watch/place_trace.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using vehicle::Family;

geo::Wgs84 const start = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);

geo::Wgs84 at(double north_m, double east_m = 0.0) {
  return geo::displaced(start, {.north = north_m, .east = east_m, .down = 0.0});
}

/// Places 100 m after each other, numbered from 1.
std::vector<PlannedPlace> row(int count, double radius_m = 20.0) {
  std::vector<PlannedPlace> places;
  for (int i = 1; i <= count; ++i) places.push_back({i, at(100.0 * i), radius_m});
  return places;
}

TEST(PlaceTrace, KnowsWhatWasPassedFromPositionsFarApart) {
  PlaceTrace trace(row(3), Family::copter);
  trace.note(start, 0.0, {});
  for (double north_m = 70.0; north_m <= 330.0; north_m += 70.0) trace.note(at(north_m, 10.0), 10.0, 7s);
  EXPECT_TRUE(trace.unpassed({}).empty());
}

TEST(PlaceTrace, NamesWhatWasSkipped) {
  PlaceTrace trace(row(4), Family::copter);
  trace.note(start, 0.0, {});
  for (double north_m = 0.0; north_m <= 100.0; north_m += 2.0) trace.note(at(north_m), 10.0, 200ms);
  for (double east_m = 0.0; east_m <= 200.0; east_m += 2.0) trace.note(at(100.0, east_m), 10.0, 200ms);
  EXPECT_EQ(trace.unpassed({}), (std::vector{2, 3, 4}));
  EXPECT_EQ(trace.size(), 4u);
}

TEST(PlaceTrace, BelievesWhatMayHaveHappenedInSilence) {
  PlaceTrace trace(row(4), Family::copter);
  trace.note(start, 0.0, {});
  trace.note(at(400.0), 10.0, 40s);  // on the way it may have passed all of them
  EXPECT_TRUE(trace.unpassed({}).empty());
}

TEST(PlaceTrace, DoesNotBelieveMoreThanTheTimeAllows) {
  PlaceTrace trace(row(40), Family::copter);
  trace.note(start, 0.0, {});
  trace.note(at(50.0, 10.0), 10.0, 10s);
  auto const unpassed = trace.unpassed({});
  ASSERT_FALSE(unpassed.empty());
  EXPECT_EQ(unpassed.front(), 3);
  EXPECT_EQ(unpassed.back(), 40);
}

TEST(PlaceTrace, BlamesNobodyForASilenceThatStillLasts) {
  PlaceTrace trace(row(2), Family::copter);
  trace.note(start, 0.0, {});
  EXPECT_EQ(trace.unpassed(1s).size(), 2u);
  EXPECT_TRUE(trace.unpassed(20s).empty());
}

TEST(PlaceTrace, LetsFastVehiclesCutCorners) {
  PlaceTrace slow({{1, at(60.0), 20.0}}, Family::plane);
  slow.note(start, 1.0, {});
  slow.note(at(0.0, 1.0), 1.0, 1s);
  EXPECT_EQ(slow.unpassed({}).size(), 1u);
  PlaceTrace fast({{1, at(60.0), 20.0}}, Family::plane);
  fast.note(start, 22.0, {});
  EXPECT_TRUE(fast.unpassed({}).empty());
}

TEST(PlaceTrace, TakesTheVehiclesWordForAPlaceThatItWasNear) {
  PlaceTrace trace({{1, at(100.0), 20.0}, {4, at(500.0), 20.0}}, Family::copter);
  trace.note(at(50.0), 0.0, {});
  trace.note_reached(2);  // the number of a command behind the place
  EXPECT_EQ(trace.unpassed({}), std::vector{4});
  trace.note_reached(4);  // it is 450 m away
  EXPECT_EQ(trace.unpassed({}), std::vector{4});
}

TEST(PlaceTrace, KnowsNothingWithoutAPosition) {
  PlaceTrace const trace(row(3), Family::copter);
  EXPECT_TRUE(trace.unpassed({}).empty());
}

TEST(PlaceTrace, NamesItemsInRuns) {
  EXPECT_EQ(items_text({4}), "item 4");
  EXPECT_EQ(items_text({4, 5}), "items 4 and 5");
  EXPECT_EQ(items_text({4, 5, 6, 9, 11}), "items 4 to 6, 9 and 11");
}

}  // namespace
}  // namespace lapwing::fleet
