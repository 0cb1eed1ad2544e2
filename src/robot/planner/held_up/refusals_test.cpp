#include "robot/planner/held_up/refusals.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

TEST(Refusals, HoldForAWhile) {
  Refusals refusals;
  refusals.note({1.0, 0.0}, 10.0);
  EXPECT_EQ(refusals.at(11.0).size(), 1u);
  EXPECT_EQ(refusals.at(49.0).size(), 1u);
  EXPECT_TRUE(refusals.at(51.0).empty());
}

TEST(Refusals, HoldTwiceAsLongWhereItIsTheSamePlace) {
  Refusals refusals;
  refusals.note({1.0, 0.0}, 0.0);
  refusals.note({1.1, 0.0}, 50.0);
  EXPECT_EQ(refusals.at(129.0).size(), 1u);
  EXPECT_TRUE(refusals.at(131.0).empty());
  refusals.note({2.0, 0.0}, 50.0);
  EXPECT_EQ(refusals.at(60.0).size(), 2u);
  EXPECT_EQ(refusals.at(100.0).size(), 1u) << "another place is another thing";
}

TEST(Refusals, ForgetTheOldestWhenThereAreTooMany) {
  Refusals refusals;
  for (int i = 0; i < 200; ++i) refusals.note({1.0 * i, 0.0}, 0.1 * i);
  auto const places = refusals.at(20.0);
  EXPECT_EQ(places.size(), 50u);
  EXPECT_EQ(places.back().x(), 199.0);
}

}  // namespace
}  // namespace lapwing::robot
