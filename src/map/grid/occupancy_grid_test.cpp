#include "map/grid/occupancy_grid.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::map {
namespace {

TEST(Evidence, TellsTheUnseenFromTheUndecided) {
  EXPECT_FALSE(Evidence().is_seen());
  EXPECT_EQ(Evidence().probability(), 0.5);
  EXPECT_TRUE(Evidence::of_probability(0.5).is_seen());
  EXPECT_NE(Evidence(), Evidence::of_probability(0.5));
}

TEST(Evidence, IsTheLogarithmOfTheOdds) {
  EXPECT_NEAR(Evidence::of_probability(0.9).log_odds(), std::log(9.0), 1.0 / 512.0);
  EXPECT_NEAR(Evidence::of_probability(0.2).probability(), 0.2, 1e-3);
  EXPECT_EQ(Evidence::of_probability(1.0).log_odds(), Evidence::most_log_odds);
  EXPECT_EQ(Evidence::of_probability(0.0).log_odds(), -Evidence::most_log_odds);
  EXPECT_EQ(Evidence::of_log_odds(1e9).log_odds(), Evidence::most_log_odds);
}

TEST(Evidence, AddsUp) {
  auto const likely = Evidence::of_log_odds(1.0);
  EXPECT_EQ(likely.and_also(likely).log_odds(), 2.0);
  EXPECT_EQ(likely.and_also(Evidence()), likely);
  EXPECT_EQ(Evidence().and_also(likely), likely);
  EXPECT_EQ(Evidence::of_log_odds(15.0).and_also(Evidence::of_log_odds(15.0)).log_odds(), Evidence::most_log_odds);
}

TEST(OccupancyGrid, HasCellsAllRoundItsOrigin) {
  OccupancyGrid grid(0.5);
  EXPECT_EQ(grid.cell_at({0.1, -0.1}), (Cell{0, -1}));
  EXPECT_EQ(grid.centre_of({0, -1}), (geo::Point<GridFrame>(0.25, -0.25)));
  EXPECT_EQ(tile_of({-1, 256}), (TileKey{-1, 1}));
  auto const taken = Evidence::of_probability(0.9);
  for (auto const cell : {Cell{0, 0}, Cell{-1, -1}, Cell{255, 256}, Cell{-257, 1000}}) {
    EXPECT_EQ(grid.at(cell), Evidence());
    grid.set(cell, taken);
    EXPECT_EQ(grid.at(cell), taken);
  }
  EXPECT_EQ(grid.tiles().size(), 4U);
  EXPECT_EQ(grid.at({1, 0}), Evidence());
}

TEST(OccupancyGrid, HasTilesOnlyWhereSomethingWasSeen) {
  OccupancyGrid grid(1.0);
  EXPECT_EQ(grid.extent(), std::nullopt);
  grid.set({5, 5}, Evidence());
  EXPECT_TRUE(grid.tiles().empty());
  grid.set({-300, 5}, Evidence::of_log_odds(1.0));
  grid.set({5, 5}, Evidence::of_log_odds(1.0));
  EXPECT_EQ(grid.extent(), (geo::Box<GridFrame>{{-512.0, 0.0}, {256.0, 256.0}}));
  grid.set_tile({-2, 0}, nullptr);
  EXPECT_EQ(grid.at({-300, 5}), Evidence());
  EXPECT_EQ(grid.tiles().size(), 1U);
}

TEST(OccupancyGrid, KeepsASnapshotAsItWas) {
  OccupancyGrid grid(1.0);
  grid.set({1, 1}, Evidence::of_log_odds(1.0));
  grid.set({300, 1}, Evidence::of_log_odds(1.0));
  auto const snapshot = grid;
  grid.add({1, 1}, Evidence::of_log_odds(1.0));
  EXPECT_EQ(grid.at({1, 1}).log_odds(), 2.0);
  EXPECT_EQ(snapshot.at({1, 1}).log_odds(), 1.0);
  EXPECT_EQ(snapshot.tiles().at({1, 0}), grid.tiles().at({1, 0})) << "what was not written is shared";
  auto const* tile = grid.tiles().at({0, 0}).get();
  grid.add({1, 1}, Evidence::of_log_odds(1.0));
  EXPECT_EQ(grid.tiles().at({0, 0}).get(), tile) << "what nobody shares is not copied";
}

}  // namespace
}  // namespace lapwing::map
