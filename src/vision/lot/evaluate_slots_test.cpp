#include "vision/lot/evaluate_slots.hpp"

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

JudgedSlot slot(double x, std::optional<double> occupied) {
  return {.corners = {{{x, 0.0}, {x + 25.0, 0.0}, {x + 25.0, 50.0}, {x, 50.0}}}, .occupied = occupied};
}

TEST(EvaluateSlots, ASlotIsFoundOnceAndWithinTheDistance) {
  SlotFigures figures;
  // At 10 cm a pixel: 0.3 m, 0.4 m and 0.6 m away.
  std::vector<JudgedSlot> const found{slot(3.0, 0.9), slot(-4.0, 0.9), slot(106.0, 0.1)};
  std::vector<JudgedSlot> const truth{slot(0.0, 1.0), slot(100.0, 0.0)};
  add(figures, found, truth, 0.1);
  EXPECT_EQ(figures.right, 1U);
  EXPECT_DOUBLE_EQ(figures.recall(), 0.5);
  EXPECT_DOUBLE_EQ(figures.precision(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(figures.f1(), 0.4);
}

TEST(EvaluateSlots, ChancesAreJudgedWhereTheTruthIsKnown) {
  SlotFigures figures;
  std::vector<JudgedSlot> const found{slot(0.0, 0.8), slot(100.0, 0.6), slot(200.0, std::nullopt), slot(300.0, 0.9)};
  std::vector<JudgedSlot> const truth{slot(0.0, 1.0), slot(100.0, 0.0), slot(200.0, 1.0), slot(300.0, std::nullopt)};
  add(figures, found, truth, 0.1);
  EXPECT_EQ(figures.told, 2U);
  EXPECT_EQ(figures.untold, 1U);
  EXPECT_DOUBLE_EQ(figures.accuracy(), 0.5);
  EXPECT_NEAR(figures.brier(), (0.04 + 0.36) / 2.0, 1e-12);
}

TEST(EvaluateSlots, WithoutSlotsThereIsNothingToDivideBy) {
  SlotFigures const none;
  EXPECT_EQ(none.f1(), 0.0);
  EXPECT_EQ(none.accuracy(), 0.0);
}

}  // namespace
}  // namespace lapwing::vision
