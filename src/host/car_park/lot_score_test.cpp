#include "host/car_park/lot_score.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using map::SlotState;

/// 2.5 m by 5 m.
explore::Corners slot_at(double x, double y) {
  return {{{x - 1.25, y - 2.5}, {x + 1.25, y - 2.5}, {x + 1.25, y + 2.5}, {x - 1.25, y + 2.5}}};
}

map::Slot on_map(double x, double y, SlotState state) {
  auto const corners = slot_at(x, y);
  return {.outline = {{{corners.begin(), corners.end()}}}, .state = state};
}

CarParkTruth row_of_four() {
  return {.anchor = {},
          .slots = {{slot_at(0.0, 0.0), true},
                    {slot_at(2.5, 0.0), false},
                    {slot_at(5.0, 0.0), true},
                    {slot_at(7.5, 0.0), false}}};
}

TEST(LotScore, CountsWhatWasFoundAndToldRightly) {
  auto const score = score_of(
      {on_map(0.0, 0.2, SlotState::taken), on_map(2.5, 0.0, SlotState::taken), on_map(5.0, 0.3, SlotState::unknown)},
      row_of_four());
  EXPECT_EQ(score.true_slots, 4);
  EXPECT_EQ(score.found, 3);
  EXPECT_EQ(score.told, 2);
  EXPECT_EQ(score.right, 1);
  EXPECT_EQ(score.invented, 0);
  EXPECT_NEAR(score.off_m, (0.2 + 0.0 + 0.3) / 3.0, 1e-9);
}

TEST(LotScore, TakesASlotThatLiesAsideForNeitherFoundNorInvented) {
  EXPECT_EQ(score_of({on_map(-1.2, 0.0, SlotState::taken)}, row_of_four()), (LotScore{.true_slots = 4}));
}

TEST(LotScore, CountsWhatIsNowhereNearASlotAsInvented) {
  EXPECT_EQ(score_of({on_map(0.0, 20.0, SlotState::free)}, row_of_four()), (LotScore{.true_slots = 4, .invented = 1}));
}

TEST(LotScore, CountsATrueSlotOnce) {
  auto const score = score_of({on_map(0.1, 0.0, SlotState::taken), on_map(-0.1, 0.0, SlotState::taken)}, row_of_four());
  EXPECT_EQ(score.found, 1);
  EXPECT_EQ(score.right, 1);
}

}  // namespace
}  // namespace lapwing::host
