// Robots on a floor that is known, on their ways home: past those that stand, and round those that bar a way.
#include "explore/lead/explorer.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

constexpr int width = 160;
constexpr int height = 80;

/// A corridor 1 m wide round a block of 10 by 3 m.
std::vector<std::string_view> const ring = {
    "##########################",  //
    "#                        #",  //
    "#                        #",  //
    "#  ####################  #",  //
    "#  ####################  #",  //
    "#  ####################  #",  //
    "#  ####################  #",  //
    "#  ####################  #",  //
    "#  ####################  #",  //
    "#                        #",  //
    "#                        #",  //
    "##########################",
};

struct ExplorerTest : ::testing::Test {
  ExplorerTest() : map(width, height, 0.1, {.keep_off_m = 0.23, .wary_m = 0.3}) {
    auto const grid = testing::drawn_grid(ring);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) map.learn({x, y}, knowledge_of(grid.at({x, y})));
    }
  }

  /// Leads robots that stand where they are.
  void lead(std::vector<Place> const& starts, std::vector<Place> const& at, double until_s) {
    std::vector<Pose> homes;
    for (auto const& start : starts) homes.push_back({start, 0.0});
    if (!explorer) explorer.emplace(Explorer::begin(map, ExplorerSettings(), homes).value());
    std::vector<RobotNow> now;
    for (auto const& place : at) now.push_back({.pose = {place, 0.0}});
    for (; time_s < until_s; time_s += 0.5) explorer->update(map, time_s, now, {});
  }
  /// The highest and the lowest that the way of robot 0 leads.
  std::pair<double, double> heights() const {
    double highest_m = 0.0;
    double lowest_m = 100.0;
    for (auto const cell : explorer->path(0)) {
      highest_m = std::max(highest_m, map.middle(cell).y());
      lowest_m = std::min(lowest_m, map.middle(cell).y());
    }
    return {highest_m, lowest_m};
  }

  static constexpr double top_m = 5.0;
  static constexpr double bottom_m = 1.0;
  KnownMap map;
  std::optional<Explorer> explorer;
  double time_s = 0.0;
};

TEST_F(ExplorerTest, ARobotGoesRoundWhoStandsFarOffInItsWay) {
  // Home is at the left end, by the upper way; another stands on that, at its own home.
  Place const home(1.0, 4.0);
  Place const other(4.0, top_m);
  lead({home, other}, {{12.0, 3.0}, other}, 25.0);
  lead({home, other}, {{12.0, 4.0}, other}, 26.0);
  auto const [highest_m, lowest_m] = heights();
  ASSERT_FALSE(explorer->path(0).empty());
  EXPECT_LT(lowest_m, bottom_m + 0.4) << "by the lower way";
  EXPECT_LT(highest_m, top_m - 0.3);
}

TEST_F(ExplorerTest, ARobotDoesNotTurnRoundBetweenTwoThatBarItsWays) {
  Place const home(1.0, 3.5);
  Place const above(4.0, top_m);
  Place const below(4.0, bottom_m);
  lead({home, above, below}, {{12.0, 3.0}, above, below}, 25.0);
  lead({home, above, below}, {{12.0, 4.0}, above, below}, 26.0);
  ASSERT_FALSE(explorer->path(0).empty());
  EXPECT_GT(heights().first, top_m - 0.3) << "by the shorter way";
  lead({home, above, below}, {{6.5, top_m}, above, below}, 27.0);
  ASSERT_FALSE(explorer->path(0).empty());
  EXPECT_LT(map.middle(explorer->path(0).back()).x(), 4.0) << "it goes on towards the one above";
}

TEST_F(ExplorerTest, ARobotBesideOneThatStandsGoesNotThroughIt) {
  // Nearer to each other than they are to come: the way home leads past the other one, or away from it.
  Place const other(6.0, top_m);
  Place const here(6.42, top_m);
  lead({{1.0, 4.0}, other}, {here, other}, 30.0);
  ASSERT_FALSE(explorer->path(0).empty());
  for (auto const cell : explorer->path(0))
    EXPECT_GT(distance_m(map.middle(cell), other), 0.35) << map.middle(cell).x() << ", " << map.middle(cell).y();
}

}  // namespace
}  // namespace lapwing::explore
