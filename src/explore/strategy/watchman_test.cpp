// The yardstick: a short way over a known floor from which everything is seen.
#include "explore/strategy/watchman.hpp"

#include <gtest/gtest.h>

#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

struct Drawn {
  explicit Drawn(std::vector<std::string_view> const& lines)
      : map(static_cast<int>(lines.front().size()) * 5, static_cast<int>(lines.size()) * 5, 0.1, {}),
        is_wanted(map.width(), map.height(), 0) {
    auto const grid = testing::drawn_grid(lines);
    for (std::size_t i = 0; i < is_wanted.size(); ++i) {
      auto const cell = map.cell_of(i);
      auto const knowledge = knowledge_of(grid.at(cell));
      map.learn(cell, knowledge);
      is_wanted.at_index(i) = knowledge == Knowledge::free ? 1 : 0;
    }
    roads.emplace(map);
    roads->update(map, map.take_changes());
  }
  KnownMap map;
  DenseGrid<std::uint8_t> is_wanted;
  std::optional<RoadMap> roads;
};

TEST(Watchman, LooksIntoEachRoomAndNoFarther) {
  Drawn const floor(testing::dead_ends);
  auto const start = floor.roads->node_near(floor.map.cell_at({2.0, 3.0})).value();
  auto const route = watchman_route(floor.map, *floor.roads, floor.is_wanted, start);
  EXPECT_EQ(route.nodes.front(), start);
  EXPECT_GE(route.seen, 0.985);
  EXPECT_GT(route.length_m, 12.0) << "the corridor is 19 m long and has rooms on both sides";
  EXPECT_LT(route.length_m, 45.0);
}

TEST(Watchman, StaysWhereEverythingIsSeenAlready) {
  std::vector<std::string_view> const room = {"##########", "#        #", "#        #", "#        #", "##########"};
  Drawn const floor(room);
  auto const start = floor.roads->node_near(floor.map.cell_at({2.5, 1.2})).value();
  auto const route = watchman_route(floor.map, *floor.roads, floor.is_wanted, start);
  EXPECT_GE(route.seen, 0.985);
  EXPECT_LT(route.length_m, 1.0);
}

}  // namespace
}  // namespace lapwing::explore
