#include "vision/cars/turned_box.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

TurnedBox const lying{.middle = {100.0, 50.0}, .length = 40.0, .width = 20.0, .heading_rad = 0.0};

TEST(TurnedBox, ItsCornersAreInOrderRoundIt) {
  auto const corners = corners_of(lying);
  EXPECT_EQ(corners[0], (Point{120.0, 40.0}));
  EXPECT_EQ(corners[1], (Point{120.0, 60.0}));
  EXPECT_EQ(corners[2], (Point{80.0, 60.0}));
  EXPECT_EQ(corners[3], (Point{80.0, 40.0}));
}

TEST(TurnedBox, TheUprightBoxIsRoundAllOfItWithinThePicture) {
  auto turned = lying;
  turned.heading_rad = std::numbers::pi / 2.0;
  auto const box = upright_box(turned, {640, 480});
  EXPECT_NEAR(box.x, 90.0, 1e-9);
  EXPECT_NEAR(box.y, 30.0, 1e-9);
  EXPECT_NEAR(box.width, 20.0, 1e-9);
  EXPECT_NEAR(box.height, 40.0, 1e-9);
  auto const cut = upright_box(lying, {110, 55});
  EXPECT_NEAR(cut.x + cut.width, 110.0, 1e-9);
  EXPECT_NEAR(cut.y + cut.height, 55.0, 1e-9);
}

TEST(TurnedBox, ContainsWhatIsBetweenItsSides) {
  auto slanted = lying;
  slanted.heading_rad = std::numbers::pi / 4.0;
  EXPECT_TRUE(contains(slanted, {113.0, 63.0}));
  EXPECT_FALSE(contains(slanted, {113.0, 37.0}));
  EXPECT_TRUE(contains(lying, {119.0, 59.0}));
  EXPECT_FALSE(contains(lying, {121.0, 50.0}));
}

}  // namespace
}  // namespace lapwing::vision
