#include "robot/planner/company/companions.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using explore::Knowledge;

map::OccupancyGrid with(Place const& place, double probability) {
  map::OccupancyGrid grid(0.05);
  grid.set(grid.cell_at(place), map::Evidence::of_probability(probability));
  return grid;
}

TEST(CompanionMaps, LayWhatTheyHaveSeenWhereItIsOnOurMap) {
  CompanionMaps maps;
  // It began 10 m ahead of us, looking to our left.
  maps.take({{.id = "robot2", .grid = with({2.02, 1.02}, 0.9), .origin = {10.0, 0.0, std::numbers::pi / 2.0}}});
  EXPECT_EQ(maps.at({8.98, 2.02}), Knowledge::wall);
  EXPECT_EQ(maps.at({2.02, 1.02}), Knowledge::unknown);
}

TEST(CompanionMaps, AreAddedUp) {
  CompanionMaps maps;
  maps.take({{.id = "robot2", .grid = with({1.0, 1.0}, 0.9)}, {.id = "robot3", .grid = with({1.0, 1.0}, 0.01)}});
  EXPECT_EQ(maps.at({1.0, 1.0}), Knowledge::free) << "the one is surer";
}

TEST(CompanionMaps, NameTheTilesOfOursThatChangeWithTheirs) {
  CompanionMaps maps;
  auto grid = with({1.0, 1.0}, 0.9);
  maps.take({{.id = "robot2", .grid = grid}});
  auto const first = maps.take_changes();
  EXPECT_NE(std::ranges::find(first, (map::TileKey{0, 0})), first.end());
  EXPECT_TRUE(maps.take_changes().empty());
  maps.take({{.id = "robot2", .grid = grid}});
  EXPECT_TRUE(maps.take_changes().empty()) << "the same tile";
  grid.set(grid.cell_at({-1.0, 1.0}), map::Evidence::of_probability(0.1));
  maps.take({{.id = "robot2", .grid = grid}});
  auto const next = maps.take_changes();
  EXPECT_NE(std::ranges::find(next, (map::TileKey{-1, 0})), next.end());
  EXPECT_EQ(maps.tiles(), (std::vector<map::TileKey>{{-1, 0}, {0, 0}}));
}

TEST(CompanionMaps, KeepWhatWasHeardOfThoseWhoHaveDone) {
  CompanionMaps maps;
  maps.take({{.id = "robot2", .grid = with({1.0, 1.0}, 0.9)}});
  maps.take({{.id = "robot3", .grid = with({2.0, 1.0}, 0.9)}});
  ASSERT_EQ(maps.all().size(), 2U);
  EXPECT_FALSE(maps.all()[0].explores);
  EXPECT_TRUE(maps.all()[1].explores);
  EXPECT_EQ(maps.at({1.0, 1.0}), Knowledge::wall);
  maps.clear();
  EXPECT_EQ(maps.at({1.0, 1.0}), Knowledge::unknown);
}

}  // namespace
}  // namespace lapwing::robot
