#include "onboard/decide/survey_processes.hpp"

#include <gtest/gtest.h>

namespace lapwing::onboard {
namespace {

TEST(SeenExtent, LiesAroundTheCellsThatAreKnown) {
  autonomy::OccupancyMap const map{.columns = 4,
                                   .rows = 3,
                                   .resolution_m = 0.5,
                                   .origin = {10, -2},
                                   .cells = {-1, -1, -1, -1,  //
                                             -1, 0, 100, -1,  //
                                             -1, -1, 50, -1}};
  auto const box = seen_extent(map);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->least, (geo::Point<autonomy::ArmingFrame>(10.5, -1.5)));
  EXPECT_EQ(box->most, (geo::Point<autonomy::ArmingFrame>(11.5, -0.5)));
}

TEST(SeenExtent, IsNothingWhereNothingWasSeen) {
  EXPECT_FALSE(seen_extent({}));
  EXPECT_FALSE(seen_extent({.columns = 2, .rows = 1, .resolution_m = 1, .cells = {-1, -1}}));
}

}  // namespace
}  // namespace lapwing::onboard
