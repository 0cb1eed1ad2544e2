#include "autonomy/interface/wanted_place.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace lapwing::autonomy {
namespace {

using Place = geo::Point<ArmingFrame>;

double constexpr nan = std::numeric_limits<double>::quiet_NaN();
double constexpr infinite = std::numeric_limits<double>::infinity();

PlaceLimits fenced() {
  return {.furthest_m = 200,
          .furthest_from_lot_m = 20,
          .fence = geo::Polygon<ArmingFrame>{{{Place(-50, -50), Place(50, -50), Place(50, 150), Place(-50, 150)}}}};
}
geo::Box<ArmingFrame> const lot{Place(0, 10), Place(40, 60)};

std::string why_not(Place const& place, std::optional<geo::Box<ArmingFrame>> const& near = std::nullopt) {
  auto const result = check_place(place, fenced(), near);
  return result ? "" : result.error().message;
}

TEST(WantedPlace, MayBeAnywhereWithinTheFence) {
  EXPECT_EQ(why_not(Place(49, 149)), "");
  EXPECT_EQ(why_not(Place(0, 0)), "");
}

TEST(WantedPlace, IsRefusedWhereItIsNoNumber) {
  for (double const value : {nan, infinite, -infinite}) {
    EXPECT_EQ(why_not(Place(value, 0)), "the wanted place has a coordinate that is no number");
    EXPECT_EQ(why_not(Place(0, value)), "the wanted place has a coordinate that is no number");
  }
}

TEST(WantedPlace, IsRefusedTooFarAway) {
  EXPECT_EQ(why_not(Place(0, 200.5)),
            "the wanted place is 200 m from where the drone was armed, and 200 m is the limit");
  EXPECT_EQ(why_not(Place(1e300, 1e300)).substr(0, 20), "the wanted place is ");
}

TEST(WantedPlace, IsRefusedOutsideTheFenceWithHowFar) {
  EXPECT_EQ(why_not(Place(53, 0)), "the wanted place (53.0 m, 0.0 m) is 3.0 m outside the fence");
}

TEST(WantedPlace, IsRefusedTooFarFromTheLotWhereThatMatters) {
  EXPECT_EQ(why_not(Place(-30, 30), lot), "the wanted place is 30 m from the parking lot, and 20 m is the limit");
  EXPECT_EQ(why_not(Place(-30, 30)), "");
  EXPECT_EQ(why_not(Place(-19, 30), lot), "");
  EXPECT_EQ(why_not(Place(20, 30), lot), "");
}

TEST(WantedPlace, HeightsKeepToTheHoverHeights) {
  HoverHeights const heights{8, 12, 20};
  EXPECT_TRUE(check_height(8, heights));
  EXPECT_TRUE(check_height(20, heights));
  EXPECT_EQ(check_height(7.9, heights).error().message,
            "the wanted height (7.9 m) is below the lowest hover height (8 m)");
  EXPECT_EQ(check_height(20.1, heights).error().message,
            "the wanted height (20.1 m) is above the highest hover height (20 m)");
  EXPECT_FALSE(check_height(nan, heights));
}

TEST(WantedPlace, OnTheGlobeIsTheSameFromEitherSide) {
  auto const drone = geo::Wgs84::from_degrees(43.2585, -79.9201, 130);
  Place const here(12, -7);
  auto const place = on_globe(Place(30, 40), drone, here);
  auto const back = in_arming_frame(place, drone, here);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x(), 30, 0.01);
  EXPECT_NEAR(back->y(), 40, 0.01);
  EXPECT_GT(place.lat_rad, drone.lat_rad) << "y leads north";
  EXPECT_GT(place.lon_rad, drone.lon_rad) << "x leads east";
}

TEST(WantedPlace, IsRefusedWhereItIsNoneOnEarth) {
  auto const drone = geo::Wgs84::from_degrees(43, -79);
  for (auto const& place : {geo::Wgs84::from_degrees(90.1, 0), geo::Wgs84::from_degrees(0, -180.1), geo::Wgs84{nan, 0},
                            geo::Wgs84{0, infinite}})
    EXPECT_FALSE(in_arming_frame(place, drone, Place(0, 0)));
}

TEST(HoverHeights, AreAtLeastSevenMetresAndRise) {
  EXPECT_EQ(heights_fault({7, 7.5, 8}), std::nullopt);
  EXPECT_EQ(heights_fault({6.9, 8, 9}), "the lowest hover height (6.9 m) is below 7 m");
  EXPECT_EQ(heights_fault({8, 8, 9}), "the lowest hover height (8 m) is not below the desired one (8 m)");
  EXPECT_EQ(heights_fault({8, 10, 10}), "the desired hover height (10 m) is not below the highest (10 m)");
  EXPECT_EQ(heights_fault({8, 10, 121}), "the highest hover height (121 m) is above 120 m");
  EXPECT_EQ(heights_fault({8, nan, 20}), "the desired hover height is no number");
  EXPECT_EQ(heights_fault({8, 10, infinite}), "the highest hover height is no number");
}

}  // namespace
}  // namespace lapwing::autonomy
