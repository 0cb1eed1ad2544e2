#include "vision/lot/layout.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

constexpr double pitch = 2.6;
constexpr double depth = 5.0;

SeenGround const everything = SeenGround::rectangle(200.0, 200.0);

PaintedLine side(int k, double slant = 0.0) {
  double const x = 10.0 + k * pitch;
  return {{x, 4.0}, {x + slant * depth, 4.0 + depth}};
}

TurnedBox car(double slot) {
  return {
      .middle = {10.0 + (slot + 0.5) * pitch, 6.5}, .length = 4.6, .width = 1.8, .heading_rad = std::numbers::pi / 2};
}

bool has_slot_at(std::vector<SlotShape> const& slots, double x, double y) {
  return std::ranges::any_of(slots,
                             [&](auto const& slot) { return cv::norm(slot.middle() - cv::Point2d(x, y)) < 0.3; });
}

TEST(Layout, BetweenNeighbouringSidesIsASlot) {
  std::vector<PaintedLine> const lines{side(0), side(1), side(2), side(3)};
  auto const slots = slots_between(lines, {}, everything);
  ASSERT_EQ(slots.size(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(has_slot_at(slots, 10.0 + (k + 0.5) * pitch, 6.5)) << k;
}

TEST(Layout, SlantedSidesMakeSlantedSlots) {
  std::vector<PaintedLine> const lines{side(0, 0.5), side(1, 0.5), side(2, 0.5), side(3, 0.5)};
  auto const slots = slots_between(lines, {}, everything);
  ASSERT_EQ(slots.size(), 3U);
  EXPECT_TRUE(has_slot_at(slots, 10.0 + 0.5 * pitch + 0.25 * depth, 6.5));
}

TEST(Layout, LongSidesAreTwoRowsHeadToHead) {
  std::vector<PaintedLine> lines;
  for (int k = 0; k < 4; ++k) lines.push_back({{10.0 + k * pitch, 4.0}, {10.0 + k * pitch, 4.0 + 2.0 * depth}});
  auto const slots = slots_between(lines, {}, everything);
  ASSERT_EQ(slots.size(), 6U);
  EXPECT_TRUE(has_slot_at(slots, 10.0 + 0.5 * pitch, 6.5));
  EXPECT_TRUE(has_slot_at(slots, 10.0 + 0.5 * pitch, 11.5));
}

TEST(Layout, TheLineAlongTheHeadsSaysWhereRowsMeetAndHowDeepTheyAre) {
  // Joints of the ground go on where the paint ends, each as far as it likes.
  std::vector<double> const joints{0.0, 1.9, 1.1, 3.1, 2.6, 3.6};
  std::vector<PaintedLine> lines{{{10.0, 4.0 + depth}, {10.0 + 5 * pitch, 4.0 + depth}}};
  for (std::size_t k = 0; k < joints.size(); ++k) {
    double const x = 10.0 + static_cast<double>(k) * pitch;
    lines.push_back({{x, 4.0}, {x, 4.0 + 2.0 * depth + joints[k]}});
  }
  auto const slots = slots_between(lines, {}, everything);
  ASSERT_EQ(slots.size(), 10U);
  for (double const y : {6.5, 11.5}) EXPECT_TRUE(has_slot_at(slots, 10.0 + 0.5 * pitch, y)) << y;
}

TEST(Layout, WhatMostSidesShowIsTheirEndThoughCarsHideSome) {
  std::vector<double> const hidden{0.0, 1.4, 0.0, 2.2, 0.0, 1.8, 0.0};
  std::vector<PaintedLine> lines;
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    double const x = 10.0 + static_cast<double>(k) * pitch;
    lines.push_back({{x, 4.0 + hidden[k]}, {x, 4.0 + depth}});
  }
  auto const slots = slots_between(lines, {}, everything);
  ASSERT_EQ(slots.size(), 6U);
  EXPECT_TRUE(has_slot_at(slots, 10.0 + 0.5 * pitch, 6.5));
}

TEST(Layout, AKerbBesideTheRowIsNoSideOfIt) {
  std::vector<PaintedLine> lines{side(0), side(1), side(2), side(3)};
  lines.push_back({{10.0 + 4.05 * pitch, 5.5}, {10.0 + 4.05 * pitch, 12.0}});
  EXPECT_EQ(slots_between(lines, {}, everything).size(), 3U);
}

TEST(Layout, HiddenSidesAreCompletedWhereCarsStand) {
  std::vector<PaintedLine> const lines{side(0), side(1), side(2), side(5), side(6)};
  EXPECT_EQ(slots_between(lines, {}, everything).size(), 3U)
      << "nothing says that between the second and the fifth are slots";
  std::vector<TurnedBox> const cars{car(2), car(4), car(6)};
  auto const slots = slots_between(lines, cars, everything);
  EXPECT_EQ(slots.size(), 6U);
  for (int const k : {0, 1, 2, 4, 5, 6}) EXPECT_TRUE(has_slot_at(slots, 10.0 + (k + 0.5) * pitch, 6.5)) << k;
}

TEST(Layout, ACarBesideOneSideMakesASlotNearlyAsSureAsTwoSides) {
  std::vector<PaintedLine> const lines{side(0), side(1), side(2), side(5), side(6)};
  std::vector<TurnedBox> const cars{car(2), car(3), car(4)};
  auto const slots = slots_between(lines, cars, everything);
  auto const surety_at = [&](int k) {
    auto const found = std::ranges::find_if(
        slots, [&](auto const& slot) { return std::abs(slot.middle().x - 10.0 - (k + 0.5) * pitch) < 0.3; });
    return found == slots.end() ? 0.0 : found->surety;
  };
  EXPECT_DOUBLE_EQ(surety_at(0), 0.95) << "two sides";
  EXPECT_DOUBLE_EQ(surety_at(2), 0.9) << "one side and a car";
  EXPECT_DOUBLE_EQ(surety_at(3), 0.6) << "a car alone, which may be passing";
}

TEST(Layout, OneSideThatIsMissingInALongRowIsCompleted) {
  std::vector<PaintedLine> const lines{side(0), side(1), side(3), side(4), side(5), side(6)};
  auto const slots = slots_between(lines, {}, everything);
  EXPECT_EQ(slots.size(), 6U);
  for (int k = 0; k < 6; ++k) EXPECT_TRUE(has_slot_at(slots, 10.0 + (k + 0.5) * pitch, 6.5)) << k;
}

TEST(Layout, PaintThatShowsFartherOutIsTheEndThoughMoreSidesAreHidden) {
  std::vector<PaintedLine> lines;
  for (int k = 0; k < 9; ++k) lines.push_back({{10.0 + k * pitch, k < 4 ? 4.0 : 5.2}, {10.0 + k * pitch, 4.0 + depth}});
  EXPECT_TRUE(has_slot_at(slots_between(lines, {}, everything), 10.0 + 0.5 * pitch, 6.5));
}

TEST(Layout, WhatIsHatchedIsNoSlot) {
  std::vector<PaintedLine> lines{side(0), side(1), side(2), side(3)};
  for (int k = 0; k < 4; ++k) {
    double const y = 4.6 + 1.1 * k;
    lines.push_back({{10.1 + pitch, y}, {9.9 + 2.0 * pitch, y + 1.2}});
  }
  auto const slots = slots_between(lines, {}, everything);
  EXPECT_EQ(slots.size(), 2U);
  EXPECT_FALSE(has_slot_at(slots, 10.0 + 1.5 * pitch, 6.5));
}

/// Sides of slots in line, as along a kerb: 6 m long, 2.2 m deep.
std::vector<PaintedLine> sides_in_line(int count) {
  std::vector<PaintedLine> lines;
  for (int k = 0; k < count; ++k) lines.push_back({{10.0 + 6.0 * k, 4.0}, {10.0 + 6.0 * k, 6.2}});
  return lines;
}

TEST(Layout, SlotsMayLieInLineAsAlongAKerb) {
  auto const slots = slots_between(sides_in_line(4), {}, everything);
  ASSERT_EQ(slots.size(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(has_slot_at(slots, 13.0 + 6.0 * k, 5.1)) << k;
}

TEST(Layout, HiddenSidesInLineAreCompletedWhereCarsStandOneBehindTheOther) {
  auto lines = sides_in_line(6);
  lines.erase(lines.begin() + 3);
  std::vector<TurnedBox> const cars{{.middle = {25.5, 5.1}, .length = 4.5, .width = 1.8, .heading_rad = 0.0},
                                    {.middle = {31.0, 5.1}, .length = 4.5, .width = 1.8, .heading_rad = 3.1}};
  auto const slots = slots_between(lines, cars, everything);
  EXPECT_EQ(slots.size(), 5U);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(has_slot_at(slots, 13.0 + 6.0 * k, 5.1)) << k;
}

TEST(Layout, PaintBetweenCarsThatStandSideBySideIsNoRowOfSlotsInLine) {
  // Of each side only what is before the cars is seen, and only every second one.
  std::vector<PaintedLine> lines;
  std::vector<TurnedBox> cars;
  for (int k = 0; k < 4; ++k) lines.push_back({{10.0 + 2.0 * pitch * k, 4.0}, {10.0 + 2.0 * pitch * k, 6.0}});
  for (int k = 0; k < 6; ++k) cars.push_back(car(k));
  EXPECT_TRUE(slots_between(lines, cars, everything).empty());
}

TEST(Layout, LinesThatAreNoRowMakeNone) {
  std::vector<PaintedLine> const road{{{0.0, 0.0}, {60.0, 0.0}}, {{0.0, 3.0}, {60.0, 3.0}}, {{0.0, 6.0}, {60.0, 6.0}}};
  EXPECT_TRUE(slots_between(road, {}, everything).empty());
  EXPECT_TRUE(slots_between({}, {}, everything).empty());
}

/// Two rows head to head from y = 4 on, cut off where the picture ends.
std::vector<PaintedLine> double_row_until(auto const& end_at) {
  std::vector<PaintedLine> lines;
  for (int k = 0; k < 6; ++k) {
    double const x = 10.0 + k * pitch;
    lines.push_back({{x, 4.0}, {x, std::min(4.0 + 2.0 * depth, end_at(x))}});
  }
  return lines;
}

TEST(Layout, WhereThePictureCutsOffTheFarRowTheNearOneIsAsDeepAsItIs) {
  for (double const end : {10.0, 11.2, 12.5}) {
    auto const lines = double_row_until([&](double) { return end; });
    auto const slots = slots_between(lines, {}, SeenGround::rectangle(40.0, end + 0.1));
    ASSERT_EQ(slots.size(), 5U) << end;
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(has_slot_at(slots, 10.0 + (k + 0.5) * pitch, 6.5)) << end;
  }
}

TEST(Layout, APictureThatCutsARowOffAslantDoesNotSlantItsSlots) {
  auto const end_at = [](double x) { return 10.0 + 0.25 * (x - 10.0); };
  SeenGround const seen({{0.0, 0.0}, {40.0, 0.0}, {40.0, end_at(40.0)}, {0.0, end_at(0.0)}});
  auto const slots = slots_between(double_row_until(end_at), {}, seen);
  ASSERT_GE(slots.size(), 5U);
  for (auto const& slot : slots) {
    EXPECT_NEAR(slot.middle().y, 6.5, 0.1);
    EXPECT_NEAR(cv::norm(slot.corners[2] - slot.corners[1]), depth, 0.1);
  }
}

TEST(Layout, TheLineAlongTheHeadsEndsTheNearRowOfACutPicture) {
  auto lines = double_row_until([](double) { return 13.0; });
  double const heads = 4.0 + 5.6;
  lines.push_back({{10.0, heads}, {10.0 + 5 * pitch, heads}});
  auto const slots = slots_between(lines, {}, SeenGround::rectangle(40.0, 13.1));
  ASSERT_EQ(slots.size(), 5U);
  for (auto const& slot : slots) EXPECT_NEAR(slot.middle().y, 4.0 + 0.5 * 5.6, 0.1);
}

TEST(Layout, ASideBesideTheEdgeOfThePictureIsNotCutOffByIt) {
  // The picture's left edge goes along the first side, and shows both of its ends.
  std::vector<PaintedLine> const lines{side(0), side(1), side(2)};
  SeenGround const seen({{9.9, 0.0}, {40.0, 0.0}, {40.0, 40.0}, {9.9, 40.0}});
  auto hidden = lines;
  hidden[1].from.y += 1.1;
  hidden[2].from.y += 1.9;
  auto const slots = slots_between(hidden, {}, seen);
  ASSERT_EQ(slots.size(), 2U);
  for (auto const& slot : slots) EXPECT_NEAR(slot.middle().y, 6.5, 0.1);
}

TEST(Layout, EdgesOfCarsAreNoSides) {
  std::vector<PaintedLine> lines{side(0), side(1), side(2), side(3), side(4)};
  std::vector<TurnedBox> const cars{car(0), car(1), car(2), car(3)};
  auto const painted = slots_between(lines, cars, everything);
  ASSERT_EQ(painted.size(), 4U);
  // Their paint is hidden, sills are seen.
  for (std::size_t k : {1U, 2U, 3U})
    lines[k] = {{cars[k].middle.x - 1.0, cars[k].middle.y - 1.6}, {cars[k].middle.x - 1.0, cars[k].middle.y + 1.6}};
  for (auto const& slot : slots_between(lines, cars, everything)) {
    bool const is_there = has_slot_at(painted, slot.middle().x, slot.middle().y);
    EXPECT_TRUE(is_there) << slot.middle().x << ", " << slot.middle().y;
  }
}

TEST(Layout, PaintBesideACarThatIsLongerThanTheCarStays) {
  std::vector<PaintedLine> const lines{side(0), side(1), side(2), side(3)};
  // So far from below the camera that its roof is seen over the paint.
  auto leaning = car(1);
  leaning.middle.x -= 0.35;
  EXPECT_EQ(slots_between(lines, std::vector{leaning}, everything).size(), 3U);
}

TEST(Layout, WhereNoTwoEndsAgreeNothingIsTold) {
  // Cut off at the far end. Of the nearer ones cars may hide two, or the row is slanted.
  std::vector<double> const hidden{0.0, 1.3, 2.6};
  std::vector<PaintedLine> lines;
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    double const x = 10.0 + static_cast<double>(k) * pitch;
    lines.push_back({{x, 4.0 + hidden[k]}, {x, 12.0}});
  }
  auto const seen = SeenGround::rectangle(40.0, 12.1);
  EXPECT_TRUE(slots_between(lines, {}, seen).empty());
  // One more that agrees with the first tells that the row is straight.
  lines.push_back({{10.0 + 3.0 * pitch, 4.0}, {10.0 + 3.0 * pitch, 12.0}});
  auto const slots = slots_between(lines, {}, seen);
  ASSERT_EQ(slots.size(), 3U);
  for (auto const& slot : slots) EXPECT_NEAR(slot.middle().y, 6.5, 0.1);
}

TEST(Layout, SidesThatLeaveThePictureAtBothEndsAreNoSlots) {
  std::vector<PaintedLine> lines;
  for (int k = 0; k < 6; ++k) lines.push_back({{10.0 + k * pitch, 0.1}, {10.0 + k * pitch, 7.9}});
  EXPECT_TRUE(slots_between(lines, {}, SeenGround::rectangle(40.0, 8.0)).empty());
}

}  // namespace
}  // namespace lapwing::vision
