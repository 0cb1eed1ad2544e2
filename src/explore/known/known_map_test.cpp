// What is drawn of scans, and what follows from it: standable cells, frontiers, distances.
#include "explore/known/known_map.hpp"

#include <gtest/gtest.h>

#include <random>

#include "explore/known/frontiers.hpp"
#include "explore/known/road_map.hpp"
#include "explore/path/grid_search.hpp"
#include "explore/simulated/laser.hpp"
#include "explore/testing/drawn_floor.hpp"
#include "explore/testing/learnt_map.hpp"

namespace lapwing::explore {
namespace {

struct KnownMapTest : ::testing::Test, testing::LearntMap {
  KnownMapTest() : LearntMap{KnownMap(60, 40, 0.1, {.keep_off_m = 0.23, .wary_m = 0.5})} {}
};

TEST_F(KnownMapTest, OnlyWhatIsFreeAllAroundCanBeStoodOn) {
  learn({5, 5}, {30, 30}, Knowledge::free);
  EXPECT_TRUE(map.is_standable({15, 15}));
  EXPECT_FALSE(map.is_standable({5, 15})) << "unknown beside it";
  map.learn({17, 15}, Knowledge::wall);
  EXPECT_FALSE(map.is_standable({15, 15}));
  map.learn({17, 15}, Knowledge::free);
  EXPECT_TRUE(map.is_standable({15, 15}));
}

TEST_F(KnownMapTest, CountsAreWhatLookingAfreshWouldGive) {
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    map.learn({static_cast<std::int32_t>(random() % 60), static_cast<std::int32_t>(random() % 40)},
              static_cast<Knowledge>(random() % 3 == 0 ? 2 : 1));
  }
  auto const around = cells_within(0.23, 0.1);
  std::size_t frontiers = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) {
      Cell const cell{x, y};
      bool const is_standable = map.at(cell) == Knowledge::free && std::ranges::all_of(around, [&](Cell away) {
                                  return map.at(cell + away) == Knowledge::free;
                                });
      ASSERT_EQ(map.is_standable(cell), is_standable) << x << ' ' << y;
      bool is_frontier = false;
      for (std::size_t i = 0; i < 4; ++i)
        is_frontier = is_frontier || map.at(cell + neighbours[i]) == Knowledge::unknown;
      is_frontier = is_frontier && map.at(cell) == Knowledge::free;
      ASSERT_EQ(map.is_frontier(cell), is_frontier) << x << ' ' << y;
      frontiers += is_frontier ? 1 : 0;
    }
  }
  EXPECT_EQ(map.frontier_cells().size(), frontiers);
}

TEST_F(KnownMapTest, ScansOfARoomDrawIt) {
  auto const plan = floor_plan_of(testing::drawn_grid(testing::two_rooms)).value();
  auto const world = World::around(plan, {2.0, 2.0}, {}).value();
  KnownMap known(world.width(), world.height(), world.cell_m(), {});
  Random random(1);
  Pose const pose{Place(2.0, 2.0) - world.plan_from_world(), 0.4};
  for (int i = 0; i < 10; ++i) known.add(scan(world, pose, {}, {}, random), {});
  for (int y = 0; y < world.height(); ++y) {
    for (int x = 0; x < world.width(); ++x) {
      bool const is_free = world.is_free_at({x, y});
      if (known.at({x, y}) != Knowledge::unknown) {
        EXPECT_EQ(known.at({x, y}) == Knowledge::free, is_free) << x << ' ' << y;
      }
    }
  }
  EXPECT_EQ(known.at(known.cell_at(pose.position)), Knowledge::free);
}

TEST_F(KnownMapTest, WhoWalksThroughIsNotDrawn) {
  auto const plan = floor_plan_of(testing::drawn_grid(testing::two_rooms)).value();
  auto const world = World::around(plan, {2.0, 2.0}, {}).value();
  KnownMap known(world.width(), world.height(), world.cell_m(), {});
  Random random(1);
  Pose const pose{Place(2.0, 2.0) - world.plan_from_world(), 0.0};
  std::vector<Disc> const person = {{pose.position + Shift(1.0, 0.0), 0.25}};
  for (int i = 0; i < 10; ++i) known.add(scan(world, pose, {}, {}, random), {});
  auto const rim = known.cell_at(pose.position + Shift(0.78, 0.0));
  for (int i = 0; i < 3; ++i) known.add(scan(world, pose, {}, person, random), {});
  EXPECT_EQ(known.at(rim), Knowledge::free) << "seen free often, taken for a moment";
  for (int i = 0; i < 30; ++i) known.add(scan(world, pose, {}, person, random), {});
  EXPECT_EQ(known.at(rim), Knowledge::wall) << "whoever stays is an obstacle";
  for (int i = 0; i < 30; ++i) known.add(scan(world, pose, {}, {}, random), {});
  EXPECT_EQ(known.at(rim), Knowledge::free) << "and none when he has gone";
}

TEST_F(KnownMapTest, TheRoadMapKnowsTheWayAsTheGridDoes) {
  RoadMap roads(map);
  learn({1, 1}, {58, 38}, Knowledge::free);
  roads.update(map, map.take_changes());
  // A wall with a gap at its upper end.
  learn({30, 1}, {30, 28}, Knowledge::wall);
  roads.update(map, map.take_changes());
  Cell const left{10, 5};
  Cell const right{50, 5};
  auto const from = roads.node_at(left);
  auto const to = roads.node_at(right);
  ASSERT_TRUE(from && to);
  GridSearch search(map);
  auto const path = search.path(map, {.from = left, .to = right});
  ASSERT_FALSE(path.empty());
  for (auto const cell : path) EXPECT_TRUE(map.is_standable(cell));
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += length_of(path[i] - path[i - 1]) * 0.1;
  EXPECT_NEAR(roads.from(*from).distance_m[*to], length_m, 0.3 * length_m);
  learn({30, 29}, {30, 38}, Knowledge::wall);
  roads.update(map, map.take_changes());
  EXPECT_FALSE(roads.from(*roads.node_at(left)).reaches(*roads.node_at(right)));
  EXPECT_TRUE(search.path(map, {.from = left, .to = right}).empty());
}

