#include "slam/refine/overlap.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

TEST(PlaceIndex, ChoosesTheNearestOrThoseThatAreApart) {
  // The same 5 m, passed four times.
  std::vector<Pose2> poses;
  for (int pass = 0; pass < 4; ++pass)
    for (int i = 0; i < 50; ++i) poses.push_back({0.1 * i, 0.01 * pass, 0.0});
  PlaceIndex const index(poses, 4.0);
  constexpr int own = 0;
  constexpr int most = 4;
  auto const nearest = index.near(poses[own], own, most);
  ASSERT_EQ(nearest.size(), most);
  for (auto const k : nearest) EXPECT_LT(distance_m(poses[own], poses[k]), 0.5);
  auto const apart = index.near(poses[own], own, most, 1.0);
  ASSERT_EQ(apart.size(), most);
  for (auto const k : apart)
    for (auto const other : apart) EXPECT_TRUE(k == other || distance_m(poses[k], poses[other]) >= 1.0);
  EXPECT_GT(distance_m(poses[own], poses[apart.back()]), 2.9);
  EXPECT_LE(distance_m(poses[own], poses[apart.back()]), 4.0);
}

TEST(PlaceIndex, CountsATurnAsADistance) {
  std::vector<Pose2> const poses{{0.0, 0.0, 0.0}, {0.0, 0.1, 3.0}, {0.0, 0.2, 0.0}, {1.0, 0.0, 0.0}};
  PlaceIndex const index(poses, 4.0, 1);
  EXPECT_EQ(index.near(poses[0], 0, 3), (std::vector{2, 3, 1}));
  EXPECT_EQ(index.near(poses[0], 0, 3, 1.5), (std::vector{2, 1})) << "the one beside is near the nearest";
}

}  // namespace
}  // namespace lapwing::slam