TEST_F(KnownMapTest, FrontiersAreFoundWithAPlaceToStandUntilGivenUp) {
  RoadMap roads(map);
  learn({0, 0}, {29, 39}, Knowledge::wall);
  learn({1, 1}, {28, 38}, Knowledge::free);
  learn({29, 18}, {29, 22}, Knowledge::free);
  roads.update(map, map.take_changes());
  auto const reach = roads.from(*roads.node_at({15, 20}));
  Frontiers frontiers(map);
  auto const found = frontiers.find(map, roads, reach);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].cells.size(), 5U);
  EXPECT_EQ(found[0].middle, (Cell{29, 20}));
  EXPECT_TRUE(map.is_standable(found[0].stand));
  frontiers.give_up(map, found[0]);
  EXPECT_TRUE(frontiers.find(map, roads, reach).empty());
  Frontiers others(map);
  others.put_off(map, found[0]);
  others.set_moment(FrontierSettings().again_after_s);
  EXPECT_EQ(others.find(map, roads, reach).size(), 1U) << "nothing else is left";
}

/// A room on the left of a wall with a door, and what was seen through the door of another one.
struct ShutDoorTest : KnownMapTest {
  ShutDoorTest() {
    learn({0, 0}, {59, 39}, Knowledge::wall);
    learn({1, 1}, {28, 38}, Knowledge::free);
    learn({31, 1}, {58, 38}, Knowledge::unknown);
    learn({29, 15}, {40, 25}, Knowledge::free);
    see({});
    auto const found = find();
    EXPECT_FALSE(found.empty());
    frontiers.set_moment(now_s, {before_door});
    for (auto const& frontier : found) frontiers.put_off(map, frontier);
    learn({29, 15}, {30, 25}, Knowledge::wall);
  }
  void see(std::vector<Place> robots) {
    roads.update(map, map.take_changes());
    frontiers.set_moment(now_s, std::move(robots));
  }
  std::vector<Frontier> find() { return frontiers.find(map, roads, roads.from(*roads.node_at({15, 20}))); }

  Place before_door{2.5, 2.0};
  RoadMap roads{map};
  Frontiers frontiers{map};
  double now_s = 0.0;
};

TEST_F(ShutDoorTest, IsGoneBackToWhereItWasShutBeforeTheRobot) {
  see({before_door});
  EXPECT_TRUE(find().empty()) << "not at once";
  now_s = FrontierSettings().again_after_s;
  see({});
  auto const found = find();
  ASSERT_FALSE(found.empty());
  for (auto const& frontier : found) {
    EXPECT_TRUE(frontier.is_shut);
    EXPECT_LT(distance_m(map.middle(frontier.stand), before_door), 0.3);
    EXPECT_TRUE(map.is_standable(frontier.stand));
  }
  learn({29, 15}, {30, 25}, Knowledge::free);
  see({});
  auto const open = find();
  EXPECT_FALSE(open.empty());
  for (auto const& frontier : open) EXPECT_FALSE(frontier.is_shut) << "the door is open again";
}

TEST_F(ShutDoorTest, IsNotWaitedForForEver) {
  int rounds = 0;
  for (; now_s < 600.0; now_s += 1.0) {
    see({before_door});
    auto const found = find();
    rounds += found.empty() ? 0 : 1;
    for (auto const& frontier : found) frontiers.give_up(map, frontier);
  }
  EXPECT_EQ(rounds, FrontierSettings().most_shut);
  EXPECT_FALSE(frontiers.is_any_put_off(map));
}

TEST_F(ShutDoorTest, IsLeftAloneWhereLittleMoreThanAGapBetweenBeamsIsLeft) {
  now_s = FrontierSettings().again_after_s;
  see({});
  auto const shut = find();
  ASSERT_FALSE(shut.empty());
  learn({31, 1}, {58, 38}, Knowledge::wall);
  learn({31, 15}, {40, 25}, Knowledge::free);
  for (auto const& frontier : shut) {
    auto const beyond =
        std::ranges::find_if(neighbours, [&](Cell away) { return map.at(frontier.middle + away) == Knowledge::wall; });
    ASSERT_NE(beyond, neighbours.end());
    map.learn(frontier.middle + *beyond, Knowledge::unknown);
    EXPECT_TRUE(map.is_frontier(frontier.middle));
  }
  see({});
  EXPECT_TRUE(find().empty());
}

TEST_F(ShutDoorTest, IsNothingToARobotThatWasFarAwayThen) {
  Frontiers others(map);
  learn({29, 15}, {30, 25}, Knowledge::free);
  see({});
  auto const reach = roads.from(*roads.node_at({15, 20}));
  others.set_moment(now_s, {Place(0.5, 0.5)});
  auto const found = others.find(map, roads, reach);
  ASSERT_FALSE(found.empty());
  for (auto const& frontier : found) others.put_off(map, frontier);
  learn({29, 15}, {30, 25}, Knowledge::wall);
  see({});
  others.set_moment(60.0);
  EXPECT_TRUE(others.find(map, roads, roads.from(*roads.node_at({15, 20}))).empty());
}

}  // namespace
}  // namespace lapwing::explore
